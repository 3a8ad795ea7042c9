#include "app/options/conflicts.h"

#include "app/options/textbook_options.h"

#include <algorithm>
#include <array>
#include <utility>

namespace scanout::app {

bool exclude_each_other(std::string_view name, std::string_view other) {
    using Rivals = std::array<std::string_view, 6>;
    constexpr std::array kRivals = {
        Rivals{"view", "camera", "eye", "look-at"}, // where the camera stands
        Rivals{"samples", "aa"}, Rivals{"verbose", "quiet"}, Rivals{"reference", "renderer"},
        Rivals{"budget", "max-error", "reference", "no-times", "record", "replay"}};
    const auto names_both = [&](const Rivals& rivals) {
        return std::count(rivals.begin(), rivals.end(), name) > 0 &&
               std::count(rivals.begin(), rivals.end(), other) > 0;
    };
    const auto is_window = [](std::string_view option) {
        return option == "frustum" || option == "ortho";
    };
    const auto is_of_window = [&](std::string_view option) {
        constexpr std::array<std::string_view, 5> kOfWindow = {"near", "far", "fov", "projection",
                                                               "screen-fit"};
        return is_window(option) ||
               std::find(kOfWindow.begin(), kOfWindow.end(), option) != kOfWindow.end();
    };
    if ((is_window(name) && is_of_window(other)) || (is_window(other) && is_of_window(name)))
        return true;
    return name == other || std::any_of(kRivals.begin(), kRivals.end(), names_both);
}

// --frustum and --ortho say all that these say.
static Result<void> check_window(const Settings& s) {
    for (const std::string_view window : {"frustum", "ortho"})
        for (const std::string_view other :
             {"ortho", "near", "far", "fov", "projection", "screen-fit"})
            if (window != other && is_given(s, window) && is_given(s, other))
                return fail(Exit::usage, "--{} and --{} exclude each other: give one of them",
                            window, other);
    return {};
}

static Result<void> check_motion(const Settings& s) {
    const bool moves = !s.motion_file.empty();
    if (!moves && s.animation.empty() && (s.time || s.range))
        return fail(Exit::usage, "{} is of a motion: say --motion FILE, or --animation NAME",
                    s.time ? "--time" : "--frames A..B");
    if (s.time && s.range)
        return fail(Exit::usage, "--time is one moment, --frames A..B are many: give one of them");
    if (moves && s.turntable > 0)
        return fail(Exit::usage, "--motion and --turntable each turn the model: give one of them "
                                 "(models/motion/turntable.toml is a turntable)");
    return {};
}

Result<void> check_together(const Settings& s) {
    const bool eye = s.camera.eye.has_value();
    if (eye != s.camera.target.has_value())
        return fail(Exit::usage, "--eye and --look-at go together: give {} as well",
                    eye ? "--look-at X,Y,Z" : "--eye X,Y,Z");
    if (int{s.camera_given} + int{!s.named_view.empty()} + int{eye} > 1)
        return fail(Exit::usage,
                    "--view, --camera and --eye each place the camera: give one of them");
    if (s.limit && s.metric == Metric::none)
        return fail(Exit::usage, "--limit is of a figure: say which by --metric");
    if (s.metric != Metric::none && (s.max_difference != 0 || s.max_pixels != 0))
        return fail(Exit::usage, "--metric has the tolerance --limit; leave --max-diff and "
                                 "--max-pixels out");
    if (s.reference && s.limits.any())
        return fail(Exit::usage, "--reference has no rungs to choose; leave {} out",
                    s.limits.wall_ms ? "--budget" : "--max-error");
    if (const std::string_view steadying = steadying_option(s);
        s.limits.any() && !steadying.empty())
        return fail(Exit::usage, "{} chooses by the clock, which {} leaves out; give one of them",
                    s.limits.wall_ms ? "--budget" : "--max-error", steadying);
    if (s.reference && s.renderer)
        return fail(Exit::usage, "--reference and --renderer each say who draws: give one of them");
    TRY_VOID(check_window(s));
    TRY_VOID(check_motion(s));
    TRY_VOID(check_textbook(s));
    if (s.verbose && s.quiet) return fail(Exit::usage, "--verbose and --quiet: give one of them");
    return {};
}

std::vector<std::string> without_effect(const Settings& s,
                                        const std::set<std::string_view>& given) {
    std::vector<std::string> notes;
    if (given.count("terminal") > 0 && s.backend != Backend::terminal)
        notes.emplace_back("--terminal changes nothing: it goes with --backend terminal");
    const bool headless = s.backend == Backend::headless, fbdev = s.backend == Backend::fbdev;
    for (const auto& [name, value] :
         {std::pair("device", s.device), {"connector", s.connector}, {"mode", s.mode}}) {
        const bool of_drm = std::string_view(name) != "device";
        if (given.count(name) > 0 && value != "help" && (headless || (fbdev && of_drm)))
            notes.push_back(fmt::format("--{} changes nothing: it goes with --backend {}", name,
                                        of_drm ? "drm" : "drm or fbdev"));
    }
    return notes;
}

std::string_view steadying_option(const Settings& s) {
    return s.no_times          ? "--no-times"
           : !s.replay.empty() ? "--replay"
           : !s.record.empty() ? "--record"
                               : "";
}

} // namespace scanout::app
