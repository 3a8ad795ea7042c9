#include "platform/drm/display.h"

#include "platform/devices.h"
#include "platform/drm/kernel_device.h"
#include "platform/drm/open.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace scanout::drm {
namespace {

std::vector<std::string> card_paths() {
    std::vector<std::string> paths;
    for (int i = 0; i < 64; ++i) {
        std::string path = fmt::format("/dev/dri/card{}", i);
        std::error_code error;
        if (std::filesystem::exists(path, error)) paths.push_back(std::move(path));
    }
    return paths;
}

Result<std::unique_ptr<Device>> open_card(const std::string& path, console::Seat& seat) {
    const auto fd = seat.open_device(path);
    if (fd) return kernel_device(console::Device(seat, *fd));
    const int error = fd.error();
    return fail(Exit::no_display, "{}{}", std::strerror(error),
                error == EACCES || error == EPERM ? ": add the user to group video, or start seatd"
                                                  : "");
}

Result<std::unique_ptr<KmsDisplay>> open_one(const std::string& path, const OpenCard& open,
                                             const Options& options, const console::Seat& seat,
                                             const Timeouts& timeouts) {
    TRY(std::unique_ptr<Device> device, open(path));
    TRY(Choice choice, choose(*device, options));
    if (!device->has_dumb_buffers())
        return fail(Exit::no_display, "the driver {} has no dumb buffers", device->driver());
    if (const Errno error = device->take_master(); error != 0)
        return fail(Exit::no_display,
                    "another program draws there{}: quit it, or switch to a text console (DRM "
                    "master: {})",
                    console::held_by(path), std::strerror(error));
    return KmsDisplay::create(std::move(device), std::move(choice), path, seat, timeouts);
}

} // namespace

Result<std::unique_ptr<KmsDisplay>> open_first(const std::vector<std::string>& paths,
                                               const OpenCard& open, const Options& options,
                                               const console::Seat& seat,
                                               const Timeouts& timeouts) {
    std::string reasons;
    for (const std::string& path : paths) {
        auto display = open_one(path, open, options, seat, timeouts);
        if (display || display.error().exit == Exit::usage) return display;
        reasons += fmt::format("{}{}: {}", reasons.empty() ? "" : "; ", path, display.error().what);
    }
    if (reasons.empty()) reasons = "there is no /dev/dri/card*";
    return fail(Exit::no_display, "{}", reasons);
}

Result<std::unique_ptr<port::Display>> create(const Options& options, console::Seat& seat) {
    const auto paths = options.card.empty() ? card_paths() : std::vector<std::string>{options.card};
    return open_first(
        paths, [&](const std::string& path) { return open_card(path, seat); }, options, seat);
}

std::vector<CardInfo> list_cards() {
    std::vector<CardInfo> cards;
    const auto seat = console::no_seat();
    for (const std::string& path : card_paths()) {
        CardInfo card;
        card.path = path;
        auto device = open_card(path, *seat);
        std::vector<Connector> connectors;
        if (!device) {
            card.problem = device.error().what;
        } else {
            card.driver = (*device)->driver();
            if (const Errno error = (*device)->connectors(connectors); error != 0)
                card.problem = fmt::format("no mode setting (KMS): {}", std::strerror(error));
        }
        for (const Connector& connector : connectors) {
            ConnectorInfo info{connector.name, connector.connected, {}};
            for (const drmModeModeInfo& mode : connector.modes)
                info.modes.push_back({mode.hdisplay, mode.vdisplay, refresh_hz(mode),
                                      (mode.type & DRM_MODE_TYPE_PREFERRED) != 0});
            card.connectors.push_back(std::move(info));
        }
        cards.push_back(std::move(card));
    }
    return cards;
}

} // namespace scanout::drm
