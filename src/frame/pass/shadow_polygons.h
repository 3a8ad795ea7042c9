// The polygons of a light's shadows on the screen, binned by tile: the faces of shadow volumes, or
// triangles projected onto a plane. They are summed into a tile's stencil counts after its
// visibility.
#pragma once

#include "raster/count/infinite_polygon.h"
#include "raster/culling/cull.h"
#include "raster/tile/tile.h"
#include "scene/light.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "shade/shadow.h"

#include <cstdint>
#include <span>
#include <vector>

namespace scanout::frame {

// The tiles of the picture, numbered along rows.
struct ScreenTiles {
    int width = 0, height = 0, tile_size = 0, samples = 1;
    bool areas = false; // instead of samples
};

// The triangles that cast shadows, the light, and the screen.
struct ShadowCaster {
    const geom::Mesh& mesh;
    std::span<const std::uint8_t> casts; // by triangle
    const scene::ViewLight& light;
    const scene::View& view;
    const raster::ScreenTransform& transform;
    const ScreenTiles& grid;
    // Of a closed mesh that the light stands outside of: the sides that lie within it; any: not
    // known, and taken to be backs.
    raster::Facing inner = raster::Facing::any;
};

// Vertices at one position welded into one (HARD-CASES 45). Depends on the mesh and on which of its
// triangles cast shadows.
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
    std::vector<std::vector<std::uint32_t>> tiles; // indices of triangles that may touch each tile
    raster::StencilWhere where = raster::StencilWhere::behind;
    // The volumes of its own body that a face lies in which turns away from the light: that of the
    // face by which the light has entered the body, and its own, where it has one.
    float of_body = 0;

    shade::TilePolygons in_tile(int tile) const {
        return {triangles, tiles[static_cast<std::size_t>(tile)], where, of_body};
    }
    std::size_t bytes() const;
    // Removes the polygons; keeps their memory.
    void clear();
    // Adds to the tile's counts.
    void count(int tile, const raster::VisibilityTile& visible, float* counts) const;
};

// Shadow volumes, counted by depth fail: the triangles as near caps, the silhouette edges extruded
// from the light to infinity as sides, and the far caps. At a point, the faces behind it that leave
// a volume minus the faces that enter one are the number of casters between the light and the
// point. A closed mesh with the light outside needs only the triangles that turn their outer side
// to the light, any other mesh all; an edge between two of them has no side. `edges` is scratch.
void shadow_volumes(const ShadowCaster& caster, const Welded& welded,
                    std::vector<ShadowEdge>& edges, ShadowPolygons& out);

// A plane of view space, normal . p + offset = 0.
struct ViewPlane {
    DVec3 normal{0};
    double offset = 0;
};

// The triangles between the light and the plane, projected onto the plane.
void projected_shadows(const ShadowCaster& caster, const ViewPlane& plane, ShadowPolygons& out);

} // namespace scanout::frame
