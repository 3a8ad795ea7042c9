#include "raster/tile.h"

#include "raster/coverage.h"
#include "raster/screen.h"

#include <algorithm>
#include <cmath>

namespace scanout::raster {

void VisibilityTile::reset(const image::Rect& area, int samples) {
    area_ = area;
    samples_ = samples;
    pattern_ = sample_pattern(samples);
    touched_ = false;
    const std::size_t size = kPlane * static_cast<std::size_t>(samples);
    depth_.assign(size, 0.0F);
    id_.assign(size + 16, kNoPrimitive);
}

image::Rect VisibilityTile::inside(const image::Rect& r) const {
    return {std::max(r.x0, area_.x0), std::max(r.y0, area_.y0), std::min(r.x1, area_.x1),
            std::min(r.y1, area_.y1)};
}

void VisibilityTile::draw(std::span<const Triangle> triangles) {
    touched_ |= draw_triangles({area_, pattern_, depth_.data(), id_.data()}, triangles);
}

void VisibilityTile::put_pixel(int x, int y, float depth, std::uint32_t id) {
    if (x < area_.x0 || x >= area_.x1 || y < area_.y0 || y >= area_.y1) return;
    for (int s = 0; s < samples_; ++s)
        put(offset(x, y, s), depth, id);
}

namespace {

std::int64_t floor_divide(std::int64_t a, std::int64_t b) { // b > 0
    return a / b - (a % b < 0 ? 1 : 0);
}

// Lines lie on the surfaces that they outline: they come forward by the line's own slope across one
// pixel and a few steps of the depth's precision (HARD-CASES R19).
float line_depth(double depth, double slope_per_pixel) {
    return static_cast<float>(depth + (slope_per_pixel + depth * 0x1p-19));
}

} // namespace

// One pixel for every pixel centre that the line passes on its longer axis, both ends included; the
// pixel on the other axis by exact division. [A 2.1], [C 4.1]: Bresenham's pixels in closed form,
// so that no error adds up and any part of a line can be drawn alone.
void VisibilityTile::draw(const Segment& s) {
    const image::Rect box = inside(pixel_bounds(s, area_.x1, area_.y1));
    if (box.empty()) return;
    const std::int64_t dx = std::int64_t{s.x[1]} - s.x[0], dy = std::int64_t{s.y[1]} - s.y[0];
    const bool along_x = std::abs(dx) >= std::abs(dy);
    const std::int64_t length = along_x ? std::abs(dx) : std::abs(dy);
    if (length == 0) {
        put_pixel(s.x[0] >> kSubpixelBits, s.y[0] >> kSubpixelBits,
                  line_depth(std::max(s.depth[0], s.depth[1]), 0), s.id);
        return;
    }
    // Walk from the end with the lower coordinate, whichever the file names first.
    const auto& major = along_x ? s.x : s.y;
    const auto& minor = along_x ? s.y : s.x;
    const std::size_t lo = major[0] <= major[1] ? 0 : 1, hi = 1 - lo;
    const std::int64_t rise = std::int64_t{minor[hi]} - minor[lo];
    const double slope =
        std::abs(s.depth[1] - s.depth[0]) * kSubpixel / static_cast<double>(length);
    const int first = along_x ? box.x0 : box.y0, last = along_x ? box.x1 : box.y1;
    for (int pixel = first; pixel < last; ++pixel) {
        const std::int64_t along = std::int64_t{pixel} * kSubpixel + kSubpixel / 2 - major[lo];
        if (along < 0 || along > length) continue;
        const std::int64_t across = minor[lo] + floor_divide(along * rise, length);
        const auto other = static_cast<int>(across >> kSubpixelBits);
        const double share = static_cast<double>(along) / static_cast<double>(length);
        const float depth = line_depth(s.depth[lo] * (1 - share) + s.depth[hi] * share, slope);
        put_pixel(along_x ? pixel : other, along_x ? other : pixel, depth, s.id);
    }
}

void VisibilityTile::draw(const Point& p) {
    const image::Rect box = inside(pixel_bounds(p, area_.x1, area_.y1));
    if (box.empty()) return;
    put_pixel(box.x0, box.y0, static_cast<float>(p.depth + p.depth * 0x1p-19), p.id);
}

} // namespace scanout::raster
