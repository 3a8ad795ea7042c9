#include "port/copy.h"

#include "base/check.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace scanout::port {
namespace {

constexpr std::size_t kPiece = 1024; // pixels
constexpr std::size_t kMaxBytes = 4; // a pixel

} // namespace

void copy_damage(const image::PixelFormat& format, const image::Image& frame,
                 std::span<const image::Rect> damage, std::uint8_t* out, std::size_t pitch) {
    const auto bytes_per_pixel = static_cast<std::size_t>(format.bytes_per_pixel());
    CHECK(bytes_per_pixel <= kMaxBytes);
    // Encoded here first, piece by piece, then copied with the widest stores there are.
    std::array<std::uint8_t, kPiece * kMaxBytes> piece{};
    for (const image::Rect& rect : damage) {
        const int x0 = std::max(rect.x0, 0), x1 = std::min(rect.x1, frame.width());
        if (x1 <= x0) continue;
        const auto end = static_cast<std::size_t>(x1);
        for (int y = std::max(rect.y0, 0); y < std::min(rect.y1, frame.height()); ++y) {
            std::uint8_t* const row = out + static_cast<std::size_t>(y) * pitch;
            for (auto x = static_cast<std::size_t>(x0); x < end; x += kPiece) {
                const std::size_t count = std::min(kPiece, end - x);
                image::encode_row(format, frame.row(y).subspan(x, count), static_cast<int>(x), y,
                                  piece.data());
                std::memcpy(row + x * bytes_per_pixel, piece.data(), count * bytes_per_pixel);
            }
        }
    }
}

} // namespace scanout::port
