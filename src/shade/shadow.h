// What the shadow stages read. A shadow takes a share of a light's colour at a item; it never adds
// any. Maps are drawn before the tiles, counts with each tile; both exist only in frames whose plan
// runs a technique that reads them.
#pragma once

#include "raster/count/stencil_count.h"
#include "raster/tile/tile.h"
#include "scene/light.h"

#include <cstdint>
#include <span>

namespace scanout::shade {

inline constexpr int kMaxFilter = 15; // texels a side that a filtered shadow asks

// The depth of what a light sees, nearest first, in a square of texels; greater is nearer, 0 where
// nothing is. Light space: the light at the origin (parallel light: beside its map), looks down -z,
// x right, y up.
struct ShadowMap {
    float rotation[3][3] = {},
          translation[3] = {}; // view space -> light space: a rotation, row major
    bool perspective = false;
    float scale_x = 1, scale_y = 1; // texels a unit: everywhere, or in perspective at distance 1
    // depth = depth_scale / distance in perspective, else z * depth_scale + depth_offset.
    float depth_scale = 1, depth_offset = 0;
    int size = 0;      // texels a side
    float half = 0;    // a receiver belongs to the map within so many texels of its middle
    float soft_x = 0;  // penumbra of a light of some size: texels a unit of depth between the
    float soft_y = 0;  // caster and the receiver
    float nearest = 0; // the greatest depth in the map
    const float* depth = nullptr; // size * size, rows from the top
};

struct LightShadow {
    // One, or six round about a light that shines all ways. Empty: the light casts none.
    std::span<const ShadowMap> maps;
    bool casts = false;
    bool soft = false; // the light has a size
    scene::LightShape shape = scene::LightShape::sphere;
};

// The polygons of a light's shadows that may lie over a tile.
struct TilePolygons {
    std::span<const raster::StencilTriangle> all;
    std::span<const std::uint32_t> here; // of all, by index
    raster::StencilWhere where = raster::StencilWhere::behind;
};

// How many polygons of a light's shadows lie over each sample of a tile.
struct TileShadow {
    const raster::VisibilityTile* tile = nullptr;
    // One plane a sample, laid out as in the tile; null where the light casts none.
    const float* count[scene::kMaxLights] = {};
    // For what no sample of the tile shows: blended surfaces, in front of what was counted.
    TilePolygons polygons[scene::kMaxLights];
    // By areas a pixel may show what its centre, where polygons are counted, does not: every item
    // asks at its own place.
    bool areas = false;
    // By triangle: which receive the shadow. Empty: all do.
    std::span<const std::uint8_t> receives;
};

} // namespace scanout::shade
