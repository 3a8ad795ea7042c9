// The meshes of the benchmarks, by name. They stand for models that other rasterisers were measured
// with: the same number of triangles, and about as many fragments at 1920x1080.
#pragma once

#include "base/result.h"
#include "geom/mesh.h"
#include "geom/polygon_mesh.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace scanout::bench {

struct MeshCard {
    std::string_view name;
    std::string_view what;
    std::size_t triangles; // exactly
    bool inside;           // the camera stands in it, not before it
};
// teapot dragon building large crate; and bunny, where the repository's assets stand beside it.
std::span<const MeshCard> meshes();

// Triangles alone, as a file would say them: no normals, no uv. "knot:N" is a rough knotted tube of
// about N triangles; a name that ends in .obj is a file's. Exit::usage for a name that is none;
// Exit::unreadable without the file, the bunny's too.
Result<geom::PolygonMesh> make_polygons(std::string_view name);

// The same, ready to draw, with u and v laid on by a slanted projection (4 tiles a bounding
// radius).
Result<geom::Mesh> make_mesh(std::string_view name);

// From the building's middle at the height of an eye; file units, y up.
inline constexpr DVec3 kEyeInBuilding{0.35, 1.7, 0.2};

} // namespace scanout::bench
