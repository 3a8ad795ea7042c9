#include "textbook/texture.h"

#include "math/srgb.h"

#include <algorithm>
#include <cmath>

namespace scanout::textbook {
namespace {

// u = 1 is texel 0 of the repeated picture, and the last one of a clamped or mirrored one: the
// document's (int)(u * (width - 1)) gives the last column to u = 1 alone.
int texel_of(double u, int size, scene::Wrap wrap) {
    if (!(std::abs(u) < 0x1p30)) return 0;
    double inside = u - std::floor(u);
    if (wrap == scene::Wrap::clamp) inside = std::clamp(u, 0.0, 1.0);
    if (wrap == scene::Wrap::mirror) inside = 1 - std::abs(u - 2 * std::floor(u / 2) - 1);
    return std::min(static_cast<int>(inside * size), size - 1);
}

} // namespace

DVec3 nearest_texel(const image::Image& image, const scene::TextureMap& map, double u, double v) {
    const int x = texel_of(u * map.scale.x + map.offset.x, image.width(), map.wrap_u),
              y = texel_of(v * map.scale.y + map.offset.y, image.height(), map.wrap_v);
    const image::Rgba8& code = image.at(x, image.height() - 1 - y);
    return {srgb_decode(code.r), srgb_decode(code.g), srgb_decode(code.b)};
}

} // namespace scanout::textbook
