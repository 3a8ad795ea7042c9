// Lines and points of raster/tile/tile.h, depth-tested against the triangles under them.
#include "raster/check_lanes.h"
#include "raster/coverage/depth_bias.h"
#include "raster/tile/tile.h"

#include <algorithm>
#include <cmath>

namespace scanout::raster {

namespace {

std::int64_t floor_divide(std::int64_t a, std::int64_t b) { // b > 0
    return a / b - (a % b < 0 ? 1 : 0);
}

// Moves a depth forward by no more than 2 r (HARD-CASES 17), in the stored format.
float forward(double depth, const DepthRule& rule) {
    const auto z = static_cast<float>(depth);
    const double bias = std::max(depth_bias({.constant = 2}, z, 0), 2 * rule.step(z));
    return rule.stored(static_cast<float>(double{z} + bias));
}

// How far a line may lie behind a triangle that it does not belong to and still be visible: both
// were snapped by up to 1/512 pixel in x and in y, and the triangle's plane is extended beyond its
// edge. At most the triangle's own extent in depth, even where it is seen edge-on.
double slack(const DepthSlope& slope, float depth) {
    const double steepest = std::max(std::abs(slope.per_x), std::abs(slope.per_y)),
                 most = slope.highest - slope.lowest + 2 * depth_step(depth);
    return depth_bias({.constant = 2, .slope_scale = 1.0 / 64, .clamp = most}, depth, steepest);
}

// Does a point lie in the diamond |x| + |y| <= 1/2 about the centre of its pixel?
bool in_diamond(std::int64_t x, std::int64_t y) {
    constexpr std::int64_t kCentre = kSubpixel / 2;
    const auto off = [](std::int64_t v) { return std::abs((v & (kSubpixel - 1)) - kCentre); };
    return off(x) + off(y) <= kCentre;
}

} // namespace

// The line's depth is known on the line, the supporting triangle's at samples up to a pixel beside
// it. The triangle's depth is carried over to the line along its own plane, so that no slope,
// however steep, occludes a line on the triangle or shows a line behind it. It is clamped to the
// depths of the triangle's vertices, where the plane ends.
void VisibilityTile::write_fragment(const Fragment& f, const LineSupport& support,
                                    SupportAt& under) {
    if (f.x < area_.x0 || f.x >= area_.x1 || f.y < area_.y0 || f.y >= area_.y1) return;
    for (int s = 0; s < samples_; ++s) {
        const std::size_t at = offset(f.x, f.y, s);
        const std::uint32_t triangle = support_id_.empty() ? kNoPrimitive : support_id_[at];
        if (triangle == kNoPrimitive) {
            write(at, forward(f.depth, rule_), f.id);
            continue;
        }
        if (triangle != under.triangle) {
            under = {triangle, support.contact(triangle, f.id), {}};
            if (under.contact != LineSupport::Contact::holds) under.slope = support.slope(triangle);
        }
        const float there = support_depth_[at];
        double height = 0; // of the line above the triangle
        if (under.contact != LineSupport::Contact::holds) {
            const SampleOffset sample = pattern_[static_cast<std::size_t>(s)];
            const double dx = f.at_x - (f.x + sample.x / double{kSubpixel}),
                         dy = f.at_y - (f.y + sample.y / double{kSubpixel});
            const DepthSlope& slope = under.slope;
            const double carried = double{there} + (slope.per_x * dx + slope.per_y * dy);
            height = f.depth - std::clamp(carried, slope.lowest, slope.highest);
            const bool behind = height < -slack(slope, there);
            // The next triangle of the line's own surface occludes the part of the line behind it,
            // but not the part beside it.
            if (behind && (under.contact == LineSupport::Contact::none ||
                           support.covers(triangle, f.at_x, f.at_y)))
                continue;
        }
        write(at, forward(double{there} + std::max(height, 0.0), rule_), f.id);
    }
}

// Draws the pixels whose diamonds |x| + |y| <= 1/2 the line touches: the diamond-exit rule
// (HARD-CASES R13, R14) but for the last pixel, which that rule leaves out. So the pixels do not
// depend on the line's direction, and joined lines leave no gap (HARD-CASES 49, P10). On the longer
// axis a line touches the diamond of each centre that it passes, and that of an end that lies in
// one. An exact division finds the pixel on the other axis: these are the pixels of Bresenham 1965
// in closed form ([Compendium 2.1], [Primer 4.1]); no error adds up, and any part of a line can be
// drawn alone (HARD-CASES 50).
void VisibilityTile::draw_line(const Segment& s, const LineSupport& support) {
    check_lanes(s);
    const image::Rect box = inside(pixel_bounds(s, area_.x1, area_.y1));
    if (box.empty() || support.is_culled(s.id)) return;
    SupportAt under;
    const bool along_x = is_along_x(s);
    const std::int64_t wider = std::int64_t{s.width - 1} * (kSubpixel / 2);
    // The pixels beside each other across the line.
    const auto write_across = [&](std::int64_t along, std::int64_t across, Fragment f) {
        const auto first = static_cast<int>((across - wider) >> kSubpixelBits);
        for (int other = first; other < first + s.width; ++other) {
            f.x = static_cast<int>(along_x ? along : other);
            f.y = static_cast<int>(along_x ? other : along);
            write_fragment(f, support, under);
        }
    };
    // Walks from the end with the lower coordinate, independently of the file's order.
    const auto& major = along_x ? s.x : s.y;
    const auto& minor = along_x ? s.y : s.x;
    const std::size_t lo = major[0] <= major[1] ? 0 : 1, hi = 1 - lo;
    const std::int64_t length = std::int64_t{major[hi]} - major[lo],
                       rise = std::int64_t{minor[hi]} - minor[lo];
    if (length == 0) {
        write_across(major[0] >> kSubpixelBits, minor[0],
                     {0, 0, s.x[0] / double{kSubpixel}, s.y[0] / double{kSubpixel},
                      std::max(s.depth[0], s.depth[1]), s.id});
        return;
    }
    const int first = along_x ? box.x0 : box.y0, last = along_x ? box.x1 : box.y1;
    for (int pixel = first; pixel < last; ++pixel) {
        const std::int64_t centre = std::int64_t{pixel} * kSubpixel + kSubpixel / 2 - major[lo],
                           along = std::clamp<std::int64_t>(centre, 0, length);
        if (along != centre && !in_diamond(major[lo] + along, minor[along == 0 ? lo : hi]))
            continue;
        const std::int64_t across = minor[lo] + floor_divide(along * rise, length);
        const double t = static_cast<double>(along) / static_cast<double>(length);
        const double middle = static_cast<double>(major[lo] + along) / kSubpixel;
        const double beside = (minor[lo] + static_cast<double>(rise) * t) / kSubpixel;
        const double depth = s.depth[lo] * (1 - t) + s.depth[hi] * t;
        write_across(pixel, across,
                     {0, 0, along_x ? middle : beside, along_x ? beside : middle, depth, s.id});
    }
}

void VisibilityTile::draw_point(const Point& p, const LineSupport& support) {
    check_lanes(p);
    const image::Rect box = inside(pixel_bounds(p, area_.x1, area_.y1));
    if (box.empty()) return;
    SupportAt under;
    for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x)
            write_fragment({x, y, p.x / double{kSubpixel}, p.y / double{kSubpixel}, p.depth, p.id},
                           support, under);
}

} // namespace scanout::raster
