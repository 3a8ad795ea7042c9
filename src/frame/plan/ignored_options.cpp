#include "frame/plan/ignored_options.h"

#include "frame/plan/planner.h"
#include "rows.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace scanout::frame {
namespace {

using Lines = std::vector<std::string>;

bool asked_on(const FrameOptions& o, std::string_view effect) {
    const auto asked = o.effects.find(effect);
    return asked != o.effects.end() && asked->second;
}
// The scene calls for it, and the user takes it out.
bool taken_out(const FramePlan& plan, std::string_view effect) {
    const Decision* d = plan.decision(effect);
    return d->needed && !d->on();
}
// Why it is off: by the user's word, or by the scene's facts.
std::string why_off(const FramePlan& plan, std::string_view effect, std::string otherwise) {
    if (!taken_out(plan, effect)) return otherwise;
    return fmt::format("--effect {}=off leaves it out; give one of the two", effect);
}
std::string nothing(const std::string& option, const std::string& because) {
    return fmt::format("{} changes nothing: {}", option, because);
}

// Effects that are forced on, and those whose technique is asked for by name.
void add_effect(const FramePlan& plan, const Decision& d, Lines& lines) {
    const FrameOptions& o = plan.options;
    const bool on = asked_on(o, d.effect);
    const bool named = d.effect == "shadow" || d.effect == "ambient_occlusion";
    const std::string asked = named ? asked_for(o, d.effect) : "auto";
    if (!is_auto(asked) && !(d.needed && d.on()))
        lines.push_back(taken_out(plan, d.effect)
                            ? nothing(fmt::format("--{} {}", option_of(d.effect), asked),
                                      why_off(plan, d.effect, ""))
                            : to_string(d));
    else if (on && !d.on())
        lines.push_back(nothing(fmt::format("--effect {}=on", d.effect), d.because));
    else if (on && d.forced && !d.needed)
        lines.push_back(to_string(d));
}

// Effects that are on in name alone, for what another option says.
void add_contradictions(const FramePlan& plan, Lines& lines) {
    const FrameOptions& o = plan.options;
    const auto* const shadow = find_row(shade::shadow::kRows, o.shadow);
    const auto* const model = find_row(shade::reflection::kRows, o.reflection);
    const auto* const filter = find_row(shade::texture::kRows, o.texture);
    const auto* const transparency = find_row(shade::transparency::kRows, o.transparency);
    const struct {
        std::string_view effect;
        bool ignored;
        std::string because;
    } rows[] = {
        {"shadow", shadow != nullptr && shadow->by == shade::ShadowBy::facing,
         fmt::format("--shadow {} throws none; say another, or auto", o.shadow)},
        {"highlight", model != nullptr && !model->highlight,
         fmt::format("--reflection {} has none; say another, or auto", o.reflection)},
        {"mipmaps", filter != nullptr && !filter->needs.footprint,
         fmt::format("--texture {} reads none; say another, or auto", o.texture)},
        {"blending", transparency != nullptr && transparency->cuts,
         fmt::format("--transparency {} blends nothing; say another, or auto", o.transparency)},
        {"blending", blends_nothing(o), "--blend none blends nothing; say another, or auto"}};
    for (const auto& row : rows) {
        if (!row.ignored || !asked_on(o, row.effect) || !plan.decision(row.effect)->on()) continue;
        // The contradiction is the better reason.
        lines.erase(std::remove(lines.begin(), lines.end(), to_string(*plan.decision(row.effect))),
                    lines.end());
        lines.push_back(nothing(fmt::format("--effect {}=on", row.effect), row.because));
    }
}

// A technique on an axis of its own. To leave something out always has an effect.
void add_choice(const FramePlan& plan, const Decision& d, Lines& lines) {
    const std::string asked = asked_for(plan.options, d.effect);
    if (is_auto(asked) || asked == "none") return;
    const bool by_number = d.effect == "aa" && is_auto(plan.options.aa);
    if (by_number && !plan.options.samples_asked) return;
    const std::string option = by_number ? fmt::format("--samples {}", plan.options.samples)
                                         : fmt::format("--{} {}", option_of(d.effect), asked);
    const bool texture = d.effect == "source" || d.effect == "wrap" || d.effect == "mapping";
    if (!d.on() || !d.needed)
        lines.push_back(nothing(option, d.effect == "blend" ? why_off(plan, "blending", d.because)
                                        : texture           ? why_off(plan, "texture", d.because)
                                                            : d.because));
    else if (d.technique != asked)
        lines.push_back(
            fmt::format("{} is not possible: {}; {} in its place", option, d.because, d.technique));
}

bool has_size(const scene::Light& light) {
    return light.size > 0 && !is_ambient(light.kind) && !is_black(light);
}
bool casts_with_size(const FramePlan& plan) {
    return std::any_of(plan.lights.begin(), plan.lights.end(),
                       [](const scene::Light& light) { return light.casts && has_size(light); });
}

// Why no shadow is drawn that a size could soften.
std::string why_sharp(const FramePlan& plan, bool casts) {
    const Decision& shadow = *plan.decision("shadow");
    if (!casts) return "it casts none (:shadow=off)";
    return shadow.on() ? "--shadow attached throws none" : why_off(plan, "shadow", shadow.because);
}

// Lights that the user put there, and their sizes.
void add_lights(const FramePlan& plan, Lines& lines) {
    const auto is_in = [](const scene::Light& light, const std::vector<scene::Light>& lights) {
        return std::find(lights.begin(), lights.end(), light) != lights.end();
    };
    const std::vector<scene::Light>& given = plan.options.lights;
    for (const scene::Light& light : given) {
        if (is_black(light) || is_in(light, scene::default_lights()) ||
            is_in(light, scene::plain_lights()))
            continue;
        const std::string effect = fmt::format("{}_light", name_of(light.kind));
        const Decision& d = *plan.decision(effect);
        if (d.needed && d.on()) continue;
        std::string line = nothing(fmt::format("--light {}", name_of(light.kind)),
                                   why_off(plan, effect, d.because));
        if (std::find(lines.begin(), lines.end(), line) == lines.end())
            lines.push_back(std::move(line));
    }
    const shade::ShadowStage* const shadow = plan.shadow.stage;
    const bool soft = casts_with_size(plan);
    if (shadow != nullptr && shadow->soft && !soft && !is_auto(plan.options.shadow))
        lines.push_back(fmt::format("--shadow {} changes nothing: no light that casts has a size; "
                                    "it draws what {} draws",
                                    shadow->card.name, shade::shadow::map_pcf.card.name));
    else if (shadow != nullptr && !shadow->soft && soft)
        lines.push_back(
            fmt::format("the size of a light softens no shadow: --shadow {} is sharp, {} is not",
                        shadow->card.name, shade::shadow::map_soft.card.name));
    else if (shadow == nullptr && std::any_of(plan.lights.begin(), plan.lights.end(), has_size))
        lines.push_back("the size of a light softens no shadow: " + why_sharp(plan, soft));
}

// Numbers and names that only one technique of another axis, or one kind of scene, reads.
void add_details(const FramePlan& plan, Lines& lines) {
    const FrameOptions &o = plan.options, defaults;
    const TransparencyPlan& t = plan.transparency;
    const shade::ShadowStage* const shadow = plan.shadow.stage;
    const auto* const model = find_row(shade::reflection::kRows, o.reflection);
    const auto* const asked_shadow = find_row(shade::shadow::kRows, o.shadow);
    const auto because = [&](std::string_view effect) { return plan.decision(effect)->because; };
    const bool see_through = t.cut_out != nullptr || t.blended != nullptr;
    const Decision& highlight = *plan.decision("highlight");
    const shade::Filter* filter = plan.filter != nullptr ? plan.filter : t.filter;
    const bool compares =
        row_or(raster::depth_test::kRows, o.depth_test, raster::depth_test::less).compares;
    const struct {
        bool ignored;
        std::string option, because;
    } rows[] = {
        {!is_auto(o.texture) && filter == nullptr, "--texture " + o.texture,
         why_off(plan, "texture", "no texture is read")},
        // Without their own model physical materials lose what they say.
        {model != nullptr && model->highlight && model->matt == nullptr && !plan.physical &&
             !(highlight.needed && highlight.on()),
         "--reflection " + o.reflection, why_off(plan, "highlight", highlight.because)},
        {!is_auto(o.transparency) && !see_through, "--transparency " + o.transparency,
         why_off(plan, "blending", why_off(plan, "cut_out", "nothing is cut out or blended"))},
        {o.alpha_cut != defaults.alpha_cut && t.cut_out == nullptr,
         fmt::format("--alpha-cut {}", o.alpha_cut),
         why_off(plan, "cut_out", "nothing is cut out")},
        {o.exposure != 0 && !plan.decision("exposure")->on(),
         fmt::format("--exposure {}", o.exposure), why_off(plan, "exposure", because("exposure"))},
        {!is_auto(o.depth) && !compares && t.blended == nullptr && plan.decision("depth")->on(),
         "--depth " + o.depth, fmt::format("--depth-test {} compares no depths", o.depth_test)},
        {o.shadow_plane.has_value() &&
             (asked_shadow == nullptr || asked_shadow->by != shade::ShadowBy::projection),
         "--shadow-plane", "it is for --shadow projected"},
        {o.shadow_size != defaults.shadow_size &&
             (shadow == nullptr || shadow->by != shade::ShadowBy::maps),
         fmt::format("--shadow-size {}", o.shadow_size), "no shadow map is drawn"},
        {o.shadow_filter != defaults.shadow_filter && (shadow == nullptr || !shadow->filtered),
         fmt::format("--shadow-filter {}", o.shadow_filter),
         "it is for --shadow map_pcf and map_soft"},
        {o.edge_angle != defaults.edge_angle && o.edges != "feature",
         fmt::format("--edge-angle {}", o.edge_angle), "it is for --edges feature"}};
    for (const auto& row : rows)
        if (row.ignored) lines.push_back(nothing(row.option, row.because));
    if (!is_auto(o.texture) && filter != nullptr && filter->card.name != o.texture)
        lines.push_back(fmt::format("--texture {} is not possible: {}; {} in its place", o.texture,
                                    why_off(plan, "mipmaps", because("mipmaps")),
                                    filter->card.name));
}

} // namespace

std::vector<std::string> ignored_options(const FramePlan& plan) {
    Lines lines;
    for (const Decision& d : plan.decisions) {
        if (d.choice)
            add_choice(plan, d, lines);
        else
            add_effect(plan, d, lines);
    }
    add_contradictions(plan, lines);
    add_details(plan, lines);
    add_lights(plan, lines);
    if (plan.lacks_uv)
        lines.emplace_back(
            "maps are not shown: the model has no texture coordinates; --mapping box, "
            "or another, makes them");
    return lines;
}

} // namespace scanout::frame
