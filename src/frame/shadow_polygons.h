// The polygons of a light's shadows on the screen, by tile: the borders of shadow volumes, or what
// every triangle throws onto a plane. They are counted over the tile's samples after visibility.
#pragma once

#include "raster/count/infinite_polygon.h"
#include "raster/tile/tile.h"
#include "scene/light.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "shade/shadow.h"

#include <cstdint>
#include <span>
#include <vector>

namespace scanout::frame {

// The picture and its tiles, numbered along rows.
struct ScreenTiles {
    int width = 0, height = 0, tile_size = 0, samples = 1;
};

// What throws a shadow, from where, and onto what screen.
struct ShadowCaster {
    const geom::Mesh& mesh;
    std::span<const std::uint8_t> casts; // by triangle
    const scene::ViewLight& light;
    const scene::View& view;
    const raster::ScreenTransform& transform;
    const ScreenTiles& grid;
};

// Vertices at one place taken as one (HARD-CASES 45). It follows from the mesh and from which of
// its triangles throw shadows.
struct Welded {
    std::vector<std::uint32_t> vertex; // of each vertex, the first at its place
    bool closed = false;               // every edge belongs to two triangles that wind the same way
};
Welded weld(const geom::Mesh& mesh, std::span<const std::uint8_t> casts);

// An edge from its lower vertex to the higher; `net` counts the triangles that name it in that
// order, less those that name it the other way round.
struct ShadowEdge {
    std::uint32_t low, high;
    std::int32_t net, uses;
};

struct ShadowPolygons {
    std::vector<raster::StencilTriangle> triangles;
    std::vector<std::vector<std::uint32_t>> tiles; // what each may hold, by index
    raster::StencilWhere where = raster::StencilWhere::behind;

    shade::TilePolygons in_tile(int tile) const {
        return {triangles, tiles[static_cast<std::size_t>(tile)], where};
    }
    std::size_t bytes() const;
    // Forgets the polygons; memory is kept.
    void clear();
    // Adds to the tile's counts.
    void count(int tile, const raster::VisibilityTile& visible, float* counts) const;
};

// The borders of the space that the triangles hide from the light: the triangles themselves, the
// sides that the light draws from their edges, to infinity, and there their far ends. Counted
// behind a point, those that leave the space less those that enter it are how often the point is
// hidden. Of a closed mesh that the light stands outside of the triangles that face it, otherwise
// all; edges between two of them have no side. `edges` is room.
void shadow_volumes(const ShadowCaster& caster, const Welded& welded,
                    std::vector<ShadowEdge>& edges, ShadowPolygons& out);

// A plane of view space, normal . p + offset = 0.
struct ViewPlane {
    DVec3 normal{0};
    double offset = 0;
};

// What the triangles between the light and the plane throw onto it.
void projected_shadows(const ShadowCaster& caster, const ViewPlane& plane, ShadowPolygons& out);

} // namespace scanout::frame
