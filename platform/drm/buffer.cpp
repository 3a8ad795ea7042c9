#include "platform/drm/buffer.h"

#include "port/copy.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace scanout::drm {

Result<Buffer> Buffer::create(Device& device, int width, int height,
                              const image::PixelFormat& format) {
    const int bits = format.bits_per_pixel;
    const int depth = format.red.bits + format.green.bits + format.blue.bits;
    Buffer buffer(device);
    const auto failed = [](const char* call, Errno error) {
        return fail(Exit::no_display, "{}: {}", call, std::strerror(error));
    };
    if (const Errno error = device.create_dumb(width, height, bits, buffer.dumb_); error != 0)
        return failed("a dumb buffer cannot be made", error);
    if (const Errno error =
            device.add_framebuffer(width, height, depth, bits, buffer.dumb_, buffer.framebuffer_);
        error != 0)
        return failed("a framebuffer cannot be made", error);
    if (const Errno error = device.map(buffer.dumb_, buffer.memory_); error != 0)
        return failed("a dumb buffer cannot be mapped", error);
    return buffer;
}

Buffer::Buffer(Buffer&& other) noexcept
    : device_(other.device_), dumb_(std::exchange(other.dumb_, {})),
      memory_(std::exchange(other.memory_, nullptr)),
      framebuffer_(std::exchange(other.framebuffer_, 0)), all_(other.all_),
      damage_(std::move(other.damage_)), drawn_(std::move(other.drawn_)) {}

Buffer::~Buffer() {
    if (memory_ != nullptr) device_->unmap(memory_, dumb_);
    if (framebuffer_ != 0) device_->remove_framebuffer(framebuffer_);
    if (dumb_.handle != 0) device_->destroy_dumb(dumb_.handle);
}

void Buffer::damage(std::span<const image::Rect> damage) {
    if (all_) return;
    damage_.insert(damage_.end(), damage.begin(), damage.end());
    // Frames that pile up while another buffer is drawn must not grow the list for ever.
    constexpr std::size_t kMost = 64;
    if (damage_.size() <= kMost) return;
    image::Rect box = damage_.front();
    for (const image::Rect& rect : damage_)
        box = {std::min(box.x0, rect.x0), std::min(box.y0, rect.y0), std::max(box.x1, rect.x1),
               std::max(box.y1, rect.y1)};
    damage_ = {box};
}

std::span<const image::Rect> Buffer::draw(const image::Image& frame,
                                          const image::PixelFormat& format) {
    if (all_) damage_ = {image::Rect{0, 0, frame.width(), frame.height()}};
    port::copy_damage(format, frame, damage_, memory_, dumb_.pitch);
    all_ = false;
    std::swap(drawn_, damage_);
    damage_.clear(); // keeps its memory
    return drawn_;
}

} // namespace scanout::drm
