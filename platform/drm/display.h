// Frames on a DRM/KMS dumb buffer: legacy mode setting and page flips, no GPU.
#pragma once

#include "platform/seat.h"
#include "port/display.h"

#include <memory>
#include <string>
#include <vector>

namespace scanout::drm {

struct Options {
    std::string card;      // "/dev/dri/card1"; empty: the first that works
    std::string connector; // "HDMI-A-1"; empty: the first connected one
    std::string mode;      // "1920x1080" or "1920x1080@60"; empty: preferred, else the highest
};

// The first card with KMS, a connected connector and obtainable master. Fails (Exit::no_display)
// with one line that says why each card was refused and what to do. The seat outlives the display.
Result<std::unique_ptr<port::Display>> create(const Options& options, console::Seat& seat);

// The displays of this machine, for `scanout list displays|connectors|modes`.
struct ModeInfo {
    int width = 0, height = 0;
    double refresh_hz = 0;
    bool preferred = false;
};
struct ConnectorInfo {
    std::string name; // "Virtual-1"
    bool connected = false;
    std::vector<ModeInfo> modes;
};
struct CardInfo {
    std::string path, driver;
    std::string problem; // why it cannot be used, or empty
    std::vector<ConnectorInfo> connectors;
};
std::vector<CardInfo> list_cards();

} // namespace scanout::drm
