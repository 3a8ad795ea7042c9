#include "trace/texture.h"

#include "math/srgb.h"

#include <algorithm>
#include <cmath>

namespace scanout::trace {
namespace {

Edges edges_of(scene::Wrap own, Edges asked) {
    if (asked != Edges::as_the_map_says) return asked;
    switch (own) {
    case scene::Wrap::clamp:
        return Edges::clamp;
    case scene::Wrap::mirror:
        return Edges::mirror;
    default:
        return Edges::repeat;
    }
}

// Into [0, 1].
double inside(double t, Edges edges) {
    if (!(std::abs(t) < 0x1p30)) return 0;
    switch (edges) {
    case Edges::clamp:
        return std::clamp(t, 0.0, 1.0);
    case Edges::mirror: {
        const double there_and_back = t - 2 * std::floor(t / 2);
        return there_and_back > 1 ? 2 - there_and_back : there_and_back;
    }
    default:
        return t - std::floor(t);
    }
}

int neighbour(int i, int size, Edges edges) {
    if (edges == Edges::repeat) return i < 0 ? i + size : (i >= size ? i - size : i);
    return std::clamp(i, 0, size - 1);
}

DVec4 light_of(const image::Rgba8& code, bool encoded) {
    const auto& table = encoded ? scanout::detail::kSrgb.decode : scanout::detail::kSrgb.linear;
    return {double{table[code.r]}, double{table[code.g]}, double{table[code.b]}, code.a / 255.0};
}

} // namespace

DVec4 texel(const scene::Texture& texture, const scene::TextureMap& map, Edges asked,
            const DVec2& uv, bool encoded) {
    const image::Image& image = texture.image;
    const Edges across = edges_of(map.wrap_u, asked), up = edges_of(map.wrap_v, asked);
    const double u = inside(uv.x * map.scale.x + map.offset.x, across),
                 v = inside(uv.y * map.scale.y + map.offset.y, up);
    // Texel centres lie at half-integers; v runs up, rows run down.
    const double x = u * image.width() - 0.5, y = v * image.height() - 0.5;
    const double left = std::floor(x), below = std::floor(y);
    const auto at = [&](int dx, int dy) {
        const int column = neighbour(static_cast<int>(left) + dx, image.width(), across),
                  row = neighbour(static_cast<int>(below) + dy, image.height(), up);
        return light_of(image.row(image.height() - 1 - row)[static_cast<std::size_t>(column)],
                        encoded);
    };
    const double fx = x - left, fy = y - below;
    const DVec4 low = at(0, 0) * (1 - fx) + at(1, 0) * fx;
    const DVec4 high = at(0, 1) * (1 - fx) + at(1, 1) * fx;
    return low * (1 - fy) + high * fy;
}

double scalar_of(const DVec4& t, char channel) {
    switch (channel) {
    case 'r':
        return t.x;
    case 'g':
        return t.y;
    case 'b':
        return t.z;
    case 'm':
        return t.w;
    default:
        return t.y + (0.2126 * (t.x - t.y) + 0.0722 * (t.z - t.y));
    }
}

} // namespace scanout::trace
