// A display in memory: `view --backend headless` and the tests present to it. It keeps only the
// bytes that a display of this pixel format would hold, so its picture went through the same
// encoding as on other displays.
#pragma once

#include "port/display.h"

#include <cstdint>
#include <vector>

namespace scanout::port {

class HeadlessDisplay final : public Display {
public:
    // Exit::usage when the size is not 1 to 16384 a side or the format cannot be written.
    static Result<HeadlessDisplay> create(int width, int height, const image::PixelFormat& format,
                                          double refresh_hz = 60);

    const DisplayInfo& info() const override { return info_; }
    bool ready() const override { return true; }
    Result<void> present(const image::Image& frame, std::span<const image::Rect> damage) override;
    bool paced() const override { return false; }
    int event_fd() const override { return -1; }
    Result<void> dispatch() override { return {}; }
    bool lost() const override { return false; }

    // The last frame as the display shows it; black before the first.
    image::Image shown() const;
    // Its bytes, rows from the top, no padding.
    std::span<const std::uint8_t> bytes() const { return bytes_; }
    std::size_t frames() const { return frames_; }

private:
    explicit HeadlessDisplay(DisplayInfo info);
    std::size_t pitch() const { return bytes_.size() / static_cast<std::size_t>(info_.height); }
    DisplayInfo info_;
    std::vector<std::uint8_t> bytes_;
    std::size_t frames_ = 0;
};

} // namespace scanout::port
