// Reading files and building meshes, on one thread and on all: bytes of file a second, triangles a
// second. OBJ must reach 100 MB/s on 50 MB on one thread (the grids are a little over).
#include "bench/meshes/meshes.h"
#include "geom/build.h"
#include "io/obj/obj.h"
#include "io/stl/stl.h"
#include "tests/io/grid.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <random>
#include <thread>

#include <benchmark/benchmark.h>

namespace {

using namespace scanout;
using io::test::GridKind;

std::string grid(int side, GridKind kind) {
    std::string text;
    io::test::write_grid(side, kind, [&](const std::string& row) { text += row; });
    return text;
}

std::size_t array_bytes(const geom::PolygonMesh& m) {
    const auto bytes = [](const auto& v) { return v.size() * sizeof(v[0]); };
    return bytes(m.positions) + bytes(m.uvs) + bytes(m.normals) + bytes(m.corners) +
           bytes(m.face_begin) + bytes(m.face_material);
}

void one_thread_and_all(benchmark::internal::Benchmark* b) {
    b->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime()->ArgName("threads");
    b->Arg(1);
    const auto all = static_cast<int>(std::thread::hardware_concurrency());
    if (all > 1) b->Arg(all);
}

// read(jobs) returns a Result whose `polygons` are counted.
template <class Read>
void read_file(benchmark::State& state, const std::string& file, Read&& read) {
    Jobs jobs(static_cast<int>(state.range(0)));
    std::size_t bytes = 0;
    for (auto _ : state) {
        const auto found = read(jobs);
        if (!found) return state.SkipWithError(found.error().what.c_str());
        bytes = array_bytes(found->polygons);
    }
    state.SetBytesProcessed(static_cast<std::int64_t>(file.size() * state.iterations()));
    state.counters["array_bytes_per_byte"] =
        static_cast<double>(bytes) / static_cast<double>(file.size());
}

void read_obj(benchmark::State& state, GridKind kind, int side) {
    const std::string text = grid(side, kind);
    read_file(state, text, [&](Jobs& jobs) {
        Warnings warnings;
        return io::read_obj(text, "grid.obj", warnings, nullptr, {.jobs = &jobs});
    });
}
BENCHMARK_CAPTURE(read_obj, v_f, GridKind::positions, 840)->Apply(one_thread_and_all);
BENCHMARK_CAPTURE(read_obj, v_vt_vn_f, GridKind::with_uv_and_normals, 530)
    ->Apply(one_thread_and_all);

const geom::PolygonMesh& knot() {
    static const geom::PolygonMesh mesh = bench::make_polygons("knot:400000").value();
    return mesh;
}
Vec3 corner(const geom::PolygonMesh& mesh, std::size_t number) {
    return Vec3(mesh.positions[static_cast<std::size_t>(mesh.corners[number].position)]);
}

std::string binary_stl(const geom::PolygonMesh& mesh) {
    std::string file(80, ' ');
    const auto add = [&](const auto& value) {
        file.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    add(static_cast<std::uint32_t>(mesh.faces()));
    for (std::size_t face = 0; face < mesh.faces(); ++face) {
        add(Vec3(0));
        for (std::size_t k = 0; k < 3; ++k)
            add(corner(mesh, face * 3 + k));
        add(std::uint16_t{0});
    }
    return file;
}
std::string ascii_stl(const geom::PolygonMesh& mesh) {
    std::string file = "solid knot\n";
    const auto out = std::back_inserter(file);
    for (std::size_t face = 0; face < mesh.faces(); ++face) {
        file += "facet normal 0 0 0\nouter loop\n";
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 p = corner(mesh, face * 3 + k);
            fmt::format_to(out, "vertex {:e} {:e} {:e}\n", p.x, p.y, p.z);
        }
        file += "endloop\nendfacet\n";
    }
    return file + "endsolid knot\n";
}

void read_stl(benchmark::State& state, std::string (*written)(const geom::PolygonMesh&)) {
    const std::string file = written(knot());
    read_file(state, file, [&](Jobs& jobs) {
        Warnings warnings;
        return io::read_stl(file, "knot.stl", warnings, nullptr, {.jobs = &jobs});
    });
}
BENCHMARK_CAPTURE(read_stl, binary, binary_stl)->Apply(one_thread_and_all);
BENCHMARK_CAPTURE(read_stl, ascii, ascii_stl)->Apply(one_thread_and_all);

// Triangles in no order: the spatial order is found (geom/spatial_order.h).
geom::PolygonMesh shuffled(geom::PolygonMesh mesh) {
    std::mt19937 random(5);
    for (std::size_t i = mesh.faces(); i-- > 1;) {
        const std::size_t j = random() % (i + 1);
        std::swap_ranges(mesh.corners.begin() + static_cast<std::ptrdiff_t>(i * 3),
                         mesh.corners.begin() + static_cast<std::ptrdiff_t>(i * 3 + 3),
                         mesh.corners.begin() + static_cast<std::ptrdiff_t>(j * 3));
    }
    return mesh;
}

// Polygons to a mesh: normals, vertices, order, clusters.
void build(benchmark::State& state, bool in_order) {
    const geom::PolygonMesh mesh = in_order ? knot() : shuffled(knot());
    Jobs jobs(static_cast<int>(state.range(0)));
    for (auto _ : state) {
        state.PauseTiming();
        geom::PolygonMesh polygons = mesh;
        state.ResumeTiming();
        Warnings warnings;
        geom::BuildOptions options;
        options.jobs = &jobs;
        const auto built = geom::build_mesh(std::move(polygons), options, "knot", warnings);
        benchmark::DoNotOptimize(built.mesh.index.data());
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(mesh.faces()) *
                            static_cast<std::int64_t>(state.iterations()));
}
BENCHMARK_CAPTURE(build, in_order, true)->Apply(one_thread_and_all);
BENCHMARK_CAPTURE(build, in_no_order, false)->Apply(one_thread_and_all);

} // namespace
