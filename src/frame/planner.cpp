#include "frame/planner.h"

#include "base/check.h"
#include "frame/techniques.h"

#include <algorithm>

namespace scanout::frame {
Result<std::string> choose(std::string_view axis, const std::string& asked,
                           std::string_view automatic) {
    const std::string_view name = asked == "auto" ? automatic : std::string_view(asked);
    for (const Technique* technique : techniques())
        if (technique->axis == axis && technique->name == name) return std::string(name);
    return fail(Exit::usage, "--{} {}: there is no such technique; choose auto{}", option_of(axis),
                asked, names_of(axis));
}

bool Planner::effect(std::string name, std::string technique, bool needed, std::string because) {
    const auto forced = options_.effects.find(name);
    const bool is_forced = forced != options_.effects.end();
    const bool on = is_forced ? forced->second : needed;
    plan_.decisions.push_back({std::move(name), on ? std::move(technique) : "off",
                               std::move(because), needed, is_forced && on != needed, false});
    return on;
}

void Planner::choice(std::string axis, std::string technique, const std::string& asked,
                     std::string because, bool needed) {
    plan_.decisions.push_back(
        {std::move(axis), std::move(technique), std::move(because), needed, asked != "auto", true});
}

void Planner::stage(std::string_view axis, std::string_view name) {
    const shade::Stage* found = shade::find_stage(axis, name);
    CHECK(found != nullptr);
    plan_.stages.push_back(found);
    plan_.techniques.push_back(&found->card);
    plan_.attributes = plan_.attributes | found->needs;
}

const shade::Stage* Planner::called(std::string_view axis, std::string_view name,
                                    shade::Attributes needs) {
    const shade::Stage* found = technique(axis, name);
    plan_.attributes = plan_.attributes | needs;
    return found;
}

const shade::Stage* Planner::technique(std::string_view axis, std::string_view name) {
    const shade::Stage* found = shade::find_stage(axis, name);
    CHECK(found != nullptr);
    plan_.techniques.push_back(&found->card);
    return found;
}

void Planner::filter(const shade::Filter& filter, bool colour, bool alpha) {
    for (Decision& decision : plan_.decisions)
        if (decision.effect == "texture" && decision.on()) decision.technique = filter.card.name;
    if (colour) {
        plan_.filter = &filter;
        plan_.attributes = plan_.attributes | filter.needs;
    }
    if (alpha) {
        plan_.transparency.filter = &filter;
        plan_.transparency.attributes = plan_.transparency.attributes | filter.needs;
    }
    const auto first_map = std::find_if(plan_.techniques.begin(), plan_.techniques.end(),
                                        [](const Technique* t) { return t->axis == "map"; });
    plan_.techniques.insert(first_map, &filter.card); // in the order of techniques.h
}

} // namespace scanout::frame
