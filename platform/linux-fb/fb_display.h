// The display on one frame buffer device.
#pragma once

#include "image/pixel_format.h"
#include "platform/linux-fb/device.h"
#include "platform/seat.h"
#include "port/display.h"

#include <memory>
#include <string>

namespace scanout::linux_fb {

// The pixel layout of a device, from the kernel's description, checked.
struct Layout {
    int width = 0, height = 0;
    image::PixelFormat format;
    std::size_t first = 0;    // byte of the pixel at the top left, from the start of the mapping
    std::size_t pitch = 0;    // bytes from row to row
    std::size_t map_size = 0; // bytes to map
    double refresh_hz = 60;
};

// Errors are one reason without the path: palettes, planes, 8 bits, memory that does not hold the
// picture.
Result<Layout> layout_of(const fb_var_screeninfo& variable, const fb_fix_screeninfo& fixed);

class FbDisplay final : public port::Display {
public:
    // Errors begin with `path`. Nothing is drawn before the first present().
    static Result<std::unique_ptr<FbDisplay>>
    create(std::unique_ptr<Device> device, const std::string& path, const console::Seat& seat);
    FbDisplay(const FbDisplay&) = delete;
    FbDisplay& operator=(const FbDisplay&) = delete;
    ~FbDisplay() override;

    const port::DisplayInfo& info() const override { return info_; }
    bool ready() const override { return !lost(); }
    Result<void> present(const image::Image& frame, std::span<const image::Rect> damage) override;
    bool paced() const override { return false; }
    int event_fd() const override { return -1; }
    Result<void> dispatch() override { return {}; }
    bool lost() const override { return !seat_.active(); }
    bool stale() const override { return shown_ && activations_ != seat_.activations(); }

private:
    FbDisplay(std::unique_ptr<Device> device, Layout layout, const console::Seat& seat)
        : device_(std::move(device)), layout_(layout), seat_(seat) {}
    Result<void> set_linear_colors();

    std::unique_ptr<Device> device_;
    Layout layout_;
    const console::Seat& seat_;
    port::DisplayInfo info_;
    ColorTable saved_colors_; // empty: the device has no colour table
    std::uint8_t* memory_ = nullptr;
    bool shown_ = false;
    std::uint64_t activations_ = 0; // of the seat, when it was last drawn on
};

} // namespace scanout::linux_fb
