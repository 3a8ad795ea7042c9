// A tile's visibility buffer: at every sample the greatest depth and the id of its primitive, at
// equal depth the lower id, or as another depth rule decides. The choice is commutative, so
// primitives may be drawn in any order.
#pragma once

#include "base/check.h"
#include "raster/coverage/coverage.h"
#include "raster/micro/small_triangles.h"
#include "raster/screen/primitive.h"
#include "raster/screen/sample_pattern.h"
#include "raster/tile/line_support.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace scanout::raster {

// The planes that a tile stores: shadow maps need depth only.
enum class TileFormat : std::uint8_t { depth_and_id, depth_only };

class VisibilityTile {
public:
    // Clears the tile: `area` is at most kTileSize on a side. By another depth rule than the
    // default one ids are stored in any case.
    void reset(const image::Rect& area, int samples, const DepthRule& rule = {},
               TileFormat format = TileFormat::depth_and_id);

    // Draws triangles. Returns whether any passes the depth test (raster/coverage/coverage.h),
    // pixels beyond area() included.
    bool draw(const TriangleList& triangles);
    bool draw_small(const BinnedList& triangles); // by the default depth rule
    // The same, but tests them against hi_z before set-up. Call build_hi_z() after the occluders,
    // then this.
    void build_hi_z() { raster::build_hi_z(planes()); }
    bool draw_small_hi_z(const BinnedList& triangles);
    // Occlusion query: is everything at this depth or behind occluded in these pixels of the
    // picture? By the default depth rule.
    bool occludes(const image::Rect& pixels, float nearest) {
        return touched_ && raster::occludes(planes(), pixels, nearest);
    }
    // The lists of small triangles that hold everything visible; valid while their data exist. Null
    // where other primitives may be visible, as after draw_small_hi_z().
    const std::vector<BinnedList>* small_lists_alone() const {
        return others_ ? nullptr : &small_lists_;
    }
    bool draw(std::span<const SnappedTriangle> triangles);
    bool draw(const Triangle& triangle);
    bool draw_clipped(const ClippedSetup& clipped);
    bool draw_clipped(const ClippedTriangle& clipped);
    // Copies all triangles drawn so far out of a tile with the same area. Lines and points drawn
    // later are depth-tested against these, not against each other's pixels, so that their order
    // does not matter.
    void keep_support(const VisibilityTile& from);
    void draw_line(const Segment& segment, const LineSupport& support = {});
    void draw_point(const Point& point, const LineSupport& support = {});

    // Writes the primitive at one sample if it passes the depth test. depth: in the stored format.
    void draw_sample(int x, int y, int sample, float depth, std::uint32_t id) {
        write(offset(x, y, sample), depth, id);
    }
    // Copies the samples of these pixels from a tile whose area holds this one's.
    void take(const VisibilityTile& from, const image::Rect& pixels);

    const image::Rect& area() const { return area_; }
    int samples() const { return samples_; }
    const DepthRule& rule() const { return rule_; }
    std::span<const SampleOffset> pattern() const { return pattern_; }
    bool empty() const { return !touched_; }
    bool has_ids() const { return format_ == TileFormat::depth_and_id; }
    std::size_t bytes() const {
        return depth_.capacity() * sizeof(float) + id_.capacity() * sizeof(std::uint32_t);
    }

    // x, y: a pixel of the picture inside area(). Ids: of a tile that has them.
    std::uint32_t id(int x, int y, int sample = 0) const {
        CHECK(has_ids());
        return id_[offset(x, y, sample)];
    }
    float depth(int x, int y, int sample = 0) const { return depth_[offset(x, y, sample)]; }
    // A sample's plane from the tile's corner on, kTileSize pixels a row. Kernels may touch a
    // register beyond the last plane.
    static constexpr std::size_t kPlane = std::size_t{kTileSize} * kTileSize;
    std::span<const std::uint32_t> ids(int sample) const {
        CHECK(has_ids());
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
        return {area_, pattern_,    depth_.data(), has_ids() ? id_.data() : nullptr,
                rule_, hi_z_.data()};
    }
    // Writes the primitive at one sample if it passes the depth test.
    void write(std::size_t sample, float depth, std::uint32_t id) {
        const bool ids = has_ids();
        others_ = true;
        if (!rule_.passes(depth, id, depth_[sample], ids ? id_[sample] : 0)) return;
        depth_[sample] = depth;
        if (ids) id_[sample] = id;
        touched_ = true;
    }
    // A pixel of a line or point: the pixel, the position on the line that it stands for (pixels),
    // and the depth there.
    struct Fragment {
        int x, y;
        double at_x, at_y, depth;
        std::uint32_t id;
    };
    struct SupportAt { // the last triangle that was tested against
        std::uint32_t triangle = kNoPrimitive;
        LineSupport::Contact contact = LineSupport::Contact::none;
        DepthSlope slope;
    };
    void write_fragment(const Fragment& fragment, const LineSupport& support, SupportAt& under);

    image::Rect area_;
    int samples_ = 1;
    std::span<const SampleOffset> pattern_;
    DepthRule rule_;
    TileFormat format_ = TileFormat::depth_and_id;
    bool touched_ = false;
    bool others_ = false; // something visible may not be in small_lists_
    std::vector<BinnedList> small_lists_;
    std::vector<float> depth_;
    std::vector<std::uint32_t> id_;
    std::array<float, (kTileSize / 8) * (kTileSize / 8)> hi_z_{}; // TilePlanes
    std::vector<BinnedTriangle> hi_z_scratch_;                    // scratch of draw_small_hi_z
    std::vector<float> support_depth_; // empty until lines or points come
    std::vector<std::uint32_t> support_id_;
};

} // namespace scanout::raster
