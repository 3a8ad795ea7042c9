// Room for what a tile draws last, of clusters that waited (raster/hidden_clusters.h).
#pragma once

#include "raster/cull.h"
#include "raster/small_triangles.h"

#include <cstdint>
#include <vector>

namespace scanout::raster {

struct LateParts {
    CullResult found; // of one cluster
    std::vector<std::uint32_t> triangles;
    PartsByKind parts;

    void clear() {
        triangles.clear();
        for (auto& of_kind : parts)
            of_kind.clear();
    }
};

} // namespace scanout::raster
