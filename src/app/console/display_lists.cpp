#include "app/displays.h"
#include "app/report/json_text.h"
#include "image/pixel_format.h"
#include "platform/drm/display.h"
#include "platform/linux-fb/display.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include <fmt/format.h>

namespace scanout::app {

using Json = nlohmann::ordered_json;

// Is it the display that --device names? Without --device, each is.
static bool is_wanted(const Settings& settings, const std::string& device) {
    return settings.device.empty() || settings.device == device;
}

void list_displays(const Settings& settings) {
    for (const drm::CardInfo& card : drm::list_cards()) {
        if (!is_wanted(settings, card.path)) continue;
        const auto used = std::count_if(card.connectors.begin(), card.connectors.end(),
                                        [](const drm::ConnectorInfo& c) { return c.connected; });
        fmt::print("drm    {}  {}  {}\n", card.path, card.driver,
                   card.problem.empty()
                       ? fmt::format("{} of {} connectors in use", used, card.connectors.size())
                       : card.problem);
    }
    for (const linux_fb::FrameBufferInfo& fb : linux_fb::list_frame_buffers())
        if (is_wanted(settings, fb.path))
            fmt::print("fbdev  {}  {}  {}\n", fb.path, fb.id,
                       fb.problem.empty()
                           ? fmt::format("{}x{} {}", fb.width, fb.height, image::name_of(fb.format))
                           : fb.problem);
    fmt::print("terminal  the one that scanout runs in, with --backend terminal\n");
    fmt::print("headless  in memory, with --backend headless\n");
}

void list_connectors(const Settings& settings) {
    for (const drm::CardInfo& card : drm::list_cards())
        for (const drm::ConnectorInfo& connector : card.connectors)
            if (is_wanted(settings, card.path))
                fmt::print("{}  {}  {}\n", card.path, connector.name,
                           connector.connected ? "connected" : "not connected");
}

void list_modes(const Settings& settings) {
    for (const drm::CardInfo& card : drm::list_cards())
        for (const drm::ConnectorInfo& connector : card.connectors)
            for (const drm::ModeInfo& mode : connector.modes)
                if (is_wanted(settings, card.path))
                    fmt::print("{}  {}  {}x{}@{:.0f}{}\n", card.path, connector.name, mode.width,
                               mode.height, mode.refresh_hz, mode.preferred ? "  preferred" : "");
}

std::string displays_json(const Settings& settings) {
    Json rows = Json::array();
    for (const drm::CardInfo& card : drm::list_cards())
        if (is_wanted(settings, card.path))
            rows.push_back({{"backend", "drm"},
                            {"device", card.path},
                            {"driver", card.driver},
                            {"problem", card.problem}});
    for (const linux_fb::FrameBufferInfo& fb : linux_fb::list_frame_buffers())
        if (is_wanted(settings, fb.path))
            rows.push_back({{"backend", "fbdev"},
                            {"device", fb.path},
                            {"driver", fb.id},
                            {"problem", fb.problem},
                            {"width", fb.width},
                            {"height", fb.height},
                            {"pixel_format", fb.problem.empty() ? image::name_of(fb.format) : ""}});
    rows.push_back({{"backend", "terminal"}, {"device", ""}, {"driver", ""}, {"problem", ""}});
    rows.push_back({{"backend", "headless"}, {"device", ""}, {"driver", ""}, {"problem", ""}});
    return json_text(rows);
}

std::string connectors_json(const Settings& settings) {
    Json rows = Json::array();
    for (const drm::CardInfo& card : drm::list_cards())
        for (const drm::ConnectorInfo& connector : card.connectors)
            if (is_wanted(settings, card.path))
                rows.push_back({{"device", card.path},
                                {"connector", connector.name},
                                {"connected", connector.connected}});
    return json_text(rows);
}

std::string modes_json(const Settings& settings) {
    Json rows = Json::array();
    for (const drm::CardInfo& card : drm::list_cards())
        for (const drm::ConnectorInfo& connector : card.connectors)
            for (const drm::ModeInfo& mode : connector.modes)
                if (is_wanted(settings, card.path))
                    rows.push_back({{"device", card.path},
                                    {"connector", connector.name},
                                    {"width", mode.width},
                                    {"height", mode.height},
                                    {"hz", mode.refresh_hz},
                                    {"preferred", mode.preferred}});
    return json_text(rows);
}

} // namespace scanout::app
