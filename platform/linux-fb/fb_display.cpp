#include "platform/linux-fb/fb_display.h"

#include "base/check.h"
#include "port/copy.h"

#include <algorithm>
#include <cstring>

#include <unistd.h>

namespace scanout::linux_fb {
namespace {

image::Channel channel(const fb_bitfield& field) {
    return {static_cast<int>(field.offset), static_cast<int>(field.length)};
}

// pixclock is in picoseconds a pixel. Emulations and old drivers say 0.
double refresh_of(const fb_var_screeninfo& v) {
    const double columns = 0.0 + v.left_margin + v.xres + v.right_margin + v.hsync_len;
    const double rows = 0.0 + v.upper_margin + v.yres + v.lower_margin + v.vsync_len;
    if (v.pixclock == 0) return 60;
    const double hz = 1e12 / (v.pixclock * columns * rows);
    return hz >= 20 && hz <= 500 ? hz : 60;
}

// A ramp as long as the channel has codes; the last entry is full.
std::vector<std::uint16_t> ramp(int bits, std::size_t length) {
    const std::size_t last = (std::size_t{1} << bits) - 1;
    std::vector<std::uint16_t> entries(length);
    for (std::size_t i = 0; i < length; ++i)
        entries[i] = static_cast<std::uint16_t>(std::min(i, last) * 0xffff / last);
    return entries;
}

} // namespace

Result<Layout> layout_of(const fb_var_screeninfo& variable, const fb_fix_screeninfo& fixed) {
    if (fixed.type != FB_TYPE_PACKED_PIXELS || variable.nonstd != 0)
        return fail(
            Exit::no_display,
            "its pixels are stored in planes or otherwise oddly, which scanout does not draw");
    if (fixed.visual != FB_VISUAL_TRUECOLOR && fixed.visual != FB_VISUAL_DIRECTCOLOR)
        return fail(
            Exit::no_display,
            "{} bits of palette or grey: set a mode with 16, 24 or 32 bits (fbset -depth 16)",
            variable.bits_per_pixel);
    if (variable.grayscale != 0 || variable.red.msb_right != 0 || variable.green.msb_right != 0 ||
        variable.blue.msb_right != 0)
        return fail(Exit::no_display,
                    "its pixels are grey, coded or mirrored, which scanout does not draw");
    Layout layout;
    layout.format = {static_cast<int>(variable.bits_per_pixel), channel(variable.red),
                     channel(variable.green), channel(variable.blue), channel(variable.transp)};
    if (auto possible = image::check(layout.format); !possible)
        return fail(Exit::no_display, "{}", possible.error().what);
    constexpr std::uint32_t kMaxSide = 16384;
    if (variable.xres == 0 || variable.yres == 0 || variable.xres > kMaxSide ||
        variable.yres > kMaxSide)
        return fail(Exit::no_display, "it reports an impossible size, {}x{}", variable.xres,
                    variable.yres);
    layout.width = static_cast<int>(variable.xres);
    layout.height = static_cast<int>(variable.yres);
    layout.pitch = fixed.line_length;
    layout.refresh_hz = refresh_of(variable);
    // A mapping starts at a page; the memory may start within it.
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    const std::size_t lead = fixed.smem_start % page;
    const auto bytes = static_cast<std::size_t>(layout.format.bytes_per_pixel());
    const std::size_t offset = variable.yoffset * layout.pitch + variable.xoffset * bytes;
    const std::size_t end =
        offset + (variable.yres - std::size_t{1}) * layout.pitch + variable.xres * bytes;
    if (layout.pitch < variable.xres * bytes || end > fixed.smem_len)
        return fail(Exit::no_display,
                    "its memory of {} bytes does not hold {}x{} pixels in lines of {} bytes",
                    fixed.smem_len, variable.xres, variable.yres, fixed.line_length);
    layout.first = lead + offset;
    layout.map_size = lead + fixed.smem_len;
    return layout;
}

Result<std::unique_ptr<FbDisplay>> FbDisplay::create(std::unique_ptr<Device> device,
                                                     const std::string& path,
                                                     const console::Seat& seat) {
    const auto failed = [&](std::string_view what) {
        return fail(Exit::no_display, "{}: {}", path, what);
    };
    fb_var_screeninfo variable{};
    fb_fix_screeninfo fixed{};
    if (const Errno error = device->variable(variable); error != 0)
        return failed(fmt::format("is no frame buffer: {}", std::strerror(error)));
    if (const Errno error = device->fixed(fixed); error != 0)
        return failed(fmt::format("is no frame buffer: {}", std::strerror(error)));
    const auto layout = layout_of(variable, fixed);
    if (!layout) return failed(layout.error().what);
    // Not make_unique: the constructor is private.
    std::unique_ptr<FbDisplay> display(new FbDisplay(std::move(device), *layout, seat));
    if (const Errno error = display->device_->map(layout->map_size, display->memory_); error != 0)
        return failed(fmt::format("its memory cannot be mapped: {}", std::strerror(error)));
    if (fixed.visual == FB_VISUAL_DIRECTCOLOR)
        if (auto set = display->set_linear_colors(); !set) return failed(set.error().what);
    const std::string id(fixed.id, ::strnlen(fixed.id, sizeof fixed.id));
    display->info_ = {fmt::format("fbdev {} ({}, {})", path.substr(path.rfind('/') + 1), id,
                                  image::name_of(layout->format)),
                      layout->width, layout->height, layout->format, layout->refresh_hz};
    return display;
}

// DIRECTCOLOR sends each channel through a table, which must be straight for the picture to be
// ours.
Result<void> FbDisplay::set_linear_colors() {
    const image::PixelFormat& format = layout_.format;
    const int most = std::max({format.red.bits, format.green.bits, format.blue.bits});
    const std::size_t length = std::size_t{1} << most;
    ColorTable saved{std::vector<std::uint16_t>(length), std::vector<std::uint16_t>(length),
                     std::vector<std::uint16_t>(length)};
    const ColorTable linear{ramp(format.red.bits, length), ramp(format.green.bits, length),
                            ramp(format.blue.bits, length)};
    Errno error = device_->get_colors(saved);
    if (error == 0) error = device_->set_colors(linear);
    if (error != 0)
        return fail(Exit::no_display, "its colour table cannot be set: {}", std::strerror(error));
    saved_colors_ = std::move(saved);
    return {};
}

FbDisplay::~FbDisplay() {
    if (!saved_colors_.red.empty()) device_->set_colors(saved_colors_);
}

Result<void> FbDisplay::present(const image::Image& frame, std::span<const image::Rect> damage) {
    CHECK(ready());
    CHECK_EQ(frame.width(), info_.width);
    CHECK_EQ(frame.height(), info_.height);
    const image::Rect whole{0, 0, info_.width, info_.height};
    if (!shown_ || activations_ != seat_.activations()) damage = {&whole, 1};
    shown_ = true;
    activations_ = seat_.activations();
    port::copy_damage(layout_.format, frame, damage, memory_ + layout_.first, layout_.pitch);
    return {};
}

} // namespace scanout::linux_fb
