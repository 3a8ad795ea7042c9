#include "port/copy.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace scanout::port {

void copy_damage(const image::PixelFormat& format, const image::Image& frame,
                 std::span<const image::Rect> damage, std::uint8_t* out, std::size_t pitch) {
    const auto bytes_per_pixel = static_cast<std::size_t>(format.bytes_per_pixel());
    // Encoded here first, then copied with the widest stores there are.
    std::vector<std::uint8_t> line(static_cast<std::size_t>(frame.width()) * bytes_per_pixel);
    for (const image::Rect& rect : damage) {
        const int x0 = std::max(rect.x0, 0), x1 = std::min(rect.x1, frame.width());
        if (x1 <= x0) continue;
        const auto first = static_cast<std::size_t>(x0), count = static_cast<std::size_t>(x1 - x0);
        for (int y = std::max(rect.y0, 0); y < std::min(rect.y1, frame.height()); ++y) {
            image::encode_row(format, frame.row(y).subspan(first, count), x0, y, line.data());
            std::memcpy(out + static_cast<std::size_t>(y) * pitch + first * bytes_per_pixel,
                        line.data(), count * bytes_per_pixel);
        }
    }
}

} // namespace scanout::port
