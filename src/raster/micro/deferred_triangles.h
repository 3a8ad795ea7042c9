// Scratch memory for the triangles of deferred clusters that a tile draws last
// (raster/culling/occlusion.h).
#pragma once

#include "raster/culling/cull.h"
#include "raster/micro/small_triangles.h"

#include <cstdint>
#include <vector>

namespace scanout::raster {

struct DeferredTriangles {
    CullResult found; // of one cluster
    std::vector<std::uint32_t> triangles;
    BinnedByKind small;

    void clear() {
        triangles.clear();
        for (auto& of_kind : small)
            of_kind.clear();
    }
};

} // namespace scanout::raster
