// Unweighted area sampling, exactly: how much of each pixel's box each triangle shows.
// Catmull 1978, with a z-buffer's rule instead of sorting: a pixel is a set of convex parts, each
// with the triangle that is nearest there. A new triangle cuts the parts that it touches along its
// edges and, where two planes cross, along their line.
//
// Exact but for rounding in double: areas within 2^-30 of a pixel. Limits: a part keeps at most
// kMostCorners corners and a pixel kMostParts parts; beyond, a part goes to one triangle whole.
// Lines and points have no area: they fill the pixels in which they are seen.
#pragma once

#include "image/image.h"
#include "raster/coverage.h"
#include "raster/piece.h"
#include "raster/primitive.h"

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace scanout::raster {

// What one primitive shows in a pixel.
struct AreaFragment {
    std::uint32_t id;
    float share;       // of the pixel's box, (0, 1]
    std::int32_t x, y; // a point that shows it, from the pixel's corner, 1/256 pixel
};

class AreaTile {
public:
    static constexpr int kMostCorners = 16;
    static constexpr std::size_t kMostParts = 512;

    // Makes the tile empty: `area` is at most kTileSize on a side.
    void reset(const image::Rect& area);
    const image::Rect& area() const { return area_; }

    // First all triangles, whole or cut by the near plane, in any order; then finish(), which sorts
    // them, so that no bit depends on it; then lines and points.
    void add(const Triangle& triangle);
    void add(const Piece& piece);
    void finish();
    bool empty() const { return sources_.empty(); }
    // The whole pixel shows this, whatever stood there.
    void fill(int x, int y, std::uint32_t id);

    // Of a pixel of the picture, by falling share, at a tie by id; empty where nothing is. Valid
    // until the next call.
    std::span<const AreaFragment> fragments(int x, int y);

private:
    struct Source { // a triangle that was added
        ExactEdges edges;
        std::array<double, 3> share; // depth is the sum of edge times share
        std::uint32_t id;
        image::Rect box;
        std::array<std::int64_t, 4> order; // of triangles with the same id
    };
    // Coordinates from the pixel's corner, 1/256 pixel.
    struct Corner {
        double x, y;
    };
    struct Part {
        std::array<Corner, kMostCorners> corner;
        int corners = 0;
        std::int32_t source = -1; // index; -1: nothing
    };
    // A linear function in a pixel: at its corner, and what a unit of x and y adds.
    struct Linear {
        double at, x, y;
        double operator()(const Corner& c) const { return (at + x * c.x) + y * c.y; }
    };
    using PixelParts = std::vector<Part>;
    // What a primitive shows in a pixel.
    struct Sum {
        double area = 0, largest = 0;
        Corner middle{0, 0};
    };

    PixelParts& pixel(int x, int y) {
        return pixels_[static_cast<std::size_t>((y - area_.y0) * kTileSize + (x - area_.x0))];
    }
    void draw(std::int32_t source);
    std::array<Linear, 3> edges_in(const Source& source, int x, int y) const;
    void insert(PixelParts& parts, std::int32_t source, int x, int y,
                const std::array<Linear, 3>& edge, bool whole);
    void take(PixelParts& parts, std::size_t index, std::int32_t source, int x, int y,
              const std::array<Linear, 3>& edge, int edges);
    Linear depth_in(const Source& source, int x, int y) const;
    static double area_of(const Part& piece);
    static void split(const Part& piece, const Linear& line, Part& inside, Part& outside);

    image::Rect area_;
    std::vector<Source> sources_;
    std::vector<PixelParts> pixels_;
    std::vector<std::uint32_t> filled_; // by a line or point; else kNoPrimitive
    std::vector<AreaFragment> found_;
    std::vector<std::pair<std::uint32_t, Sum>> sums_; // by id, in the order of the parts
};

} // namespace scanout::raster
