#include "frame/plan/planner.h"

#include "frame/catalogue.h"

namespace scanout::frame {

Error no_such_technique(std::string_view axis, const std::string& asked) {
    return {fmt::format("--{} {}: there is no such technique; choose auto {}", option_of(axis),
                        asked, fmt::join(names_on(axis), " ")),
            Exit::usage};
}

bool decide(Decision& row, const FrameOptions& options, std::string_view technique, bool needed) {
    const auto forced = options.effects.find(row.effect);
    const bool on = forced != options.effects.end() ? forced->second : needed;
    row.technique = on ? technique : "off";
    row.needed = needed;
    row.forced = on != needed;
    return on;
}

bool Planner::effect(std::string name, std::string_view technique, bool needed, std::string because,
                     std::string_view axis) {
    plan_.decisions.push_back({std::move(name), {}, std::move(because)});
    plan_.decisions.back().axis = axis;
    return decide(plan_.decisions.back(), options_, technique, needed);
}

void Planner::choice(std::string axis, std::string_view technique, const std::string& asked,
                     std::string because, bool needed) {
    plan_.decisions.push_back({std::move(axis), std::string(technique), std::move(because), needed,
                               !is_auto(asked), true});
}

void Planner::stage(const shade::Stage& stage) {
    plan_.stages.push_back(&stage);
    plan_.techniques.push_back(&stage.card);
    plan_.attributes = plan_.attributes | stage.needs;
}

void Planner::called(const shade::Stage& stage, shade::Attributes needs) {
    plan_.techniques.push_back(&stage.card);
    plan_.attributes = plan_.attributes | needs;
}

} // namespace scanout::frame
