#include "app/options/textbook_options.h"

#include "app/options/options.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace scanout::app {
namespace {

constexpr std::array<std::string_view, 10> kEffects = {
    "texture",    "ambient_light", "hemisphere_light", "directional_light", "point_light",
    "spot_light", "two_sided",     "highlight",        "vertex_colours",    "shading"};
// Of the picture, of the model, of speed.
constexpr std::array<std::string_view, 7> kPictureOptions = {
    "size", "background", "cull", "light", "measure", "effect", "renderer"};
constexpr std::array<std::string_view, 3> kOtherOptions = {"opacity", "budget", "max-error"};
// Options that they lack, with the value that is what they do.
constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kTheirs = {
    {{"samples", "1"},
     {"aa", "none"},
     {"texture", "nearest"},
     {"interpolate", "perspective"},
     {"shading", "per_pixel"},
     {"reflection", "blinn_phong"},
     {"tone", "clamp"},
     {"encode", "srgb"}}};

template <class List>
bool has(const List& list, const typename List::value_type& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
}

bool is_part(std::string_view option) {
    const auto parts = textbook::parts();
    return std::any_of(parts.begin(), parts.end(),
                       [&](const textbook::Part& part) { return part.name == option; });
}

bool is_lacked(const Option& option) {
    if (is_part(option.name) || has(kPictureOptions, option.name)) return false;
    return option.group == Group::picture || has(kOtherOptions, option.name);
}

bool asks_nothing(const Option& option, const std::string& text) {
    if (has(kTheirs, {option.name, text})) return true;
    return option.name != "samples" && (text == "auto" || text == option.default_text);
}

std::string_view name_of(textbook::Renderer renderer) {
    return textbook::renderers()[static_cast<std::size_t>(renderer)].name;
}

Result<void> check_given(const GivenOption& given, std::string_view renderer) {
    for (const Option& option : options())
        if (option.name == given.name && belongs(option, Command::render) && is_lacked(option) &&
            !asks_nothing(option, given.text))
            return fail(Exit::usage,
                        "--renderer {} has no --{}{}{}; leave it out, or draw with --renderer "
                        "scanout",
                        renderer, given.name, given.text.empty() ? "" : " ", given.text);
    return {};
}

// A part that has no part in the picture.
Result<void> check_parts(const textbook::AskedParts& asked, textbook::Hidden hidden) {
    struct Row {
        bool is_idle;
        std::string_view words;
    };
    const bool edges = hidden == textbook::Hidden::none;
    const std::array<Row, 6> rows = {{
        {!edges && asked.line, "--line draws the edges of --hidden none; say that, too"},
        {!edges && asked.line_clip,
         "--clip of lines cuts the edges of --hidden none; say that, too"},
        {edges && asked.fill, "--hidden none fills no faces; leave out --fill"},
        {edges && asked.interpolation, "--hidden none fills no faces; leave out --interpolation"},
        {edges && asked.clip,
         "--hidden none draws lines; give --clip one of cohen_sutherland midpoint_subdivision "
         "liang_barsky"},
        {hidden == textbook::Hidden::warnock && asked.fill,
         "--hidden warnock fills its windows by itself; leave out --fill"},
    }};
    for (const Row& row : rows)
        if (row.is_idle) return fail(Exit::usage, "{}", row.words);
    return {};
}

} // namespace

Result<void> check_textbook(const Settings& s) {
    if (!s.renderer) {
        for (const GivenOption& given : s.given)
            if (is_part(given.name))
                return fail(Exit::usage,
                            "--{} is a part of the textbook renderers; say --renderer textbook, "
                            "too",
                            given.name);
        return {};
    }
    for (const GivenOption& given : s.given)
        TRY_VOID(check_given(given, name_of(*s.renderer)));
    for (const auto& [effect, on] : s.frame.effects)
        if (on && !has(kEffects, effect))
            return fail(Exit::usage,
                        "--renderer {} has no effect {}; leave it out, or draw with --renderer "
                        "scanout",
                        name_of(*s.renderer), effect);
    return check_parts(s.parts, textbook::parts_of(*s.renderer, s.parts).hidden);
}

textbook::Look textbook_look_of(const frame::FramePlan& plan) {
    const auto is_on = [&](std::string_view effect) {
        const frame::Decision* row = plan.decision(effect);
        return row != nullptr && row->on();
    };
    textbook::Look look;
    look.width = plan.shown_width;
    look.height = plan.shown_height;
    look.background = plan.options.background;
    look.lights = plan.lights;
    look.left = plan.options.cull == frame::Cull::back    ? textbook::Left::backs
                : plan.options.cull == frame::Cull::front ? textbook::Left::fronts
                                                          : textbook::Left::none;
    look.one_sided = plan.one_sided;
    look.two_sided = plan.sides != shade::Sides::file;
    look.textures = is_on("texture");
    look.vertex_colours = plan.attributes.colour;
    look.highlights = is_on("highlight");
    return look;
}

std::vector<std::string> left_out_of_textbook(const frame::FramePlan& plan,
                                              const scene::Scene& scene) {
    constexpr std::array<std::string_view, 10> kLacked = {
        "shadow",   "normal_map",    "bump_map",      "specular_map", "gloss_map",
        "emission", "roughness_map", "metalness_map", "cut_out",      "blending"};
    std::vector<std::string_view> names;
    for (const std::string_view effect : kLacked)
        if (const frame::Decision* row = plan.decision(effect);
            row != nullptr && row->needed && row->on())
            names.push_back(effect);
    // Their highlight is that of Ns and Ks; a rough surface has one of its own.
    const frame::Decision* highlight = plan.decision("highlight");
    const bool rough = plan.physical && highlight != nullptr && highlight->on();
    const shade::Stage* physical =
        plan.reflection[static_cast<std::size_t>(scene::Surface::physical)];
    if (rough && physical != nullptr && physical->card.name == "ggx")
        names.push_back("highlight ggx");
    std::vector<std::string> lines;
    if (!names.empty())
        lines.push_back(
            fmt::format("the textbook renderers have no {}: left out", fmt::join(names, ", ")));
    if (scene.mesh.lines() + scene.mesh.points() > 0)
        lines.push_back("the textbook renderers draw no lines and points of the file: left out");
    return lines;
}

} // namespace scanout::app
