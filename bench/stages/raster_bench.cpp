// From vertices to the visibility buffer, on one thread: each step of the geometry stage by itself
// and all together, coverage by the size of triangles, and depth by its rule and by how steep it
// is.
#include "base/jobs.h"
#include "bench/meshes/meshes.h"
#include "math/transcendental.h"
#include "raster/coverage/coverage.h"
#include "raster/culling/cull.h"
#include "raster/stage/geometry.h"
#include "raster/tile/tile.h"
#include "rows.h"
#include "scene/view.h"
#include "tests/support/random.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace {

using namespace scanout;
using raster::ScreenVertex;
using raster::SnappedTriangle;

constexpr int kWidth = 1920, kHeight = 1080;

// A mesh seen as bench_peers sees it: whole before the camera, or from the building's middle.
struct Seen {
    geom::Mesh mesh;
    scene::View view;
};
Result<Seen> see(const std::string& name) {
    Seen seen;
    TRY(seen.mesh, bench::make_mesh(name));
    scene::CameraOptions camera;
    if (name == "building") {
        camera.eye = bench::kEyeInBuilding;
        camera.target = bench::kEyeInBuilding + DVec3(1, 0.05, 0.3);
    }
    TRY(seen.view, scene::make_view(seen.mesh, {}, {}, camera, {}, kWidth, kHeight));
    return seen;
}

void count(benchmark::State& state, const char* what, std::size_t each) {
    state.counters[what] = benchmark::Counter(static_cast<double>(each),
                                              benchmark::Counter::kIsIterationInvariantRate);
}

void transform(benchmark::State& state) {
    const auto seen = see("knot:100000");
    if (!seen) return state.SkipWithError(seen.error().what.c_str());
    const raster::ScreenTransform to_screen(seen->view, kWidth, kHeight);
    std::vector<ScreenVertex> out(seen->mesh.position.size());
    for (auto _ : state) {
        raster::transform_vertices(to_screen, seen->mesh.position, out);
        benchmark::DoNotOptimize(out.data());
        benchmark::ClobberMemory();
    }
    count(state, "vertices", out.size());
}
BENCHMARK(transform)->Unit(benchmark::kMicrosecond);

// Set-up and culling of transformed triangles, in the chunks of the geometry stage.
void cull(benchmark::State& state, const std::string& name) {
    const auto seen = see(name);
    if (!seen) return state.SkipWithError(seen.error().what.c_str());
    const geom::Mesh& mesh = seen->mesh;
    std::vector<ScreenVertex> vertices(mesh.position.size());
    raster::transform_vertices(raster::ScreenTransform(seen->view, kWidth, kHeight), mesh.position,
                               vertices);
    const raster::CullOptions options{kWidth,
                                      kHeight,
                                      raster::Facing::front,
                                      seen->view.mirrored,
                                      raster::extent_of(raster::sample_pattern(1)),
                                      raster::sample_pattern(1)};
    constexpr std::size_t kPart = 4096;
    raster::CullResult found;
    std::size_t left = 0;
    for (auto _ : state) {
        left = 0;
        for (std::size_t first = 0; first < mesh.triangles(); first += kPart) {
            const std::size_t n = std::min(kPart, mesh.triangles() - first);
            raster::cull_triangles(options, vertices,
                                   std::span(mesh.index).subspan(first * 3, n * 3),
                                   static_cast<std::uint32_t>(first), found);
            left += found.visible_count + found.to_clip_count;
            benchmark::DoNotOptimize(found.visible.data());
            benchmark::ClobberMemory();
        }
    }
    count(state, "triangles", mesh.triangles());
    state.counters["kept_share"] =
        static_cast<double>(left) / static_cast<double>(mesh.triangles());
}
BENCHMARK_CAPTURE(cull, knot_100k, "knot:100000")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(cull, building, "building")->Unit(benchmark::kMicrosecond);

// From inside a building its walls have backs.
raster::GeometryOptions options_of(const std::string& name, const scene::View& view) {
    raster::GeometryOptions options;
    options.width = kWidth;
    options.height = kHeight;
    options.keep = name == "building" ? raster::Facing::any : raster::Facing::front;
    options.mirrored = view.mirrored;
    return options;
}

// Transform, set-up, culling, cutting and binning.
void geometry(benchmark::State& state, const std::string& name) {
    const auto seen = see(name);
    if (!seen) return state.SkipWithError(seen.error().what.c_str());
    Jobs jobs(1);
    raster::Geometry stage;
    const raster::GeometryOptions options = options_of(name, seen->view);
    const raster::ScreenTransform to_screen(seen->view, kWidth, kHeight);
    for (auto _ : state) {
        stage.run(jobs, seen->mesh, to_screen, options);
        benchmark::DoNotOptimize(stage.triangles_drawn());
    }
    count(state, "triangles", seen->mesh.triangles());
}
BENCHMARK_CAPTURE(geometry, teapot, "teapot")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(geometry, building, "building")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(geometry, knot_100k, "knot:100000")->Unit(benchmark::kMicrosecond);

