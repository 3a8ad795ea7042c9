#include "frame/planner.h"

#include "base/check.h"
#include "frame/catalogue.h"

namespace scanout::frame {
Result<std::string> choose(std::string_view axis, const std::string& asked,
                           std::string_view automatic) {
    const std::string_view name = asked == "auto" ? automatic : std::string_view(asked);
    for (const Technique* technique : techniques())
        if (technique->axis == axis && technique->name == name) return std::string(name);
    return fail(Exit::usage, "--{} {}: there is no such technique; choose auto {}", option_of(axis),
                asked, fmt::join(names_on(axis), " "));
}

bool decide(Decision& row, const FrameOptions& options, std::string technique, bool needed) {
    const auto forced = options.effects.find(row.effect);
    const bool on = forced != options.effects.end() ? forced->second : needed;
    row.technique = on ? std::move(technique) : "off";
    row.needed = needed;
    row.forced = on != needed;
    return on;
}

bool Planner::effect(std::string name, std::string technique, bool needed, std::string because) {
    plan_.decisions.push_back({std::move(name), {}, std::move(because)});
    return decide(plan_.decisions.back(), options_, std::move(technique), needed);
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

} // namespace scanout::frame
