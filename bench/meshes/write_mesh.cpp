// bench_mesh NAME FILE: writes a generated mesh as binary STL or OBJ.
#include "bench/meshes/meshes.h"
#include "bench/meshes/write_mesh_file.h"

#include <cstdio>

#include <fmt/format.h>

int main(int count, char** arguments) {
    using namespace scanout;
    if (count != 3) {
        fmt::print(stderr, "usage: bench_mesh NAME FILE.stl|FILE.obj\n");
        for (const bench::MeshCard& card : bench::meshes())
            fmt::print(stderr, "  {:9} {}\n", card.name, card.what);
        fmt::print(stderr, "  knot:N    a rough knotted tube of about N triangles\n");
        return static_cast<int>(Exit::usage);
    }
    const auto mesh = bench::make_polygons(arguments[1]);
    const Result<void> written =
        mesh ? bench::write_mesh(*mesh, arguments[2]) : tl::unexpected(mesh.error());
    if (written) return 0;
    fmt::print(stderr, "bench_mesh: {}\n", written.error().what);
    return static_cast<int>(written.error().exit);
}
