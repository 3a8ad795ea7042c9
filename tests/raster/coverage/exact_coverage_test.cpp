// Coverage against exact arithmetic, and what must not change it: HARD-CASES 4, 5, P2-P5.
#include "oracle/plane.h"
#include "raster/exact.h"
#include "raster/tile/tile.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace scanout::raster::test {
namespace {

constexpr int kExactSide = 64;

// Near a tile of side x side pixels whose corner stands at `at`.
Corners random_corners(Random& random, int kind, int side, const Corner& at) {
    const int size = side * 256;
    const auto anywhere = [&] { return random.whole(-size / 2, size + size / 2); };
    Corners v;
    for (Corner& c : v) {
        switch (kind % 9) {
        case 1: // pixel corners
            c = {anywhere() & ~255, anywhere() & ~255};
            break;
        case 2: // pixel centres
            c = {(anywhere() & ~255) + 128, (anywhere() & ~255) + 128};
            break;
        case 3: // small
            c = {size / 3 + random.whole(0, 700), size / 3 + random.whole(0, 700)};
            break;
        case 4: // the whole guard band
            c = {random.whole(-32767 * 256, 32767 * 256) - at.x,
                 random.whole(-32767 * 256, 32767 * 256) - at.y};
            break;
        case 5: // sixteenths, where the samples of the patterns lie
            c = {anywhere() & ~15, anywhere() & ~15};
            break;
        case 6: // of the size that one vertex tells: 2^0 ... 2^22 units
            c = {size / 2 + (random.whole(-256, 256) << (kind / 9 % 15)),
                 size / 2 + (random.whole(-256, 256) << (kind / 9 % 15))};
            break;
        default:
            c = {anywhere(), anywhere()};
        }
        c = {std::clamp(c.x + at.x, -32767 * 256, 32767 * 256),
             std::clamp(c.y + at.y, -32767 * 256, 32767 * 256)};
    }
    if (kind % 9 == 7) { // collinear, or off by one step of the grid
        v[1] = {v[0].x + random.whole(-size / 2, size / 2),
                v[0].y + random.whole(-size / 2, size / 2)};
        v[2] = {v[0].x + 2 * (v[1].x - v[0].x), v[0].y + 2 * (v[1].y - v[0].y)};
        v[2].x += random.whole(-1, 1);
        for (Corner& c : v)
            c = {std::clamp(c.x, -32767 * 256, 32767 * 256),
                 std::clamp(c.y, -32767 * 256, 32767 * 256)};
    }
    if (kind % 9 == 8 && random.bits() % 2 == 0)
        v[2] = v[static_cast<std::size_t>(random.whole(0, 1))];
    return v;
}

std::string text(const Corners& v) {
    std::string out;
    for (const Corner& c : v)
        out += std::to_string(c.x) + "," + std::to_string(c.y) + " ";
    return out;
}

// Samples in which the rasteriser and the oracle differ; `covered` counts those that both cover.
int mismatches(const Corners& v, const image::Rect& area, int samples, VisibilityTile& tile,
               std::int64_t& covered) {
    tile.reset(area, samples);
    if (has_area(v)) tile.draw(set_up(v, 3));
    const ExactTriangle exact(v);
    int wrong = 0;
    for (std::size_t s = 0; s < tile.pattern().size(); ++s) {
        for (int y = area.y0; y < area.y1; ++y) {
            auto e = exact.at(area.x0 * 256 + tile.pattern()[s].x, y * 256 + tile.pattern()[s].y);
            for (int x = area.x0; x < area.x1; ++x, exact.step_right(e)) {
                const bool inside = exact.inside(e);
                wrong += (tile.id(x, y, static_cast<int>(s)) == 3) != inside ? 1 : 0;
                covered += inside ? 1 : 0;
            }
        }
    }
    return wrong;
}

// HARD-CASES P2: a million triangles in ten parts, most of them in small tiles at places all over
// the range of pictures.
class AMillionTriangles : public testing::TestWithParam<int> {};

TEST_P(AMillionTriangles, AgreeWithExactArithmetic) {
    constexpr int kCount = 100000;
    Random random(static_cast<std::uint64_t>(GetParam()) + 100);
    VisibilityTile tile;
    std::int64_t covered = 0;
    for (int i = 0; i < kCount; ++i) {
        const int side = i % 10 == 0 ? kExactSide : 16;
        const int x = random.whole(0, 255) * 64, y = random.whole(0, 255) * 64;
        const Corners v = random_corners(random, i + GetParam(), side, {x * 256, y * 256});
        ASSERT_EQ(mismatches(v, {x, y, x + side, y + side}, 1, tile, covered), 0) << text(v);
    }
    EXPECT_GT(covered, kCount * 20);
    record("triangles", kCount);
    record("samples_covered", static_cast<double>(covered));
    record("mismatches", 0);
}
INSTANTIATE_TEST_SUITE_P(P2, AMillionTriangles, testing::Range(0, 10));

// HARD-CASES 7, P2
TEST(ExactCoverage, HoldsAtEverySampleOfEveryPattern) {
    Random random(5);
    VisibilityTile tile;
    std::int64_t covered = 0;
    for (const int samples : {2, 4, 8, 16})
        for (int i = 0; i < 6000; ++i) {
            const Corners v = random_corners(random, i, 24, {0, 0});
            ASSERT_EQ(mismatches(v, {0, 0, 24, 24}, samples, tile, covered), 0) << text(v);
        }
    record("samples_covered", static_cast<double>(covered));
}

// A tile's picture of one triangle, as bits.
struct Mask {
    std::vector<std::uint32_t> id;
    std::vector<float> depth;
    friend bool operator==(const Mask&, const Mask&) = default;
};
Mask mask_of(const Triangle& t, const image::Rect& area, int samples, VisibilityTile& tile) {
    tile.reset(area, samples);
    tile.draw(t);
    Mask m;
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x)
            for (int s = 0; s < samples; ++s) {
                m.id.push_back(tile.id(x, y, s));
                m.depth.push_back(tile.depth(x, y, s));
            }
    return m;
}

