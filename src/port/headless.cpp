#include "port/headless.h"

#include "base/check.h"
#include "port/copy.h"

namespace scanout::port {

Result<HeadlessDisplay> HeadlessDisplay::create(int width, int height,
                                                const image::PixelFormat& format,
                                                double refresh_hz) {
    constexpr int kMaxSide = 16384;
    if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide)
        return fail(Exit::usage, "a headless display of {}x{} pixels: each side must be 1 to {}",
                    width, height, kMaxSide);
    TRY_VOID(image::check(format));
    DisplayInfo info{fmt::format("headless {}x{} {}", width, height, image::name_of(format)), width,
                     height, format, refresh_hz};
    return HeadlessDisplay(std::move(info));
}

HeadlessDisplay::HeadlessDisplay(DisplayInfo info)
    : info_(std::move(info)),
      bytes_(static_cast<std::size_t>(info_.width) * static_cast<std::size_t>(info_.height) *
             static_cast<std::size_t>(info_.format.bytes_per_pixel())) {}

Result<void> HeadlessDisplay::present(const image::Image& frame,
                                      std::span<const image::Rect> damage) {
    CHECK_EQ(frame.width(), info_.width);
    CHECK_EQ(frame.height(), info_.height);
    const image::Rect whole{0, 0, info_.width, info_.height};
    if (frames_++ == 0) damage = {&whole, 1};
    copy_damage(info_.format, frame, damage, bytes_.data(), pitch());
    return {};
}

image::Image HeadlessDisplay::shown() const {
    image::Image shown(info_.width, info_.height);
    for (int y = 0; y < info_.height; ++y)
        image::decode_row(info_.format, bytes_.data() + static_cast<std::size_t>(y) * pitch(),
                          shown.row(y));
    return shown;
}

} // namespace scanout::port
