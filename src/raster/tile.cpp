#include "raster/tile.h"

#include "raster/check_lanes.h"
#include "raster/coverage.h"
#include "raster/depth_bias.h"
#include "raster/piece_set_up.h"
#include "raster/screen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

namespace scanout::raster {
namespace {

// Words whose bytes are all the same: several times as fast as word by word.
template <class Word>
void fill_bytes(std::vector<Word>& words, std::size_t size, int byte) {
    words.resize(size);
    std::memset(words.data(), byte, size * sizeof(Word));
}

} // namespace

void VisibilityTile::reset(const image::Rect& area, int samples, const VisibleRule& rule,
                           Keeps keeps) {
    rule_ = rule;
    keeps_ = rule.usual() ? keeps : Keeps::depth_and_id;
    area_ = area;
    samples_ = samples;
    pattern_ = sample_pattern(samples);
    touched_ = others_ = false;
    parts_.clear();
    const std::size_t size = kPlane * static_cast<std::size_t>(samples);
    fill_bytes(depth_, size + kRegisterRoom, 0);
    static_assert(kNoPrimitive == ~std::uint32_t{0});
    if (keeps_ids()) fill_bytes(id_, size + kRegisterRoom, 0xff);
    farthest_.fill(0);
    ground_depth_.clear();
    ground_id_.clear();
}

image::Rect VisibilityTile::inside(const image::Rect& r) const {
    return {std::max(r.x0, area_.x0), std::max(r.y0, area_.y0), std::min(r.x1, area_.x1),
            std::min(r.y1, area_.y1)};
}

bool VisibilityTile::draw(const Triangle& t) {
    SnappedTriangle snapped{{}, t.id};
    for (std::size_t k = 0; k < 3; ++k)
        snapped.corner[k] = {t.x[k], t.y[k], t.depth[k]};
    return draw(std::span(&snapped, 1));
}

bool VisibilityTile::draw(const TriangleList& triangles) {
    check_lanes(triangles);
    others_ = true;
    const bool shows = draw_triangles(planes(), triangles);
    touched_ |= shows;
    return shows;
}

bool VisibilityTile::draw(const TilePartList& parts) {
    check_lanes(parts);
    TilePlanes to = planes();
    // Where nothing hides, or too few to be worth it, or all are tiny, no part need be asked.
    bool hides =
        touched_ && parts.parts.size() >= farthest_.size() && parts.kind == PartKind::strip;
    if (hides) {
        find_farthest();
        hides = std::any_of(farthest_.begin(), farthest_.end(), [](float f) { return f > 0; });
    }
    if (!hides) to.farthest = nullptr;
    const bool shows = draw_parts(to, parts);
    if (shows) parts_.push_back(parts);
    touched_ |= shows;
    return shows;
}

bool VisibilityTile::draw_behind(const TilePartList& parts) {
    check_lanes(parts);
    const bool shows = draw_parts_behind(planes(), parts, seen_);
    others_ |= shows; // in few tiles: looking for all of them there would not pay
    touched_ |= shows;
    return shows;
}

bool VisibilityTile::draw(std::span<const SnappedTriangle> triangles) {
    constexpr std::size_t kMost = 16;
    std::array<ScreenVertex, kMost * 3> vertex;
    std::array<std::uint32_t, kMost * 3> place;
    std::array<std::uint32_t, kMost> id;
    std::iota(place.begin(), place.end(), 0U);
    bool shows = false;
    for (; !triangles.empty(); triangles = triangles.subspan(std::min(triangles.size(), kMost))) {
        const std::size_t count = std::min(triangles.size(), kMost);
        for (std::size_t i = 0; i < count; ++i) {
            std::copy_n(triangles[i].corner.begin(), 3, vertex.data() + i * 3);
            id[i] = triangles[i].id;
        }
        shows |= draw(
            TriangleList{vertex, place, std::span(place).first(count), std::span(id).first(count)});
    }
    return shows;
}

bool VisibilityTile::draw(const Piece& piece) {
    return draw(PieceSetUp(piece, extent_of(pattern_)));
}

bool VisibilityTile::draw(const PieceSetUp& piece) {
    check_lanes(piece.piece);
    others_ = true;
    const bool shows = draw_piece(planes(), piece);
    touched_ |= shows;
    return shows;
}

void VisibilityTile::take(const VisibilityTile& from, const image::Rect& pixels) {
    CHECK(from.keeps_ids() || !keeps_ids());
    const image::Rect r = inside(pixels);
    farthest_.fill(0);
    others_ = true;
    for (int sample = 0; sample < samples_; ++sample) {
        for (int y = r.y0; y < r.y1; ++y) {
            const auto begin = static_cast<std::ptrdiff_t>(offset(r.x0, y, sample));
            const auto end = begin + r.width();
            if (keeps_ids())
                std::copy(from.id_.begin() + begin, from.id_.begin() + end, id_.begin() + begin);
            std::copy(from.depth_.begin() + begin, from.depth_.begin() + end,
                      depth_.begin() + begin);
        }
    }
}

void VisibilityTile::keep_ground(const VisibilityTile& from) {
    const std::size_t size = kPlane * static_cast<std::size_t>(samples_);
    const auto end = static_cast<std::ptrdiff_t>(size);
    CHECK(from.keeps_ids());
    ground_depth_.assign(from.depth_.begin(), from.depth_.begin() + end);
    ground_id_.assign(from.id_.begin(), from.id_.begin() + end);
}

namespace {

std::int64_t floor_divide(std::int64_t a, std::int64_t b) { // b > 0
    return a / b - (a % b < 0 ? 1 : 0);
}

// In front of what lies at this depth by no more than 2 r (HARD-CASES 17), as it is kept.
float forward(double depth, const VisibleRule& rule) {
    const auto z = static_cast<float>(depth);
    const double bias = std::max(depth_bias({.constant = 2}, z, 0), 2 * rule.step());
    return rule.kept(static_cast<float>(double{z} + bias));
}

// How far behind a triangle that it does not belong to a line may be and still be seen: both were
// snapped by up to 1/512 pixel in x and in y, and the triangle's plane is carried beyond its edge.
// Never more than the triangle's own extent in depth, be it seen edge-on.
double slack(const DepthSlope& slope, float depth) {
    const double steepest = std::max(std::abs(slope.per_x), std::abs(slope.per_y)),
                 most = slope.highest - slope.lowest + 2 * depth_step(depth);
    return depth_bias({.constant = 2, .slope_scale = 1.0 / 64, .clamp = most}, depth, steepest);
}

} // namespace

// The depth of a line is known on the line, that of the ground at samples up to a pixel beside it:
// so the ground's depth is carried over to the line along the triangle's own plane, and no slope,
// however steep, hides a line that lies on the triangle or shows one behind it. A triangle is
// nowhere nearer or farther than its corners: there the plane ends.
void VisibilityTile::put_fragment(const Fragment& f, const Ground& ground, Under& under) {
    if (f.x < area_.x0 || f.x >= area_.x1 || f.y < area_.y0 || f.y >= area_.y1) return;
    for (int s = 0; s < samples_; ++s) {
        const std::size_t at = offset(f.x, f.y, s);
        const std::uint32_t triangle = ground_id_.empty() ? kNoPrimitive : ground_id_[at];
        if (triangle == kNoPrimitive) {
            put(at, forward(f.depth, rule_), f.id);
            continue;
        }
        if (triangle != under.triangle) {
            under = {triangle, ground.contact(triangle, f.id), {}};
            if (under.contact != Ground::Contact::holds) under.slope = ground.slope(triangle);
        }
        const float there = ground_depth_[at];
        double height = 0; // of the line above the triangle
        if (under.contact != Ground::Contact::holds) {
            const SampleOffset sample = pattern_[static_cast<std::size_t>(s)];
            const double dx = f.at_x - (f.x + sample.x / double{kSubpixel}),
                         dy = f.at_y - (f.y + sample.y / double{kSubpixel});
            const DepthSlope& slope = under.slope;
            const double carried = double{there} + (slope.per_x * dx + slope.per_y * dy);
            height = f.depth - std::clamp(carried, slope.lowest, slope.highest);
            const bool behind = height < -slack(slope, there);
            // The next triangle of the line's own surface hides what is behind it, but not what
            // is beside it.
            if (behind &&
                (under.contact == Ground::Contact::none || ground.covers(triangle, f.at_x, f.at_y)))
                continue;
        }
        put(at, forward(double{there} + std::max(height, 0.0), rule_), f.id);
    }
}

// One pixel for every pixel centre that the line passes on its longer axis, both ends included; the
// pixel on the other axis by exact division. The pixels of Bresenham 1965, in closed form
// ([Compendium 2.1], [Primer 4.1]), so that no error adds up and any part of a line can be drawn
// alone.
void VisibilityTile::draw(const Segment& s, const Ground& ground) {
    check_lanes(s);
    const image::Rect box = inside(pixel_bounds(s, area_.x1, area_.y1));
    if (box.empty()) return;
    Under under;
    const std::int64_t dx = std::int64_t{s.x[1]} - s.x[0], dy = std::int64_t{s.y[1]} - s.y[0];
    const bool along_x = std::abs(dx) >= std::abs(dy);
    const std::int64_t length = along_x ? std::abs(dx) : std::abs(dy);
    if (length == 0) {
        put_fragment({s.x[0] >> kSubpixelBits, s.y[0] >> kSubpixelBits, s.x[0] / double{kSubpixel},
                      s.y[0] / double{kSubpixel}, std::max(s.depth[0], s.depth[1]), s.id},
                     ground, under);
        return;
    }
    // Walk from the end with the lower coordinate, whichever the file names first.
    const auto& major = along_x ? s.x : s.y;
    const auto& minor = along_x ? s.y : s.x;
    const std::size_t lo = major[0] <= major[1] ? 0 : 1, hi = 1 - lo;
    const std::int64_t rise = std::int64_t{minor[hi]} - minor[lo];
    const int first = along_x ? box.x0 : box.y0, last = along_x ? box.x1 : box.y1;
    for (int pixel = first; pixel < last; ++pixel) {
        const std::int64_t along = std::int64_t{pixel} * kSubpixel + kSubpixel / 2 - major[lo];
        if (along < 0 || along > length) continue;
        const std::int64_t across = minor[lo] + floor_divide(along * rise, length);
        const auto other = static_cast<int>(across >> kSubpixelBits);
        const double share = static_cast<double>(along) / static_cast<double>(length);
        const double middle = pixel + 0.5;
        const double beside = (minor[lo] + static_cast<double>(rise) * share) / kSubpixel;
        const double depth = s.depth[lo] * (1 - share) + s.depth[hi] * share;
        if (along_x)
            put_fragment({pixel, other, middle, beside, depth, s.id}, ground, under);
        else
            put_fragment({other, pixel, beside, middle, depth, s.id}, ground, under);
    }
}

void VisibilityTile::draw(const Point& p, const Ground& ground) {
    check_lanes(p);
    const image::Rect box = inside(pixel_bounds(p, area_.x1, area_.y1));
    if (box.empty()) return;
    Under under;
    put_fragment({box.x0, box.y0, p.x / double{kSubpixel}, p.y / double{kSubpixel}, p.depth, p.id},
                 ground, under);
}

} // namespace scanout::raster
