#include "raster/tile.h"

#include "raster/screen.h"

#include <algorithm>
#include <cmath>

namespace scanout::raster {

void VisibilityTile::reset(const image::Rect& area, int samples) {
    area_ = area;
    samples_ = samples;
    pattern_ = sample_pattern(samples);
    extent_ = extent_of(pattern_);
    touched_ = false;
    const std::size_t size = static_cast<std::size_t>(kTileSize * kTileSize) * count();
    depth_.assign(size, 0.0F);
    id_.assign(size, kNoPrimitive);
}

image::Rect VisibilityTile::inside(const image::Rect& r) const {
    return {std::max(r.x0, area_.x0), std::max(r.y0, area_.y0), std::min(r.x1, area_.x1),
            std::min(r.y1, area_.y1)};
}

void VisibilityTile::draw(const Triangle& t) {
    const image::Rect box = inside(pixel_bounds(t, area_.x1, area_.y1, extent_));
    if (box.empty()) return;
    const Edges e = edges_of(t);
    const auto area = static_cast<double>(e.area);
    // Depth from the exact weights E / area, in double, rounded once. No term is negative, so
    // nothing cancels: reversed depth keeps its relative precision across any range of distances
    // (HARD-CASES 15).
    const double share[3] = {t.depth[0] / area, t.depth[1] / area, t.depth[2] / area};
    for (std::size_t s = 0; s < count(); ++s) {
        const SampleOffset at = pattern_[s];
        for (int y = box.y0; y < box.y1; ++y) {
            const std::int64_t sx = std::int64_t{box.x0} * kSubpixel + at.x;
            const std::int64_t sy = std::int64_t{y} * kSubpixel + at.y;
            std::int64_t e0 = e.at(0, sx, sy), e1 = e.at(1, sx, sy), e2 = e.at(2, sx, sy);
            std::size_t sample = offset(box.x0, y) + s;
            for (int x = box.x0; x < box.x1; ++x, sample += count()) {
                if (((e0 + e.bias[0]) | (e1 + e.bias[1]) | (e2 + e.bias[2])) >= 0) {
                    const double depth =
                        (static_cast<double>(e0) * share[0] + static_cast<double>(e1) * share[1]) +
                        static_cast<double>(e2) * share[2];
                    put(sample, static_cast<float>(depth), t.id);
                }
                e0 += e.a[0] * kSubpixel;
                e1 += e.a[1] * kSubpixel;
                e2 += e.a[2] * kSubpixel;
            }
        }
    }
}

void VisibilityTile::put_pixel(int x, int y, float depth, std::uint32_t id) {
    if (x < area_.x0 || x >= area_.x1 || y < area_.y0 || y >= area_.y1) return;
    const std::size_t first = offset(x, y);
    for (std::size_t s = 0; s < count(); ++s)
        put(first + s, depth, id);
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
