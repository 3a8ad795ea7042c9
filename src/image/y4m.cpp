#include "image/animation.h"

#include <string_view>

#include <fmt/format.h>

namespace scanout::image {
namespace {

// a / b, rounded to the nearest whole number, halves up. b > 0.
constexpr int rounded_quotient(int a, int b) {
    const int twice = 2 * a + b;
    return (twice >= 0 ? twice : twice - 2 * b + 1) / (2 * b);
}
static_assert(rounded_quotient(-3, 2) == -1 && rounded_quotient(-4, 3) == -1 &&
              rounded_quotient(3, 2) == 2);

// BT.601: luma is 0.299 R + 0.587 G + 0.114 B, in codes 16 to 235; the differences of blue and red
// from it, which reach 0.886 and 0.701, are in codes 16 to 240. All in thousandths.
int luma(const Rgba8& p) {
    return 299 * p.r + 587 * p.g + 114 * p.b;
}
std::uint8_t luma_code(const Rgba8& p) {
    return static_cast<std::uint8_t>(16 + rounded_quotient(219 * luma(p), 255'000));
}
std::uint8_t blue_code(const Rgba8& p) {
    return static_cast<std::uint8_t>(128 +
                                     rounded_quotient(112 * (1000 * p.b - luma(p)), 886 * 255));
}
std::uint8_t red_code(const Rgba8& p) {
    return static_cast<std::uint8_t>(128 +
                                     rounded_quotient(112 * (1000 * p.r - luma(p)), 701 * 255));
}

} // namespace

std::string y4m_header(int width, int height, int frames_per_second) {
    return fmt::format("YUV4MPEG2 W{} H{} F{}:1 Ip A1:1 C444 XCOLORRANGE=LIMITED\n", width, height,
                       frames_per_second);
}

Bytes y4m_frame(const Image& picture) {
    constexpr std::string_view kMark = "FRAME\n";
    Bytes out(kMark.begin(), kMark.end());
    out.reserve(kMark.size() + picture.pixels().size() * 3);
    for (const auto code : {luma_code, blue_code, red_code})
        for (const Rgba8& pixel : picture.pixels())
            out.push_back(code(pixel));
    return out;
}

} // namespace scanout::image