// HARD-CASES P3: six permutations, both windings among them; coverage, depth and id.
TEST(ExactCoverage, TheOrderOfTheVerticesChangesNoBit) {
    constexpr std::size_t kOrder[5][3] = {{1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    Random random(6);
    VisibilityTile tile;
    int drawn = 0;
    for (int i = 0; i < 20000; ++i) {
        const Corners v = random_corners(random, i, 24, {0, 0});
        if (!has_area(v)) continue;
        const std::array<double, 3> depth = {random.unit(), random.unit(), random.unit()};
        const int samples = i % 4 == 0 ? 4 : 1;
        const Mask first = mask_of(set_up(v, 1, depth), {0, 0, 24, 24}, samples, tile);
        for (const auto& o : kOrder) {
            const Triangle turned =
                set_up({v[o[0]], v[o[1]], v[o[2]]}, 1, {depth[o[0]], depth[o[1]], depth[o[2]]});
            ASSERT_EQ(mask_of(turned, {0, 0, 24, 24}, samples, tile), first) << text(v);
        }
        drawn += tile.empty() ? 0 : 1;
    }
    EXPECT_GT(drawn, 8000);
    record("triangles_seen", drawn);
}

// HARD-CASES P4: every shift in [-64, 64] squared; the mask moves along, depth stays within one
// unit in its last place.
TEST(ExactCoverage, WholePixelShiftsMoveTheMaskAlong) {
    Random random(7);
    VisibilityTile still, moved;
    std::int64_t samples = 0, worst = 0;
    constexpr int kBox = 16; // the triangle lies in pixels [64, 80) and goes to [0, 144)
    for (int dy = -64; dy <= 64; ++dy) {
        for (int dx = -64; dx <= 64; ++dx) {
            Corners v;
            for (Corner& c : v)
                c = {random.whole(64 * 256, 80 * 256), random.whole(64 * 256, 80 * 256)};
            if (!has_area(v)) continue;
            const std::array<double, 3> depth = {random.unit(), random.unit(), random.unit()};
            still.reset({64, 64, 128, 128}, 1);
            still.draw(set_up(v, 1, depth));
            Corners w = v;
            for (Corner& c : w)
                c = {c.x + dx * 256, c.y + dy * 256};
            // The four tiles that the moved box may touch
            for (int ty = (64 + dy) / 64 * 64; ty < 80 + dy; ty += 64) {
                for (int tx = (64 + dx) / 64 * 64; tx < 80 + dx; tx += 64) {
                    moved.reset({tx, ty, tx + 64, ty + 64}, 1);
                    moved.draw(set_up(w, 1, depth));
                    for (int y = std::max(ty, 64 + dy); y < std::min(ty + 64, 64 + dy + kBox);
                         ++y) {
                        for (int x = std::max(tx, 64 + dx); x < std::min(tx + 64, 64 + dx + kBox);
                             ++x) {
                            ASSERT_EQ(still.id(x - dx, y - dy), moved.id(x, y))
                                << text(v) << dx << ' ' << dy;
                            if (moved.id(x, y) != 1) continue;
                            ++samples;
                            worst =
                                std::max(worst, oracle::floats_between(still.depth(x - dx, y - dy),
                                                                       moved.depth(x, y)));
                        }
                    }
                }
            }
        }
    }
    EXPECT_LE(worst, 1);
    EXPECT_GT(samples, 129 * 129 * 10);
    record("samples_compared", static_cast<double>(samples));
    record("worst_depth_ulp", static_cast<double>(worst));
}

// HARD-CASES P5: a triangle against its two parts, cut from a corner to a point of the opposite
// edge that the grid holds exactly.
TEST(ExactCoverage, ASplitTriangleIsTheSameTriangle) {
    Random random(8);
    VisibilityTile whole, part[2];
    std::int64_t covered = 0;
    for (int i = 0; i < 30000; ++i) {
        Corners v;
        const int steps = random.whole(2, 16), at = random.whole(1, steps - 1);
        const int reach = i % 3 == 0 ? 1000 : 20;
        v[0] = {random.whole(-4 * 256, 36 * 256), random.whole(-4 * 256, 36 * 256)};
        const Corner d{random.whole(-reach * 256, reach * 256) / steps,
                       random.whole(-reach * 256, reach * 256) / steps};
        v[1] = {v[0].x + steps * d.x, v[0].y + steps * d.y};
        v[2] = {random.whole(-4 * 256, 36 * 256), random.whole(-4 * 256, 36 * 256)};
        const Corner cut{v[0].x + at * d.x, v[0].y + at * d.y};
        if (!has_area(v)) continue;
        const int samples = 1 << i % 5;
        whole.reset({0, 0, 32, 32}, samples);
        whole.draw(set_up(v, 1));
        const Corners half[2] = {{v[0], cut, v[2]}, {cut, v[1], v[2]}};
        for (std::size_t k = 0; k < 2; ++k) {
            part[k].reset({0, 0, 32, 32}, samples);
            if (has_area(half[k])) part[k].draw(set_up(half[k], 1));
        }
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x)
                for (int s = 0; s < samples; ++s) {
                    const int in = whole.id(x, y, s) == 1 ? 1 : 0;
                    const int parts =
                        (part[0].id(x, y, s) == 1 ? 1 : 0) + (part[1].id(x, y, s) == 1 ? 1 : 0);
                    ASSERT_EQ(parts, in) << text(v) << cut.x << ',' << cut.y;
                    covered += in;
                }
    }
    EXPECT_GT(covered, 1000000);
    record("samples_covered", static_cast<double>(covered));
}

// HARD-CASES 4, R6: what snaps to no area is dropped, and nothing else is.
TEST(ExactCoverage, ATriangleIsDroppedWhenItsSnappedAreaIsZeroAndOnlyThen) {
    Random random(9);
    int flat = 0, least = 0;
    for (int i = 0; i < 300000; ++i) {
        const Corners v = random_corners(random, 7 + 9 * (i % 2) + i % 2, 64, {0, 0});
        const bool empty = oracle::area(v) == 0;
        std::array<ScreenVertex, 3> s;
        for (std::size_t k = 0; k < 3; ++k) {
            s[k].x = v[k].x;
            s[k].y = v[k].y;
            s[k].depth = 0.5;
        }
        ASSERT_EQ(raster::set_up(s, 1).has_value(), !empty) << text(v);
        flat += empty ? 1 : 0;
        least += oracle::area(v) == 1 || oracle::area(v) == -1 ? 1 : 0;
    }
    EXPECT_GT(flat, 40000);
    record("zero_area", flat);
    record("area_of_one_unit", least);
}

// HARD-CASES 4: vertices that stand in a line, or in one place, only after snapping; by the
// geometry stage.
TEST(ExactCoverage, WhatSnapsToNoAreaHasNoFragmentButItsOutlineHas) {
    Random random(10);
    Jobs jobs(1);
    geom::Mesh mesh;
    for (int i = 0; i < 600; ++i) {
        const Corner at{random.whole(20 * 256, 40 * 256), random.whole(20 * 256, 40 * 256)};
        const int far = i % 3 == 0 ? 0 : 9 * 256;
        const Corner step{random.whole(-far, far), random.whole(-far, far)};
        for (int k = 0; k < 3; ++k) {
            mesh.index.push_back(static_cast<std::uint32_t>(mesh.position.size()));
            mesh.position.emplace_back((at.x + k * step.x + random.in(-0.49, 0.49)) / 256,
                                       (at.y + k * step.y + random.in(-0.49, 0.49)) / 256, 0.5);
            mesh.normal.emplace_back(0, 0, 1);
        }
        mesh.material.push_back(-1);
    }
    geom::Mesh outline = mesh;
    outline.index.clear();
    outline.material.clear();
    for (std::uint32_t i = 0; i < mesh.position.size(); i += 3) {
        outline.line_index.insert(outline.line_index.end(), {i, i + 1});
        outline.line_material.push_back(-1);
    }
    const auto fragments = [&](const geom::Mesh& m) {
        const Planes planes =
            draw_planes(jobs, m, pixel_view(kExactSide, kExactSide), kExactSide, kExactSide, 4);
        for (const float depth : planes.depths)
            EXPECT_TRUE(depth >= 0 && depth <= 1);
        return std::count_if(planes.ids.begin(), planes.ids.end(),
                             [](std::uint32_t id) { return id != kNoPrimitive; });
    };
    EXPECT_EQ(fragments(mesh), 0);
    EXPECT_GT(fragments(outline), 300);
}

TEST(ExactCoverage, BoundsNeverLoseACoveredSample) {
    Random random(7);
    for (int i = 0; i < 4000; ++i) {
        const Corners v = random_corners(random, i, 64, {0, 0});
        if (!has_area(v)) continue;
        const int width = random.whole(1, 64), height = random.whole(1, 64);
        const auto pattern = sample_pattern(1 << i % 5);
        const image::Rect box = pixel_bounds(set_up(v, 0), width, height, extent_of(pattern));
        EXPECT_GE(box.x0, 0);
        EXPECT_GE(box.y0, 0);
        EXPECT_LE(box.x1, width);
        EXPECT_LE(box.y1, height);
        const ExactTriangle exact(v);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (const SampleOffset& at : pattern) {
                    if (x >= box.x0 && x < box.x1 && y >= box.y0 && y < box.y1) continue;
                    ASSERT_FALSE(exact.covers(x * kSubpixel + at.x, y * kSubpixel + at.y)) << i;
                }
    }
}

} // namespace
} // namespace scanout::raster::test
