// OBJ reading on one thread: bytes of text a second, and the arrays' bytes for each byte of text.
// Must reach 100 MB/s on 50 MB (the grids are a little over).
#include "io/obj.h"
#include "tests/io/grid.h"

#include <cstddef>

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

void read_obj(benchmark::State& state, GridKind kind, int side) {
    const std::string text = grid(side, kind);
    std::size_t bytes = 0;
    for (auto _ : state) {
        Warnings warnings;
        const auto obj = io::read_obj(text, "grid.obj", warnings);
        if (!obj) return state.SkipWithError(obj.error().what.c_str());
        bytes = array_bytes(obj->polygons);
    }
    state.SetBytesProcessed(static_cast<std::int64_t>(text.size() * state.iterations()));
    state.counters["array_bytes_per_byte"] =
        static_cast<double>(bytes) / static_cast<double>(text.size());
}

BENCHMARK_CAPTURE(read_obj, v_f, GridKind::positions, 840)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_obj, v_vt_vn_f, GridKind::with_uv_and_normals, 530)
    ->Unit(benchmark::kMillisecond);

} // namespace
