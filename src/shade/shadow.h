// The inputs of the shadow stages. A shadow takes a share of a light's colour from an item and
// never adds any. Maps are drawn before the tiles, counts with each tile; both exist only in frames
// whose plan runs a technique that reads them.
#pragma once

#include "raster/count/stencil_count.h"
#include "raster/culling/cull.h"
#include "raster/tile/tile.h"
#include "scene/light.h"

#include <cstdint>
#include <span>

namespace scanout::shade {

inline constexpr int kMaxFilter = 15; // texels a side that a filtered shadow reads

// A shadow map: the depth of the surface nearest to the light, in a square of texels; greater is
// nearer, 0 where there is none. Light space: the light at the origin (parallel light: beside its
// map), looks down -z, x right, y up.
struct ShadowMap {
    float rotation[3][3] = {},
          translation[3] = {}; // view space -> light space: a rotation, row major
    bool perspective = false;
    float scale_x = 1, scale_y = 1; // texels a unit: everywhere, or in perspective at distance 1
    // depth = depth_scale / distance in perspective, else z * depth_scale + depth_offset.
    float depth_scale = 1, depth_offset = 0;
    int size = 0;      // texels a side
    float half = 0;    // the map holds receivers within so many texels of its middle
    float soft_x = 0;  // penumbra of a light of some size: texels a unit of depth between the
    float soft_y = 0;  // caster and the receiver
    float nearest = 0; // the greatest depth in the map
    const float* depth = nullptr; // size * size, rows from the top
};

struct LightShadow {
    // One map, or six around a light that shines in all directions. Empty: the light casts no
    // shadow.
    std::span<const ShadowMap> maps;
    bool casts = false;
    bool soft = false; // the light has a size
    // Of a closed mesh that the light stands outside of: the sides of its faces that lie within,
    // where no light comes. Any: not known.
    raster::Facing inner = raster::Facing::any;
    scene::LightShape shape = scene::LightShape::sphere;
};

// The polygons of a light's shadows that may lie over a tile.
struct TilePolygons {
    std::span<const raster::StencilTriangle> all;
    std::span<const std::uint32_t> here; // indices into `all`
    raster::StencilWhere where = raster::StencilWhere::behind;
    float of_body = 0; // ShadowPolygons
};

// How many polygons of a light's shadows lie over each sample of a tile.
struct TileShadow {
    const raster::VisibilityTile* tile = nullptr;
    // One plane a sample, laid out as in the tile; null where the light casts none.
    const float* count[scene::kMaxLights] = {};
    // For surfaces that no sample of the tile shows: blended ones, in front of the counted ones.
    TilePolygons polygons[scene::kMaxLights];
    // With areas, a pixel may show a primitive that its centre, where polygons are counted, does
    // not show: every item counts at its own place.
    bool areas = false;
    // For each triangle, whether it receives the shadow. Empty: all do.
    std::span<const std::uint8_t> receives;
};

} // namespace scanout::shade
