#include "bench/meshes/meshes.h"

#include "base/mapping.h"
#include "base/warnings.h"
#include "bench/meshes/shapes.h"
#include "geom/build.h"
#include "io/obj/obj.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace scanout::bench {
namespace {

constexpr std::array kMeshes = {
    MeshCard{"teapot", "Newell's patches", 6320, false},
    MeshCard{"bunny", "Stanford's scan, from the assets", 69451, false},
    MeshCard{"dragon", "a knotted tube as a scan would hold it", 871222, false},
    MeshCard{"building", "a hall with aisles, from inside", 60352, true},
    MeshCard{"large", "a rough knotted tube", 5399460, false},
    MeshCard{"crate", "a rough knotted tube in a box that hides it", 871234, false},
};
constexpr std::size_t kDragon = 871414, kLarge = 5400000;
constexpr std::string_view kBunny = SCANOUT_BENCH_ASSETS "/stanford_bunny/stanford-bunny.obj";

Result<geom::PolygonMesh> from_file(const std::string& path) {
    TRY(const Mapping file, Mapping::open(path));
    Warnings warnings;
    TRY(io::ObjFile obj, io::read_obj(file.text(), path, warnings));
    return std::move(obj.polygons);
}

Result<geom::PolygonMesh> bunny() {
    auto read = from_file(std::string(kBunny));
    if (!read)
        return fail(read.error().exit, "{}; put Stanford's bunny there, one of the assets",
                    read.error().what);
    return read;
}

} // namespace

std::span<const MeshCard> meshes() {
    return kMeshes;
}

Result<geom::PolygonMesh> make_polygons(std::string_view name) {
    if (name == "teapot") return teapot();
    if (name == "bunny") return bunny();
    if (name.ends_with(".obj")) return from_file(std::string(name));
    if (name == "dragon") return dragon(kDragon);
    if (name == "building") return building();
    if (name == "large") return knot(kLarge);
    if (name == "crate") return crate(kDragon);
    constexpr std::string_view kKnot = "knot:";
    std::size_t triangles = 0;
    if (name.starts_with(kKnot)) {
        const char *begin = name.data() + kKnot.size(), *end = name.data() + name.size();
        const auto [stop, error] = std::from_chars(begin, end, triangles);
        if (error == std::errc() && stop == end && triangles >= 100 && triangles <= 100000000)
            return knot(triangles);
    }
    return fail(
        Exit::usage,
        "{}: there is no such mesh; say teapot, bunny, dragon, building, large, crate, knot:N "
        "with 100 to 100000000 triangles, or FILE.obj",
        name);
}

Result<geom::Mesh> make_mesh(std::string_view name) {
    TRY(geom::PolygonMesh polygons, make_polygons(name));
    Warnings warnings;
    geom::Mesh mesh = build_mesh(std::move(polygons), {}, std::string(name), warnings).mesh;
    mesh.uv.resize(mesh.position.size());
    const auto scale = static_cast<float>(4 / mesh.radius);
    for (std::size_t i = 0; i < mesh.uv.size(); ++i) {
        const Vec3 p = mesh.position[i] * scale;
        mesh.uv[i] = {p.x + 0.31F * p.z, p.y + 0.23F * p.z};
    }
    return mesh;
}

} // namespace scanout::bench
