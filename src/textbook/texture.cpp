#include "textbook/texture.h"

#include "math/srgb.h"

#include <algorithm>
#include <cmath>

namespace scanout::textbook {
namespace {

// u = 1 is texel 0 of the repeated picture, and the last one of a clamped one: the document's
// (int)(u * (width - 1)) gives the last column to u = 1 alone.
int texel_of(double u, int size, bool clamped) {
    if (!(std::abs(u) < 0x1p30)) return 0;
    const double inside = clamped ? std::clamp(u, 0.0, 1.0) : u - std::floor(u);
    return std::min(static_cast<int>(inside * size), size - 1);
}

} // namespace

DVec3 nearest_texel(const image::Image& image, const scene::TextureMap& map, double u, double v) {
    const int x = texel_of(u * map.scale.x + map.offset.x, image.width(), map.clamp),
              y = texel_of(v * map.scale.y + map.offset.y, image.height(), map.clamp);
    const image::Rgba8& code = image.at(x, image.height() - 1 - y);
    return {srgb_decode(code.r), srgb_decode(code.g), srgb_decode(code.b)};
}

} // namespace scanout::textbook
