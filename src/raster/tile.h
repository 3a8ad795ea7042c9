// A tile's visibility buffer: at every sample the greatest depth and the primitive it belongs to,
// at a tie the lower id, or what another rule shows. The choice is commutative, so primitives may
// be drawn in any order.
#pragma once

#include "base/check.h"
#include "raster/coverage.h"
#include "raster/ground.h"
#include "raster/late_parts.h"
#include "raster/primitive.h"
#include "raster/sample_pattern.h"
#include "raster/small_triangles.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace scanout::raster {

// What a tile keeps of what is seen: shadow maps ask nothing but depth.
enum class Keeps : std::uint8_t { depth_and_id, depth };

class VisibilityTile {
public:
    // Makes the tile empty: `area` is at most kTileSize on a side. By another rule than the usual
    // one ids are kept in any case.
    void reset(const image::Rect& area, int samples, const VisibleRule& rule = {},
               Keeps keeps = Keeps::depth_and_id);

    // Triangles: does any of them show (raster/coverage.h)? Pixels beyond area() count, too.
    bool draw(const TriangleList& triangles);
    bool draw(const TilePartList& parts); // by the usual rule
    // The same, when what hides the most of them is drawn: find_farthest(), then these.
    void find_farthest() { raster::find_farthest(planes()); }
    bool draw_behind(const TilePartList& parts);
    // Is all that is no nearer hidden in these pixels of the picture? By the usual rule.
    bool hides(const image::Rect& pixels, float nearest) {
        return touched_ && raster::hides(planes(), pixels, nearest);
    }
    LateParts& late_parts() { return late_parts_; }
    // Lists of parts that hold all that shows, while what they list is there; null where something
    // else may show. Of those that were drawn behind them none shows then.
    const std::vector<TilePartList>* parts_alone() const { return others_ ? nullptr : &parts_; }
    bool draw(std::span<const SnappedTriangle> triangles);
    bool draw(const Triangle& triangle);
    bool draw(const PieceSetUp& piece);
    bool draw(const Piece& piece);
    // What is drawn there so far, all triangles, is the ground, as a rule of this very tile: lines
    // and points that follow are held against it, not against each other's pixels, so that their
    // order does not matter.
    void keep_ground(const VisibilityTile& from);
    void draw(const Segment& segment, const Ground& ground = {});
    void draw(const Point& point, const Ground& ground = {});

    // Shows the primitive at one sample if it is the nearest there. depth: as it is kept.
    void draw(int x, int y, int sample, float depth, std::uint32_t id) {
        put(offset(x, y, sample), depth, id);
    }
    // Samples of these pixels become what they are in a tile of the same area.
    void take(const VisibilityTile& from, const image::Rect& pixels);

    const image::Rect& area() const { return area_; }
    int samples() const { return samples_; }
    const VisibleRule& rule() const { return rule_; }
    std::span<const SampleOffset> pattern() const { return pattern_; }
    bool empty() const { return !touched_; }
    bool keeps_ids() const { return keeps_ == Keeps::depth_and_id; }
    std::size_t bytes() const {
        return depth_.capacity() * sizeof(float) + id_.capacity() * sizeof(std::uint32_t);
    }

    // x, y: a pixel of the picture inside area(). Ids: of a tile that keeps them.
    std::uint32_t id(int x, int y, int sample = 0) const {
        CHECK(keeps_ids());
        return id_[offset(x, y, sample)];
    }
    float depth(int x, int y, int sample = 0) const { return depth_[offset(x, y, sample)]; }
    // A sample's plane from the tile's corner on, kTileSize pixels a row. Kernels may touch a
    // register beyond the last plane.
    static constexpr std::size_t kPlane = std::size_t{kTileSize} * kTileSize;
    std::span<const std::uint32_t> ids(int sample) const {
        CHECK(keeps_ids());
        return std::span(id_).subspan(static_cast<std::size_t>(sample) * kPlane, kPlane);
    }
    std::span<const float> depths(int sample) const {
        return std::span(depth_).subspan(static_cast<std::size_t>(sample) * kPlane, kPlane);
    }

private:
    std::size_t offset(int x, int y, int sample) const {
        return static_cast<std::size_t>(sample) * kPlane +
               static_cast<std::size_t>((y - area_.y0) * kTileSize + (x - area_.x0));
    }
    image::Rect inside(const image::Rect& bounds) const;
    TilePlanes planes() {
        return {area_, pattern_,        depth_.data(), keeps_ids() ? id_.data() : nullptr,
                rule_, farthest_.data()};
    }
    // Shows the primitive at one sample if it is the nearest there.
    void put(std::size_t sample, float depth, std::uint32_t id) {
        const bool ids = keeps_ids();
        others_ = true;
        if (!rule_.shows(depth, id, depth_[sample], ids ? id_[sample] : 0)) return;
        depth_[sample] = depth;
        if (ids) id_[sample] = id;
        touched_ = true;
    }
    // A pixel of a line or point: the pixel, the place on the line that stands for it, in pixels,
    // and the depth there.
    struct Fragment {
        int x, y;
        double at_x, at_y, depth;
        std::uint32_t id;
    };
    struct Under { // the last triangle of the ground that was asked about
        std::uint32_t triangle = kNoPrimitive;
        Ground::Contact contact = Ground::Contact::none;
        DepthSlope slope;
    };
    void put_fragment(const Fragment& fragment, const Ground& ground, Under& under);

    image::Rect area_;
    int samples_ = 1;
    std::span<const SampleOffset> pattern_;
    VisibleRule rule_;
    Keeps keeps_ = Keeps::depth_and_id;
    bool touched_ = false;
    bool others_ = false; // something may show that is not in parts_
    std::vector<TilePartList> parts_;
    std::vector<float> depth_;
    std::vector<std::uint32_t> id_;
    std::array<float, (kTileSize / 8) * (kTileSize / 8)> farthest_{}; // TilePlanes
    std::vector<TilePart> seen_;                                      // of draw_behind
    LateParts late_parts_;
    std::vector<float> ground_depth_; // empty until lines or points come
    std::vector<std::uint32_t> ground_id_;
};

} // namespace scanout::raster
