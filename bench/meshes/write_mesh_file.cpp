#include "bench/meshes/write_mesh_file.h"

#include "base/write_file.h"

#include <array>
#include <bit>
#include <iterator>

#include <fmt/format.h>

namespace scanout::bench {
namespace {

static_assert(std::endian::native == std::endian::little, "STL's numbers are little-endian");

template <class T>
void append(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

} // namespace

std::string binary_stl(const geom::PolygonMesh& mesh) {
    std::string bytes(80, ' ');
    bytes.reserve(84 + 50 * mesh.faces());
    append(bytes, static_cast<std::uint32_t>(mesh.faces()));
    for (std::size_t face = 0; face < mesh.faces(); ++face) {
        const std::size_t first = mesh.face_begin[face];
        std::array<Vec3, 4> facet{}; // the normal, which readers make themselves, and the corners
        for (std::size_t i = 0; i < 3; ++i)
            facet[i + 1] =
                Vec3(mesh.positions[static_cast<std::size_t>(mesh.corners[first + i].position)]);
        append(bytes, facet);
        append(bytes, std::uint16_t{0});
    }
    return bytes;
}

std::string obj_text(const geom::PolygonMesh& mesh) {
    std::string text;
    const auto out = std::back_inserter(text);
    for (const DVec3& p : mesh.positions)
        fmt::format_to(out, "v {:.6g} {:.6g} {:.6g}\n", p.x, p.y, p.z);
    for (std::size_t face = 0; face < mesh.faces(); ++face) {
        const geom::Corner* c = mesh.corners.data() + mesh.face_begin[face];
        fmt::format_to(out, "f {} {} {}\n", c[0].position + 1, c[1].position + 1,
                       c[2].position + 1);
    }
    return text;
}

Result<void> write_mesh(const geom::PolygonMesh& mesh, const std::string& path) {
    if (path.ends_with(".stl")) return write_file(path, binary_stl(mesh));
    if (path.ends_with(".obj")) return write_file(path, obj_text(mesh));
    return fail(Exit::usage, "{}: the name must end in .stl or .obj", path);
}

} // namespace scanout::bench
