// Triangles set up for shading, by items each on its own, or once in the cache, alone or with
// others, have the bits of a scalar reference: a million random triangles, on every target; under a
// sanitizer a sixth of them, which go through the same code.
#include "base/jobs.h"
#include "rows.h"
#include "shade/gather/gather.h"
#include "shade/setup/primitive_cache.h"
#include "shade/setup/primitive_reference.h"
#include "shade/setup/shading_setup.h"
#include "support/random.h"
#include "support/targets.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <utility>

#include <gtest/gtest.h>

namespace scanout::shade::test {
namespace {

using scanout::test::Random;

constexpr int kScreenSide = 2000; // pixels

#ifdef SCANOUT_SANITIZED
constexpr int kRounds = 8;
#else
constexpr int kRounds = 52;
#endif

// Triangles of all sizes before the eye; some of their vertices are beyond the guard band.
geom::Mesh random_mesh(Random& random, int triangles) {
    geom::Mesh mesh;
    const auto real = [&] { return static_cast<float>(random.in(-1, 1)); };
    for (int i = 0; i < triangles; ++i) {
        const double size = std::exp2(random.in(-12, 1));
        const DVec3 middle = random.in_cube(1);
        const bool flat = i % 3 == 0;
        for (int k = 0; k < 3; ++k) {
            const DVec3 p = middle + random.in_cube(size);
            mesh.index.push_back(static_cast<std::uint32_t>(mesh.position.size()));
            mesh.position.emplace_back(p.x, p.y, p.z - 2.5);
            const Vec3 normal(real(), real(), real());
            mesh.normal.push_back(flat && k > 0 ? mesh.normal.back() : normal);
            mesh.uv.emplace_back(real(), real());
            mesh.colour.emplace_back(real(), real(), real());
        }
        mesh.material.push_back(-1);
    }
    return mesh;
}

std::int64_t area(std::span<const raster::ScreenVertex> v, std::uint32_t triangle) {
    const auto& [a, b, c] = std::array{v[triangle * 3], v[triangle * 3 + 1], v[triangle * 3 + 2]};
    return raster::signed_area({a.x, b.x, c.x}, {a.y, b.y, c.y});
}

// A block's lanes with triangles of their own, at random samples near them.
struct TriangleLanes {
    std::unique_ptr<ShadingBlock> block = std::make_unique<ShadingBlock>();
    std::unique_ptr<ShadingSetup> triangles = std::make_unique<ShadingSetup>();

