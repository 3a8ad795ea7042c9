#include "raster/tile/tile.h"

#include "raster/check_lanes.h"
#include "raster/clipped/clipped_setup.h"
#include "raster/coverage/coverage.h"
#include "raster/screen/screen.h"

#include <algorithm>
#include <array>
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

void VisibilityTile::reset(const image::Rect& area, int samples, const DepthRule& rule,
                           TileFormat format) {
    rule_ = rule;
    format_ = rule.is_default() ? format : TileFormat::depth_and_id;
    area_ = area;
    samples_ = samples;
    pattern_ = sample_pattern(samples);
    touched_ = others_ = false;
    small_lists_.clear();
    const std::size_t size = kPlane * static_cast<std::size_t>(samples);
    fill_bytes(depth_, size + kRegisterPadding, 0);
    static_assert(kNoPrimitive == ~std::uint32_t{0});
    if (has_ids()) fill_bytes(id_, size + kRegisterPadding, 0xff);
    hi_z_.fill(0);
    support_depth_.clear();
    support_id_.clear();
}

image::Rect VisibilityTile::inside(const image::Rect& r) const {
    return {std::max(r.x0, area_.x0), std::max(r.y0, area_.y0), std::min(r.x1, area_.x1),
            std::min(r.y1, area_.y1)};
}

bool VisibilityTile::draw(const Triangle& t) {
    SnappedTriangle snapped{{}, t.id};
    for (std::size_t k = 0; k < 3; ++k)
        snapped.vertex[k] = {t.x[k], t.y[k], t.depth[k]};
    return draw(std::span(&snapped, 1));
}

bool VisibilityTile::draw(const TriangleList& triangles) {
    check_lanes(triangles);
    others_ = true;
    const bool visible = draw_triangles(planes(), triangles);
    touched_ |= visible;
    return visible;
}

bool VisibilityTile::draw_small(const BinnedList& triangles) {
    check_lanes(triangles);
    TilePlanes to = planes();
    // Skips hi_z where nothing occludes, where triangles are too few for it to pay, and where all
    // are micro-triangles.
    bool occluders =
        touched_ && triangles.triangles.size() >= hi_z_.size() && triangles.kind == SmallKind::rows;
    if (occluders) {
        build_hi_z();
        occluders = std::any_of(hi_z_.begin(), hi_z_.end(), [](float f) { return f > 0; });
    }
    if (!occluders) to.hi_z = nullptr;
    const bool visible = draw_small_triangles(to, triangles);
    if (visible) small_lists_.push_back(triangles);
    touched_ |= visible;
    return visible;
}

bool VisibilityTile::draw_small_hi_z(const BinnedList& triangles) {
    check_lanes(triangles);
    const bool visible = raster::draw_small_hi_z(planes(), triangles, hi_z_scratch_);
    others_ |= visible; // happens in few tiles: a search for all of them would not pay
    touched_ |= visible;
    return visible;
}

bool VisibilityTile::draw(std::span<const SnappedTriangle> triangles) {
    constexpr std::size_t kMax = 16;
    std::array<ScreenVertex, kMax * 3> vertex;
    std::array<std::uint32_t, kMax * 3> which;
    std::array<std::uint32_t, kMax> id;
    std::iota(which.begin(), which.end(), 0U);
    bool visible = false;
    for (; !triangles.empty(); triangles = triangles.subspan(std::min(triangles.size(), kMax))) {
        const std::size_t count = std::min(triangles.size(), kMax);
        for (std::size_t i = 0; i < count; ++i) {
            std::copy_n(triangles[i].vertex.begin(), 3, vertex.data() + i * 3);
            id[i] = triangles[i].id;
        }
        visible |= draw(
            TriangleList{vertex, which, std::span(which).first(count), std::span(id).first(count)});
    }
    return visible;
}

bool VisibilityTile::draw_clipped(const ClippedTriangle& clipped) {
    return draw_clipped(ClippedSetup(clipped, extent_of(pattern_)));
}

bool VisibilityTile::draw_clipped(const ClippedSetup& clipped) {
    check_lanes(clipped.triangle);
    others_ = true;
    const bool visible = raster::draw_clipped(planes(), clipped);
    touched_ |= visible;
    return visible;
}

void VisibilityTile::take(const VisibilityTile& from, const image::Rect& pixels) {
    CHECK(from.has_ids() || !has_ids());
    const image::Rect r = inside(pixels);
    hi_z_.fill(0);
    others_ = true;
    for (int sample = 0; sample < samples_; ++sample) {
        for (int y = r.y0; y < r.y1; ++y) {
            const auto to = static_cast<std::ptrdiff_t>(offset(r.x0, y, sample));
            const auto begin = static_cast<std::ptrdiff_t>(from.offset(r.x0, y, sample));
            const auto end = begin + r.width();
            if (has_ids())
                std::copy(from.id_.begin() + begin, from.id_.begin() + end, id_.begin() + to);
            std::copy(from.depth_.begin() + begin, from.depth_.begin() + end, depth_.begin() + to);
        }
    }
}

void VisibilityTile::keep_support(const VisibilityTile& from) {
    const std::size_t size = kPlane * static_cast<std::size_t>(samples_);
    const auto end = static_cast<std::ptrdiff_t>(size);
    CHECK(from.has_ids());
    support_depth_.assign(from.depth_.begin(), from.depth_.begin() + end);
    support_id_.assign(from.id_.begin(), from.id_.begin() + end);
}

} // namespace scanout::raster
