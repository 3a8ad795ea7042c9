#include "raster/clipped/clipped_setup.h"

#include "raster/coverage/block_traversal.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace scanout::raster {

static constexpr int kAnySize = std::numeric_limits<int>::max();

EdgeExtent::EdgeExtent(const ExactEdges& e, const SampleExtent& extent, int side) {
    const Int128 more = Int128{side - 1} * kSubpixel;
    const Int128 across[2] = {extent.low.x, more + extent.high.x};
    const Int128 down[2] = {extent.low.y, more + extent.high.y};
    for (std::size_t k = 0; k < 3; ++k) {
        lowest[k] = e.a[k] * across[e.a[k] < 0 ? 1 : 0] + e.b[k] * down[e.b[k] < 0 ? 1 : 0];
        highest[k] = e.a[k] * across[e.a[k] < 0 ? 0 : 1] + e.b[k] * down[e.b[k] < 0 ? 0 : 1];
    }
}

ClippedSetup::ClippedSetup(const ClippedTriangle& of, const SampleExtent& samples)
    : triangle(of), edges(edges_of(of)), of_tile(edges, samples, kTileSize),
      of_block(edges, samples, PixelBlock::kSide), least(of.vertex[0].depth), most(least),
      box(pixel_bounds(of, kAnySize, kAnySize, samples)), extent(samples) {
    const double size = size_of(triangle);
    for (std::size_t k = 0; k < 3; ++k) {
        depth_factor[k] = triangle.vertex[k].z / size;
        a[k] = static_cast<double>(edges.a[k]);
        b[k] = static_cast<double>(edges.b[k]);
        terms += (std::abs(a[k]) + std::abs(b[k])) * std::abs(depth_factor[k]);
        least = std::min(least, triangle.vertex[k].depth);
        most = std::max(most, triangle.vertex[k].depth);
    }
    per_x = depth_of(a);
    per_y = depth_of(b);
}

} // namespace scanout::raster
