// Edge functions that must fail where ours hold: in float, relative to a vertex or as a x + b y +
// c, and in int32 (HARD-CASES 1, 3, 5, T8). Both see the same snapped vertices and the same
// top-left rule.
#include "raster/exactly_once.h"

#include <cstdint>

namespace scanout::naive {
namespace {

using namespace raster::test;

constexpr int kCoverageSide = 64;

// A triangle wound clockwise on the screen, and which of its edges are top or left.
struct Wound {
    Corners v;
    std::array<bool, 3> top_left;
    explicit Wound(Corners corners) : v(corners), top_left{} {
        if (oracle::area(v) < 0) std::swap(v[1], v[2]);
        for (std::size_t i = 0; i < 3; ++i) {
            const Corner &a = v[i], &b = v[(i + 1) % 3];
            top_left[i] = b.y < a.y || (b.y == a.y && b.x > a.x);
        }
    }
};

// (to - from) x (p - from), in float pixels.
struct VertexRelativeFloat {
    static constexpr const char* kName = "float_relative_to_a_vertex";
    static float edge(const Corner& a, const Corner& b, int x, int y) {
        const float ax = static_cast<float>(a.x) / 256, ay = static_cast<float>(a.y) / 256;
        const float dx = static_cast<float>(b.x) / 256 - ax,
                    dy = static_cast<float>(b.y) / 256 - ay;
        const float px = static_cast<float>(x) + 0.5F, py = static_cast<float>(y) + 0.5F;
        return dx * (py - ay) - dy * (px - ax);
    }
};
// A x + B y + C, in float pixels.
struct PlaneFloat {
    static constexpr const char* kName = "float_plane";
    static float edge(const Corner& a, const Corner& b, int x, int y) {
        const float ax = static_cast<float>(a.x) / 256, ay = static_cast<float>(a.y) / 256;
        const float bx = static_cast<float>(b.x) / 256, by = static_cast<float>(b.y) / 256;
        const float px = static_cast<float>(x) + 0.5F, py = static_cast<float>(y) + 0.5F;
        const float cx = ay - by, cy = bx - ax, c = -(cx * ax + cy * ay);
        return (cx * px + cy * py) + c;
    }
};
// Fixed point in 32 bits, wrapping where it overflows.
struct Int32 {
    static constexpr const char* kName = "int32";
    static std::int32_t edge(const Corner& a, const Corner& b, int x, int y) {
        const auto u = [](std::int64_t v) { return static_cast<std::uint32_t>(v); };
        return static_cast<std::int32_t>(u(b.x - a.x) * u(y * 256 + 128 - a.y) -
                                         u(b.y - a.y) * u(x * 256 + 128 - a.x));
    }
};

template <class Method>
Hits naive_hits(const SnappedMesh& mesh, int x0, int y0) {
    std::vector<int> count(std::size_t{kCoverageSide} * kCoverageSide);
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
        if (!has_area(mesh.corners(t))) continue;
        const Wound w(mesh.corners(t));
        const auto [left, right] = std::minmax({w.v[0].x, w.v[1].x, w.v[2].x});
        const auto [top, bottom] = std::minmax({w.v[0].y, w.v[1].y, w.v[2].y});
        for (int y = std::max(y0, top >> 8); y < std::min(y0 + kCoverageSide, (bottom >> 8) + 1);
             ++y)
            for (int x = std::max(x0, left >> 8);
                 x < std::min(x0 + kCoverageSide, (right >> 8) + 1); ++x) {
                bool inside = true;
                for (std::size_t i = 0; i < 3 && inside; ++i) {
                    const auto e = Method::edge(w.v[i], w.v[(i + 1) % 3], x, y);
                    inside = e > 0 || (e == 0 && w.top_left[i]);
                }
                if (inside) ++count[static_cast<std::size_t>((y - y0) * kCoverageSide + x - x0)];
            }
    }
    Hits hits;
    for (const int n : count)
        (n == 0 ? hits.none : n == 1 ? hits.once : hits.more) += 1;
    return hits;
}

template <class Method>
void expect_naive_fails(const std::string& where, const std::vector<SnappedMesh>& meshes, int x,
                        int y, int at_least) {
    Hits naive, ours;
    for (SnappedMesh mesh : meshes) {
        mesh.move(x, y);
        naive += naive_hits<Method>(mesh, x, y);
        ours += hits_in_tile(mesh, x, y, 1);
    }
    EXPECT_EQ(ours.faults(), 0) << where;
    EXPECT_GE(naive.faults(), at_least) << Method::kName << ' ' << where;
    record(std::string(Method::kName) + "_" + where + "_gaps", static_cast<double>(naive.none));
    record(std::string(Method::kName) + "_" + where + "_doubles", static_cast<double>(naive.more));
}

std::vector<SnappedMesh> sliver_fans(int count, int margin) {
    Random random(1);
    std::vector<SnappedMesh> fans;
    for (int i = 0; i < count; ++i)
        fans.push_back(
            fan({random.whole(0, kCoverageSide * 256), random.whole(0, kCoverageSide * 256)}, 20000,
                around(kCoverageSide, margin)));
    return fans;
}
std::vector<SnappedMesh> grids() {
    Random random(2);
    std::vector<SnappedMesh> meshes;
    for (int i = 0; i < 20; ++i)
        meshes.push_back(jittered_grid(random));
    return meshes;
}

TEST(NaiveCoverage, FloatsLoseAndRepeatSamplesOfSliversAndOursDoNot) {
    expect_naive_fails<VertexRelativeFloat>("slivers", sliver_fans(5, 400), 0, 0, 3);
    expect_naive_fails<PlaneFloat>("slivers", sliver_fans(5, 400), 0, 0, 3);
}

// At the origin the naive method looks right: that is why small tests do not show it.
TEST(NaiveCoverage, AFloatPlaneLosesSamplesByTheThousandAtLargeOffsetsAndOursDoesNot) {
    expect_naive_fails<PlaneFloat>("grid_at_0", grids(), 0, 0, 0);
    expect_naive_fails<PlaneFloat>("grid_at_30000", grids(), 29952, 29952, 5);
    expect_naive_fails<PlaneFloat>("slivers_at_8192", sliver_fans(2, 16), 8192, 8192, 200);
    expect_naive_fails<PlaneFloat>("slivers_at_30000", sliver_fans(2, 16), 29952, 29952, 1000);
}

TEST(NaiveCoverage, Int32OverflowsOnTrianglesWiderThan128PixelsAndOursDoesNot) {
    std::vector<SnappedMesh> fans;
    for (int i = 0; i < 8; ++i)
        fans.push_back(
            fan({30 * 256 + 128, 30 * 256 + 128}, 8, around(kCoverageSide, 200 + 30 * i)));
    expect_naive_fails<Int32>("wide", fans, 0, 0, 1);
}

} // namespace
} // namespace scanout::naive
