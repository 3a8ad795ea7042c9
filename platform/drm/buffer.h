// One frame's memory on the card: a dumb buffer, mapped, with its framebuffer, and the damage since
// it was last drawn (buffer age).
#pragma once

#include "base/result.h"
#include "image/image.h"
#include "image/pixel_format.h"
#include "platform/drm/device.h"

#include <cstdint>
#include <span>
#include <vector>

namespace scanout::drm {

class Buffer {
public:
    // Errors say which call failed. The device outlives the buffer.
    static Result<Buffer> create(Device& device, int width, int height,
                                 const image::PixelFormat& format);
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&&) = delete;
    ~Buffer();

    std::uint32_t framebuffer() const { return framebuffer_; }

    // Notes that `damage` has changed, or everything has, without drawing it.
    void damage(std::span<const image::Rect> damage);
    void damage_all() { all_ = true; }
    // Brings it up to date with `frame`; returns what was drawn, valid until the next call.
    std::span<const image::Rect> draw(const image::Image& frame, const image::PixelFormat& format);

private:
    explicit Buffer(Device& device) : device_(&device) {}

    Device* device_;
    DumbBuffer dumb_;
    std::uint8_t* memory_ = nullptr;
    std::uint32_t framebuffer_ = 0;
    bool all_ = true;
    std::vector<image::Rect> damage_, drawn_;
};

} // namespace scanout::drm