// Coverage of all tiles, as a frame has it before it is shaded.
void tiles(benchmark::State& state, const std::string& name) {
    const auto seen = see(name);
    if (!seen) return state.SkipWithError(seen.error().what.c_str());
    Jobs jobs(1);
    raster::Geometry stage;
    stage.run(jobs, seen->mesh, raster::ScreenTransform(seen->view, kWidth, kHeight),
              options_of(name, seen->view));
    raster::VisibilityTile tile;
    for (auto _ : state) {
        for (int i = 0; i < stage.tiles(); ++i) {
            if (stage.is_empty(i)) continue;
            tile.reset(stage.tile_area(i), 1);
            stage.draw(i, tile);
        }
        benchmark::ClobberMemory();
    }
    count(state, "triangles", stage.triangles_drawn());
}
BENCHMARK_CAPTURE(tiles, bunny, "bunny")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(tiles, building, "building")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(tiles, knot_100k, "knot:100000")->Unit(benchmark::kMicrosecond);

// Triangles with three like sides, turned and placed at random with their middles in one tile. A
// flat one has nearly one depth; a steep one falls away from the eye, which takes the other path.
enum class Depth { flat, steep };
SnappedTriangle triangle(test::Random& random, double pixels, Depth depth, std::uint32_t id) {
    const double radius = std::sqrt(pixels * 4 / (3 * std::sqrt(3.0)));
    const double x = random.in(0, raster::kTileSize), y = random.in(0, raster::kTileSize);
    const double turn = random.in(0, 360), near = random.in(0.2, 0.9);
    SnappedTriangle t{{}, id};
    for (std::size_t k = 0; k < 3; ++k) {
        const double angle = turn + 120.0 * static_cast<double>(k);
        ScreenVertex& v = t.vertex[k];
        v.x = static_cast<std::int32_t>(
            std::lround((x + radius * cos_degrees(angle)) * raster::kSubpixel));
        v.y = static_cast<std::int32_t>(
            std::lround((y + radius * sin_degrees(angle)) * raster::kSubpixel));
        const double share = static_cast<double>(k) / 2;
        v.depth = depth == Depth::flat ? near * (1 + 1e-4 * share) : near * (1 - 0.9 * share);
    }
    return t;
}

std::vector<SnappedTriangle> triangles(double pixels, double layers, Depth depth) {
    const double area = raster::kTileSize * raster::kTileSize;
    const auto n = static_cast<std::uint32_t>(std::lround(layers * area / pixels));
    test::Random random(7);
    std::vector<SnappedTriangle> all;
    for (std::uint32_t id = 0; id < n; ++id)
        all.push_back(triangle(random, pixels, depth, id));
    return all;
}

constexpr image::Rect kTile{0, 0, raster::kTileSize, raster::kTileSize};

// Pixels inside the tile whose samples any of them covers, each by itself.
std::size_t covered(const std::vector<SnappedTriangle>& all, int samples) {
    std::size_t found = 0;
    raster::VisibilityTile tile;
    for (const SnappedTriangle& t : all) {
        tile.reset(kTile, samples);
        tile.draw(std::span(&t, 1));
        for (int y = 0; y < raster::kTileSize; ++y)
            for (int x = 0; x < raster::kTileSize; ++x)
                for (int s = 0; s < samples; ++s)
                    if (tile.id(x, y, s) != raster::kNoPrimitive) {
                        ++found;
                        break;
                    }
    }
    return found;
}

// A tile from its clearing to four layers of triangles, in batches as the geometry stage draws.
void draw(benchmark::State& state, const std::vector<SnappedTriangle>& all, int samples,
          const raster::DepthRule& rule) {
    raster::VisibilityTile tile;
    constexpr std::size_t kBatch = 64;
    for (auto _ : state) {
        tile.reset(kTile, samples, rule);
        for (std::size_t i = 0; i < all.size(); i += kBatch)
            tile.draw(std::span(all).subspan(i, std::min(kBatch, all.size() - i)));
        benchmark::DoNotOptimize(tile.ids(0).data());
        benchmark::ClobberMemory();
    }
    count(state, "triangles", all.size());
    count(state, "pixels", covered(all, samples));
}

void coverage(benchmark::State& state) { // pixels a triangle, samples a pixel
    const auto all = triangles(static_cast<double>(state.range(0)), 4, Depth::flat);
    draw(state, all, static_cast<int>(state.range(1)), {});
}
BENCHMARK(coverage)
    ->ArgNames({"pixels", "samples"})
    ->ArgsProduct({{1, 4, 10, 30, 100, 1000}, {1, 4}})
    ->Unit(benchmark::kMicrosecond);

// Triangles of 30 pixels.
void depth(benchmark::State& state, const raster::DepthRule& rule, Depth how) {
    const auto all = triangles(30, 4, how);
    for (const SnappedTriangle& t : all)
        if (raster::has_float_depth(t) != (how == Depth::flat))
            return state.SkipWithError("a triangle is not as steep as it should be");
    draw(state, all, 1, rule);
}

// Every test with the default format, and every other format with the default test.
const bool kRegistered = [] {
    const auto add = [](const std::string& name, const raster::DepthRule& rule, Depth how) {
        benchmark::RegisterBenchmark(("depth/" + name).c_str(), depth, rule, how)
            ->Unit(benchmark::kMicrosecond);
    };
    add("steep", {}, Depth::steep);
    for (const raster::DepthTestRow* row : raster::depth_test::kRows)
        add("flat/" + std::string(row->card.name), {row->test}, Depth::flat);
    for (const raster::DepthFormatRow* row : raster::depth::kRows)
        if (row->standard)
            add("flat/" + std::string(row->card.name),
                {raster::DepthTest::greater, row->standard, row->steps}, Depth::flat);
    return true;
}();

} // namespace
