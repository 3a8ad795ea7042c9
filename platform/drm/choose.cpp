#include "platform/drm/choose.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>

#include <fmt/ranges.h>

namespace scanout::drm {
namespace {

struct WantedMode {
    int width = 0, height = 0;
    double hz = 0; // 0: any
};

std::optional<WantedMode> parse_mode(const std::string& text) {
    WantedMode mode;
    const char* at = text.data();
    const char* const end = text.data() + text.size();
    auto number = std::from_chars(at, end, mode.width);
    if (number.ec != std::errc() || number.ptr == end || *number.ptr != 'x') return std::nullopt;
    number = std::from_chars(number.ptr + 1, end, mode.height);
    if (number.ec != std::errc()) return std::nullopt;
    if (number.ptr != end) {
        if (*number.ptr != '@') return std::nullopt;
        number = std::from_chars(number.ptr + 1, end, mode.hz);
        if (number.ec != std::errc() || number.ptr != end || !(mode.hz > 0)) return std::nullopt;
    }
    return mode;
}

// More pixels, then more refreshes.
bool lower(const drmModeModeInfo& a, const drmModeModeInfo& b) {
    const int pixels_a = a.hdisplay * a.vdisplay, pixels_b = b.hdisplay * b.vdisplay;
    return pixels_a != pixels_b ? pixels_a < pixels_b : refresh_hz(a) < refresh_hz(b);
}

std::string names(const std::vector<Connector>& connectors) {
    std::string text;
    for (const Connector& connector : connectors)
        text += (text.empty() ? "" : " ") + connector.name;
    return text;
}

// Each once, as the kernel lists them: the best first.
std::string names(const std::vector<drmModeModeInfo>& modes) {
    std::vector<std::string> all;
    for (const drmModeModeInfo& mode : modes) {
        std::string name =
            fmt::format("{}x{}@{:.0f}", mode.hdisplay, mode.vdisplay, refresh_hz(mode));
        if (std::find(all.begin(), all.end(), name) == all.end()) all.push_back(std::move(name));
    }
    return fmt::format("{}", fmt::join(all, " "));
}

Result<Connector> choose_connector(const std::vector<Connector>& connectors,
                                   const std::string& wanted) {
    for (const Connector& connector : connectors) {
        if (!wanted.empty() && connector.name != wanted) continue;
        if (connector.connected && !connector.modes.empty()) return connector;
        if (!wanted.empty())
            return fail(
                Exit::no_display,
                "connector {} has no display connected: plug one in, or leave --connector out",
                wanted);
    }
    if (wanted.empty()) return fail(Exit::no_display, "no connected connector: plug in a display");
    return fail(Exit::no_display, "no connector {} (there is: {})", wanted, names(connectors));
}

} // namespace

double refresh_hz(const drmModeModeInfo& mode) {
    if (mode.clock == 0 || mode.htotal == 0 || mode.vtotal == 0) return mode.vrefresh;
    const double hz = mode.clock * 1000.0 / (1.0 * mode.htotal * mode.vtotal);
    return (mode.flags & DRM_MODE_FLAG_INTERLACE) != 0 ? hz * 2 : hz;
}

Result<drmModeModeInfo> choose_mode(const Connector& connector, const std::string& wanted) {
    const auto& modes = connector.modes;
    if (wanted == "highest") return *std::max_element(modes.begin(), modes.end(), lower);
    if (wanted.empty() || wanted == "preferred") {
        const auto preferred = std::find_if(modes.begin(), modes.end(), [](const auto& mode) {
            return (mode.type & DRM_MODE_TYPE_PREFERRED) != 0;
        });
        if (preferred != modes.end()) return *preferred;
        return *std::max_element(modes.begin(), modes.end(), lower);
    }
    const auto asked = parse_mode(wanted);
    if (!asked)
        return fail(Exit::usage,
                    "mode {}: write preferred, highest, or a size such as 1920x1080 or "
                    "1920x1080@60",
                    wanted);
    const drmModeModeInfo* best = nullptr;
    for (const drmModeModeInfo& mode : modes) {
        if (mode.hdisplay != asked->width || mode.vdisplay != asked->height) continue;
        const auto distance = [&](const auto& m) { return std::abs(refresh_hz(m) - asked->hz); };
        if (asked->hz > 0 && distance(mode) > 1) continue;
        const bool better = best == nullptr ||
                            (asked->hz > 0 ? distance(mode) < distance(*best) : lower(*best, mode));
        if (better) best = &mode;
    }
    if (best == nullptr)
        return fail(Exit::no_display, "{} has no mode {} (there is: {})", connector.name, wanted,
                    names(modes));
    return *best;
}

Result<Choice> choose(Device& device, const Options& options) {
    std::vector<Connector> connectors;
    if (const Errno error = device.connectors(connectors); error != 0)
        return fail(Exit::no_display, "no mode setting (KMS): {}", std::strerror(error));
    Choice choice;
    TRY(choice.connector, choose_connector(connectors, options.connector));
    TRY(choice.mode, choose_mode(choice.connector, options.mode));
    // A CRTC that drives another display is left to it, unless it is the only one.
    for (const std::uint32_t crtc : choice.connector.crtcs) {
        const bool taken =
            std::any_of(connectors.begin(), connectors.end(), [&](const Connector& other) {
                return other.id != choice.connector.id && other.connected && !other.crtcs.empty() &&
                       other.crtcs.front() == crtc;
            });
        if (choice.crtc == 0 || !taken) choice.crtc = crtc;
        if (!taken) break;
    }
    if (choice.crtc == 0)
        return fail(Exit::no_display, "connector {}: no CRTC can drive it", choice.connector.name);
    return choice;
}

} // namespace scanout::drm
