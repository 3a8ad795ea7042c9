#include "frame/in_vain.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout::frame {
namespace {

// Effects that are forced on, and a shadow that has a name.
bool is_in_vain(const FrameOptions& o, const Decision& d) {
    if (d.choice || d.needed) return false;
    return d.forced ? d.on() : d.effect == "shadow" && o.shadow != "auto";
}

// A technique on an axis of its own. To leave something out is never in vain.
void add_choice(const FrameOptions& o, const Decision& d, std::vector<std::string>& lines) {
    const std::string* asked = asked_for(o, d.effect);
    if (asked == nullptr || *asked == "auto" || *asked == "none") return;
    const std::string option = fmt::format("--{} {}", option_of(d.effect), *asked);
    if (!d.on())
        lines.push_back(fmt::format("{} changes nothing: {}", option, d.because));
    else if (d.technique != *asked)
        lines.push_back(
            fmt::format("{} is not possible: {}; {} in its place", option, d.because, d.technique));
}

bool throws_sharp_shadows_of_sizes(const FramePlan& plan) {
    if (plan.shadow.stage == nullptr || plan.options.shadow == "auto" ||
        plan.options.shadow == "map_soft")
        return false;
    return std::any_of(plan.lights.begin(), plan.lights.end(), [](const scene::Light& light) {
        return light.casts && light.size > 0 && light.kind != scene::LightKind::ambient;
    });
}

// Numbers and names that only one technique of another axis, or one kind of scene, reads.
void add_details(const FramePlan& plan, std::vector<std::string>& lines) {
    const FrameOptions &o = plan.options, usual;
    const TransparencyPlan& t = plan.transparency;
    const std::string_view shadow =
        plan.shadow.stage == nullptr ? "off" : plan.shadow.stage->card.name;
    const auto because = [&](std::string_view effect) { return plan.decision(effect)->because; };
    const bool see_through = t.cut_out != nullptr || t.blended != nullptr;
    const bool shiny = plan.decision("highlight")->needed;
    const struct {
        bool in_vain;
        std::string line;
    } rows[] = {
        {o.texture != "auto" && plan.filter == nullptr && t.filter == nullptr,
         fmt::format("--texture {} changes nothing: no texture is read", o.texture)},
        {o.reflection != "auto" && o.reflection != "lambert" && !shiny,
         fmt::format("--reflection {} changes nothing: {}", o.reflection, because("highlight"))},
        {o.transparency != "auto" && !see_through,
         fmt::format("--transparency {} changes nothing: nothing is cut out or blended",
                     o.transparency)},
        {o.alpha_cut != usual.alpha_cut && t.cut_out == nullptr,
         fmt::format("--alpha-cut {} changes nothing: nothing is cut out", o.alpha_cut)},
        {o.blend_space != "auto" && plan.aa->card.name == "none" && t.blended == nullptr,
         fmt::format("--blend-space {} changes nothing: {}", o.blend_space,
                     because("blend_space"))},
        {o.shadow_plane.has_value() && o.shadow != "projected",
         "--shadow-plane changes nothing: it is for --shadow projected"},
        {o.shadow_size != usual.shadow_size && !shadow.starts_with("map"),
         fmt::format("--shadow-size {} changes nothing: no shadow map is drawn", o.shadow_size)},
        {o.shadow_filter != usual.shadow_filter && shadow != "map_pcf" && shadow != "map_soft",
         fmt::format("--shadow-filter {} changes nothing: it is for --shadow map_pcf and map_soft",
                     o.shadow_filter)},
        {throws_sharp_shadows_of_sizes(plan),
         fmt::format("the size of a light changes nothing: --shadow {} is sharp, map_soft is not",
                     o.shadow)}};
    for (const auto& row : rows)
        if (row.in_vain) lines.push_back(row.line);
}

} // namespace

std::vector<std::string> asked_in_vain(const FramePlan& plan) {
    // What shows counts says so in each row.
    if (plan.stencil != nullptr && plan.stencil->marks == Stencil::Marks::covering) return {};
    std::vector<std::string> lines;
    for (const Decision& d : plan.decisions) {
        if (is_in_vain(plan.options, d)) lines.push_back(to_string(d));
        if (d.choice) add_choice(plan.options, d, lines);
    }
    add_details(plan, lines);
    return lines;
}

} // namespace scanout::frame