    std::uint32_t id(int lane) const { return triangles->id[triangles->triangle_of[lane]]; }
    void add(Random& random, std::uint32_t id, const raster::ScreenVertex& near) {
        const int lane = block->count++;
        const bool again = lane > 0 && triangles->id[triangles->count - 1] == id;
        if (!again) triangles->id[triangles->count++] = id;
        triangles->triangle_of[lane] = triangles->count - 1;
        block->x[lane] = (near.x & -256) + 128 + 256 * random.whole(-1, 1);
        block->y[lane] = (near.y & -256) + 128 + 256 * random.whole(-1, 1);
        triangles->sample_x[lane] = random.whole(-128, 127);
        triangles->sample_y[lane] = random.whole(-128, 127);
    }
};

std::uint32_t bits(float value) {
    return std::bit_cast<std::uint32_t>(value);
}

// At a lane of `set_up`, which has moved from where it was in `before`.
void expect_same(const GatherInput& in, const Primitive& p, const TriangleLanes& before,
                 const TriangleLanes& set_up, int lane) {
    const ShadingSetup& t = *set_up.triangles;
    const int n = t.triangle_of[lane];
    const std::int32_t x = before.block->x[lane], y = before.block->y[lane];
    const auto at =
        place_in_pixel(in, p, x >> 8, y >> 8, {t.sample_x[lane] + 128, t.sample_y[lane] + 128});
    ASSERT_EQ(set_up.block->x[lane], at.x);
    ASSERT_EQ(set_up.block->y[lane], at.y);
    for (int k = 0; k < 3; ++k) {
        const auto weight = static_cast<float>((p.a[k] * at.x + p.b[k] * at.y) + p.c[k]);
        ASSERT_EQ(bits(t.weight[k][lane]), bits(weight * p.inverse_w[k]));
        if (in.frame->sides == Sides::eye || in.frame->attributes.facing) {
            ASSERT_EQ(bits(t.facing[k][n]), bits(p.facing[k]));
        }
        for (int c = 0; c < 3; ++c) {
            ASSERT_EQ(bits(t.normal[c][k][n]), bits(p.normal[c][k]));
            ASSERT_EQ(bits(t.colour[c][k][n]), bits(p.colour[c][k]));
            ASSERT_EQ(bits(t.position[c][k][n]), bits(p.position[c][k]));
            ASSERT_EQ(bits(t.uv[c % 2][k][n]), bits(p.uv[c % 2][k]));
        }
    }
}

// Set up by the reference and by the cache.
void expect_same(const GatherInput& in, const Primitive& expected, const Primitive& got) {
    ASSERT_EQ(expected.id, got.id);
    ASSERT_EQ(expected.fits_int32, got.fits_int32);
    ASSERT_EQ(expected.clipped, got.clipped);
    ASSERT_EQ(expected.across, got.across);
    ASSERT_EQ(expected.step, got.step);
    const auto same = [](const auto& one, const auto& other) {
        return std::memcmp(&one, &other, sizeof one) == 0;
    };
    ASSERT_TRUE(same(expected.a, got.a));
    ASSERT_TRUE(same(expected.b, got.b));
    ASSERT_TRUE(same(expected.c, got.c));
    ASSERT_TRUE(same(expected.a_int32, got.a_int32));
    ASSERT_TRUE(same(expected.b_int32, got.b_int32));
    ASSERT_TRUE(same(expected.c_int32, got.c_int32));
    ASSERT_TRUE(same(expected.least, got.least));
    ASSERT_TRUE(same(expected.inverse_w, got.inverse_w));
    if (triangle_source(in).wants_facing()) {
        ASSERT_TRUE(same(expected.facing, got.facing));
    }
    ASSERT_TRUE(same(expected.normal, got.normal));
    ASSERT_TRUE(same(expected.uv, got.uv));
    ASSERT_TRUE(same(expected.colour, got.colour));
    ASSERT_TRUE(same(expected.position, got.position));
}

// As many at once as there are lanes, which fill registers or do not; and one by one.
void check_cache(const GatherInput& in, const TriangleLanes& lanes, PrimitiveCache& alone) {
    auto together = std::make_unique<PrimitiveCache>();
    together->begin(in);
    const int count = lanes.block->count;
    for (int lane = 0; lane < count; ++lane) {
        together->get_later(lanes.id(lane));
        if (lane == count / 3 || lane == count - 1) together->set_up();
    }
    for (int lane = 0; lane < count && !testing::Test::HasFatalFailure(); ++lane) {
        const std::uint32_t id = lanes.id(lane);
        const PrimitiveReference reference(in, id);
        expect_same(in, reference.p, together->get_later(id));
        expect_same(in, reference.p, alone.get(id));
    }
}

// The block's lanes at triangles that are set up once; lanes `own` to `end` at their own.
std::unique_ptr<ShadingBlock> interpolated(const GatherInput& in, PrimitiveCache& once,
                                           const TriangleLanes& set_up, int own, int end) {
    auto block = std::make_unique<ShadingBlock>(*set_up.block);
    const scene::Material material;
    block->material = &material;
    block->triangles = set_up.triangles.get();
    const int count = std::exchange(block->count, 0);
    while (block->count < count) {
        const int lane = block->count;
        if (lane == own && own < end)
            add_items(*block, nullptr, end - own);
        else
            add_items(*block, &once.get(set_up.id(lane)), 1);
    }
    find_stage("interpolate", "perspective")->run(*block, *in.frame);
    return block;
}

// What stages read; lanes of both kinds side by side in the block.
void expect_same_attributes(const GatherInput& in, PrimitiveCache& once,
                            const TriangleLanes& set_up) {
    const int count = set_up.block->count;
    const auto expected = interpolated(in, once, set_up, 0, 0);
    const auto got = interpolated(in, once, set_up, count / 5, count - count / 7);
    for (int lane = 0; lane < count; ++lane) {
        for (int c = 0; c < 3; ++c) {
            ASSERT_EQ(bits(got->normal[c][lane]), bits(expected->normal[c][lane])) << lane;
            ASSERT_EQ(bits(got->position[c][lane]), bits(expected->position[c][lane])) << lane;
            ASSERT_EQ(bits(got->albedo[c][lane]), bits(expected->albedo[c][lane])) << lane;
        }
        ASSERT_EQ(bits(got->u[lane]), bits(expected->u[lane])) << lane;
        ASSERT_EQ(bits(got->v[lane]), bits(expected->v[lane])) << lane;
        ASSERT_EQ(bits(got->u_x[lane]), bits(expected->u_x[lane])) << lane;
        ASSERT_EQ(bits(got->v_x[lane]), bits(expected->v_x[lane])) << lane;
        ASSERT_EQ(bits(got->u_y[lane]), bits(expected->u_y[lane])) << lane;
        ASSERT_EQ(bits(got->v_y[lane]), bits(expected->v_y[lane])) << lane;
    }
}

struct Counts {
    int lanes = 0, moved = 0, large = 0, turned = 0;
};

void check(const GatherInput& in, const TriangleLanes& lanes, Counts& counts) {
    auto once = std::make_unique<PrimitiveCache>();
    const int count = lanes.block->count;
    scanout::test::on_every_target([&](const std::string&) {
        const TriangleLanes own{std::make_unique<ShadingBlock>(*lanes.block),
                                std::make_unique<ShadingSetup>(*lanes.triangles)};
        // In two parts, so that registers are not full, and do not begin where blocks do.
        const int part = count / 3;
        set_up_run(triangle_source(in), *own.triangles, *own.block, 0, part);
        set_up_run(triangle_source(in), *own.triangles, *own.block, part, count - part);
        once->begin(in);
        for (int lane = 0; lane < count && !testing::Test::HasFatalFailure(); ++lane) {
            const Primitive p = PrimitiveReference(in, own.id(lane)).p;
            expect_same(in, p, lanes, own, lane);
            counts.lanes += 1;
            counts.moved += own.block->x[lane] != lanes.block->x[lane] ? 1 : 0;
            counts.large += p.fits_int32 ? 0 : 1;
            counts.turned += own.triangles->side[own.triangles->triangle_of[lane]] < 0 ? 1 : 0;
        }
        check_cache(in, lanes, *once);
        if (!testing::Test::HasFatalFailure()) expect_same_attributes(in, *once, own);
    });
}

TEST(ShadingSetup, HasTheBitsOfTheReferenceByItemsAndInTheCache) {
    Jobs jobs(1);
    Random random(7);
    Counts counts;
    for (int round = 0; round < kRounds; ++round) {
        const int triangles = 20000;
        const geom::Mesh mesh = random_mesh(random, triangles);
        scene::View view;
        view.half_width = view.half_height = 0.02 + 0.3 * random.unit();
        view.near_distance = 0x1p-6;
        view.mirrored = round % 2 == 1;
        if (round % 5 == 4) {
            view.projection = scene::Projection::orthographic;
            view.depth_origin = -8;
            view.depth_scale = 1.0 / 16;
        }
        view.linear[1][0] = random.in(-0.2, 0.2);
        view.translation.x = random.in(-0.1, 0.1);
        const raster::ScreenTransform transform(view, kScreenSide, kScreenSide);
        raster::Geometry geometry;
        raster::GeometryOptions options;
        options.width = options.height = kScreenSide;
        geometry.run(jobs, mesh, transform, options);
        FrameState frame;
        frame.attributes = {.normal = true, .uv = true, .colour = true, .position = true};
        frame.attributes.footprint = true;
        frame.attributes.facing = round % 7 < 3;
        frame.source = find_row(shade::source::kRows, "checker"); // wants u and v
        for (auto& row : frame.normal_matrix)
            for (float& m : row)
                m = static_cast<float>(random.in(-1, 1));
        frame.sides = std::array{Sides::eye, Sides::face, Sides::file}[round % 3];
        GatherInput in;
        in.mesh = &mesh;
        in.geometry = &geometry;
        in.transform = &transform;
        in.set_view(view);
        in.frame = &frame;
        in.mirrored = view.mirrored;
        const auto vertices = geometry.vertices();
        const TriangleSource source = triangle_source(in);
        TriangleLanes lanes;
        for (std::uint32_t id = 0; id < static_cast<std::uint32_t>(triangles); ++id) {
            if (!is_unclipped(source, id) || area(vertices, id) == 0) continue;
            // Some show in more lanes than a register has.
            const int most = kBlockSize - lanes.block->count;
            for (int left = std::min(most, random.whole(0, 9) == 0 ? 20 : random.whole(1, 3));
                 left > 0; --left)
                lanes.add(random, id, vertices[id * 3 + id % 3]);
            if (lanes.block->count < kBlockSize) continue;
            check(in, lanes, counts);
            if (HasFatalFailure()) FAIL() << "round " << round;
            lanes.block->count = lanes.triangles->count = 0;
        }
    }
    EXPECT_GT(counts.lanes, kRounds * 6000);
    EXPECT_GT(counts.moved, kRounds * 600);
    EXPECT_GT(counts.large, kRounds * 600);
    EXPECT_GT(counts.turned, kRounds * 600);
}

} // namespace
} // namespace scanout::shade::test
