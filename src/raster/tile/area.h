// Unweighted area sampling, exactly: how much of each pixel's box each triangle covers. Catmull
// 1978, with a z-buffer's rule instead of sorting: a pixel is a set of cells, convex polygons, each
// with the triangle that is nearest there. A new triangle cuts the cells that it touches along its
// edges and, where two planes cross, along their line.
//
// Exact but for rounding in double: areas within 2^-30 of a pixel. Limits: a cell keeps at most
// kMaxVertices vertices and a pixel kMaxCells cells; beyond, a cell goes to one triangle whole.
// Lines and points have no area: they fill the pixels in which they are visible.
#pragma once

#include "image/image.h"
#include "raster/clipped/clipped_triangle.h"
#include "raster/coverage/coverage.h"
#include "raster/screen/primitive.h"

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace scanout::raster {

// The visible area of one primitive in a pixel.
struct AreaFragment {
    std::uint32_t id;
    float coverage;    // of the pixel's box, (0, 1]
    std::int32_t x, y; // a visible point of it, from the pixel's corner, 1/256 pixel
};

class AreaTile {
public:
    static constexpr int kMaxVertices = 16;
    static constexpr std::size_t kMaxCells = 512;

    // Makes the tile empty: `area` is at most kTileSize on a side.
    void reset(const image::Rect& area);
    const image::Rect& area() const { return area_; }

    // First all triangles, unclipped or clipped, in any order; then finish(), which sorts them, so
    // that no bit depends on the order; then lines and points.
    void add(const Triangle& triangle);
    void add(const ClippedTriangle& clipped);
    void finish();
    bool empty() const { return sources_.empty(); }
    // Gives the whole pixel to this primitive.
    void fill(int x, int y, std::uint32_t id);

    // Of a pixel of the picture, by falling coverage, at a tie by id; empty where nothing is. Valid
    // until the next call.
    std::span<const AreaFragment> fragments(int x, int y);

private:
    struct Source { // a triangle that was added
        ExactEdges edges;
        std::array<double, 3> depth_factor; // depth is the sum of E_i depth_factor_i
        std::uint32_t id;
        image::Rect box;
        std::array<std::int64_t, 4> order; // of triangles with the same id
    };
    // Coordinates from the pixel's corner, 1/256 pixel.
    struct CellVertex {
        double x, y;
    };
    // A linear function in a pixel: at its corner, and what a unit of x and y adds.
    struct Linear {
        double at, x, y;
        double operator()(const CellVertex& c) const { return (at + x * c.x) + y * c.y; }
    };
    struct Cell {
        std::array<CellVertex, kMaxVertices> vertex;
        int vertices = 0;
        std::int32_t source = -1; // index; -1: nothing
        Linear depth{0, 0, 0};    // of the source
    };
    using PixelCells = std::vector<Cell>;
    // The sum over a primitive's cells in a pixel.
    struct Sum {
        double area = 0, largest = 0;
        CellVertex middle{0, 0};
    };

    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>((y - area_.y0) * kTileSize + (x - area_.x0));
    }
    // A source in a pixel.
    struct Incoming {
        std::int32_t source;
        Linear depth;
        std::array<Linear, 3> edge;
        bool whole; // it covers all of the pixel
    };
    template <class Use>
    void for_pixels(std::int32_t source, Use&& use);
    static Linear depth_of(const Source& source, const std::array<Linear, 3>& edge);
    std::array<Linear, 3> edges_in(const Source& source, int x, int y) const;
    struct Range {
        double low, high;
    };
    static Range range_of(const Linear& depth);
    static void insert(PixelCells& cells, const Incoming& incoming);
    static void take(PixelCells& cells, std::size_t index, const Incoming& incoming);
    enum class Side : std::uint8_t { inside, outside, unclear };
    static Side side_of(const Cell& cell, const Linear& line);
    static bool is_behind(const Cell& cell, const Linear& ahead, const Linear& owner, double same);
    static bool is_before(const Cell& cell, const Linear& ahead, const Linear& owner);
    static double area_of(const Cell& cell);
    static void split(const Cell& cell, const Linear& line, Cell& inside, Cell& outside);

    image::Rect area_;
    std::vector<Source> sources_;
    std::vector<PixelCells> pixels_;
    std::vector<double> covered_; // the greatest depth behind which a triangle hides all of a pixel
    std::vector<std::uint32_t> filled_; // by a line or point; else kNoPrimitive
    std::vector<AreaFragment> found_;
    std::vector<std::pair<std::uint32_t, Sum>> sums_; // by id, in the order of the cells
};

} // namespace scanout::raster
