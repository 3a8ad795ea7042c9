// scanout list WHAT: lists what this machine and this program have, on standard output.
#include "app/command/commands.h"
#include "app/displays.h"
#include "app/options/text.h"
#include "app/picture/nearest.h"
#include "app/picture/picture.h"
#include "app/report/lists.h"
#include "app/report/report.h"
#include "app/view/bindings.h"
#include "frame/catalogue.h"
#include "image/pixel_format.h"
#include "io/load.h"
#include "simd/targets.h"

#include <algorithm>
#include <array>

namespace scanout::app {
namespace {

std::string exception_of(const Technique& t) {
    if (t.may_err_more.than.empty()) return "";
    return fmt::format("; may err more than {}: {}", t.may_err_more.than, t.may_err_more.reason);
}

void list_techniques(const Settings& settings) {
    constexpr std::array<std::string_view, 3> kKinds = {"rung", "effect", "model"};
    for (const Technique* t : techniques_of(settings))
        fmt::print("{:<12} {:<14} {:<7} {} ({}){}\n", t->axis, t->name,
                   kKinds[static_cast<std::size_t>(t->kind)], t->blurb, t->source,
                   exception_of(*t));
}

void list_renderers(const Settings&) {
    for (const textbook::Method& renderer : textbook::renderers())
        fmt::print("{:<14} {:<20} {}\n", "renderer", renderer.name, renderer.blurb);
    for (const textbook::Part& part : textbook::parts())
        for (const textbook::Method& method : part.methods)
            fmt::print("{:<14} {:<20} {}\n", part.name, method.name, method.blurb);
}

std::string_view describe(std::string_view target) {
    if (target == "avx3") return "AVX-512: 16 lanes";
    if (target == "avx2") return "AVX2: 8 lanes";
    if (target == "ssse3") return "SSSE3: 4 lanes";
    if (target == "emu128") return "plain C++ in lanes of 4, for every processor";
    if (target == "neon") return "NEON: 4 lanes";
    return "";
}

void list_formats(const Settings&) {
    fmt::print("Models:\n");
    for (const io::Format& format : io::formats())
        fmt::print("  {:<10} {}\n", format.extension, format.description);
    fmt::print(
        "Pictures, written:\n  png ppm pam raw, moving: apng y4m\nPixel formats of displays:\n ");
    for (const image::NamedPixelFormat& named : image::pixel_formats())
        fmt::print(" {}", named.name);
    fmt::print("\n");
}

void list_targets(const Settings&) {
    for (const simd::Target& target : simd::targets())
        fmt::print("{:<8} {}{}\n", target.name, describe(target.name),
                   target.chosen      ? " (chosen)"
                   : target.supported ? ""
                                      : " (not on this processor)");
}

void list_keys(const Settings&) {
    fmt::print("{}", keys_text());
}

void list_options(const Settings&) {
    fmt::print("{}", options_markdown());
}

struct Topic {
    std::string_view name;
    void (*print)(const Settings&);
    std::string (*json)(const Settings&);
};
constexpr std::array kTopics = {
    Topic{"displays", list_displays, displays_json},
    Topic{"connectors", list_connectors, connectors_json},
    Topic{"modes", list_modes, modes_json},
    Topic{"techniques", list_techniques, techniques_json},
    Topic{"formats", list_formats, formats_json},
    Topic{"targets", list_targets, targets_json},
    Topic{"keys", list_keys, keys_json},
    Topic{"options", list_options, options_json},
    Topic{"renderers", list_renderers, renderers_json},
};

// A second word is an axis of techniques.
Result<void> check_narrowing(const Settings& settings) {
    if (settings.arguments.size() == 1) return {};
    const std::string& list = settings.arguments[0];
    if (list != "techniques" || settings.arguments.size() > 2)
        return fail(Exit::usage, "list {} takes no more words; leave out {}", list,
                    settings.arguments.back());
    if (!techniques_of(settings).empty()) return {};
    std::vector<std::string_view> axes;
    for (const Technique* t : frame::techniques())
        axes.push_back(t->axis);
    axes.erase(std::unique(axes.begin(), axes.end()), axes.end());
    return fail(Exit::usage, "there is no axis '{}'{}; there is {}", settings.arguments[1],
                did_you_mean(settings.arguments[1], axes), fmt::join(axes, " "));
}

std::vector<std::string_view> topic_names() {
    std::vector<std::string_view> names;
    names.reserve(std::size(kTopics));
    for (const Topic& topic : kTopics)
        names.push_back(topic.name);
    return names;
}

} // namespace

std::string list_topics() {
    return fmt::format("{}", fmt::join(topic_names(), " "));
}

Result<Exit> run_list(const Settings& settings) {
    const std::vector<std::string_view> names = topic_names();
    if (settings.arguments.empty())
        return fail(Exit::usage, "list what? one of {}", fmt::join(names, " "));
    const std::string& asked = settings.arguments.front();
    const auto* const topic = std::find_if(kTopics.begin(), kTopics.end(),
                                           [&](const Topic& t) { return t.name == asked; });
    if (topic == kTopics.end())
        return fail(Exit::usage, "there is no list of '{}'{}; there is {}", asked,
                    did_you_mean(asked, names), fmt::join(names, " "));
    TRY_VOID(check_narrowing(settings));
    if (settings.json)
        TRY_VOID(write_report(settings, topic->json(settings)));
    else
        topic->print(settings);
    return Exit::ok;
}

} // namespace scanout::app
