// Frames on a frame buffer device, /dev/fb0: 16, 24 or 32 bits, any channel offsets, padded lines.
// There is no flip: damaged rows are copied from the back buffer. Panning is not used: under the
// kernel's DRM emulation it reports success and shows the wrong page.
#pragma once

#include "platform/seat.h"
#include "port/display.h"

#include <memory>
#include <string>
#include <vector>

namespace scanout::linux_fb {

struct Options {
    std::string device = "/dev/fb0";
};

// Fails (Exit::no_display) with one line: why, and what to do. The seat outlives the display.
Result<std::unique_ptr<port::Display>> create(const Options& options, console::Seat& seat);

// What there is, for `scanout list displays`.
struct FrameBufferInfo {
    std::string path, id; // "/dev/fb0", "virtio_gpudrmfb"
    std::string problem;  // why it cannot be used, or empty
    int width = 0, height = 0;
    image::PixelFormat format;
};
std::vector<FrameBufferInfo> list_frame_buffers();

} // namespace scanout::linux_fb
