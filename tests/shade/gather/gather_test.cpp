// Where a triangle is shaded in a pixel: at the centre if it covers it, else at its first covered
// sample. For clipped triangles, too, coverage and shading say the same.
#include "base/jobs.h"
#include "shade/gather/gather.h"
#include "support/random.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

namespace scanout::shade::test {
namespace {

using scanout::test::Random;

constexpr int kGatheredSide = 48;

// The samples that stand for pixels, in the order of shading; a stage has no other memory.
std::map<std::pair<int, int>, std::pair<int, int>>& shaded() {
    static std::map<std::pair<int, int>, std::pair<int, int>> at;
    return at;
}
const Stage kNoting{
    {.axis = "test", .name = "noting", .blurb = "", .source = ""},
    Pass::light,
    {},
    [](ShadingBlock& block, const FrameState&) {
        for (int i = 0; i < block.count; ++i) {
            const int x = block.x[i], y = block.y[i];
            EXPECT_TRUE(shaded().try_emplace({x >> 8, y >> 8}, x & 255, y & 255).second);
            for (auto& channel : block.albedo)
                channel[i] = 1;
            for (auto& channel : block.colour)
                channel[i] = 1;
        }
    }};

struct Drawn {
    raster::Geometry geometry;
    raster::VisibilityTile tile;
    Drawn(Jobs& jobs, const geom::Mesh& mesh, const raster::ScreenTransform& transform,
          int samples) {
        raster::GeometryOptions options;
        options.width = options.height = kGatheredSide;
        options.samples = samples;
        geometry.run(jobs, mesh, transform, options);
        tile.reset(geometry.tile_area(0), samples);
        geometry.draw(0, tile);
    }
};

scene::View view_from_origin() {
    scene::View view;
    view.half_width = view.half_height = 0.5;
    view.near_distance = 0x1p-8;
    return view;
}

GatherInput input_of(const geom::Mesh& mesh, const scene::View& view,
                     const raster::ScreenTransform& transform, const Drawn& drawn,
                     std::span<const Stage* const> stages, const FrameState& frame) {
    static const scene::Material unnamed;
    GatherInput in;
    in.mesh = &mesh;
    in.keys.mesh = &mesh;
    in.unnamed = &unnamed;
    in.set_view(view);
    in.geometry = &drawn.geometry;
    in.transform = &transform;
    in.stages = stages;
    in.frame = &frame;
    return in;
}

std::uint64_t shade(Gatherer& gatherer, const Drawn& drawn, const GatherInput& in,
                    image::Image& picture) {
    PictureSink sink;
    sink.set(picture);
    return gatherer.shade(drawn.tile, in, sink);
}

TEST(Gather, ShadesATriangleAtTheCentreWhereItCoversItClippedOrNot) {
    Jobs jobs(1);
    Random random(1);
    const scene::View view = view_from_origin();
    const raster::ScreenTransform transform(view, kGatheredSide, kGatheredSide);
    int at_centre[2] = {}, elsewhere[2] = {};
    for (int i = 0; i < 3000; ++i) {
        geom::Mesh mesh;
        const double size = std::exp2(random.in(-6, 3));
        for (std::uint32_t k = 0; k < 3; ++k) {
            mesh.index.push_back(k);
            const DVec3 p = random.in_cube(size);
            // Half of them in front of the eye with all vertices.
            mesh.position.emplace_back(p.x, p.y, i % 2 == 0 ? -1.5 + p.z / size : p.z);
            mesh.normal.emplace_back(0, 0, 1);
        }
        mesh.material.push_back(-1);
        const int samples = 2 << (i % 4);
        const Drawn centres(jobs, mesh, transform, 1), all(jobs, mesh, transform, samples);
        const auto vertices = all.geometry.vertices();
        const bool clipped = !std::all_of(vertices.begin(), vertices.end(),
                                          [](const auto& v) { return v.on_screen(); });
        const Stage* stages[] = {&kNoting};
        FrameState frame;
        frame.per_item_setup = i / 2 % 2 == 0; // on both ways from a triangle to lanes
        const GatherInput in = input_of(mesh, view, transform, all, stages, frame);
        image::Image picture(kGatheredSide, kGatheredSide);
        shaded().clear();
        Gatherer gatherer;
        shade(gatherer, all, in, picture);
        for (int y = 0; y < kGatheredSide; ++y)
            for (int x = 0; x < kGatheredSide; ++x) {
                const auto found = shaded().find({x, y});
                int first = 0;
                while (first < samples && all.tile.id(x, y, first) != 0)
                    ++first;
                ASSERT_EQ(found == shaded().end(), first == samples);
                if (first == samples) continue;
                const bool centre = centres.tile.id(x, y) == 0;
                const raster::SampleOffset at =
                    centre ? raster::kPixelCentre
                           : all.tile.pattern()[static_cast<std::size_t>(first)];
                ASSERT_EQ(found->second, std::pair(at.x, at.y)) << i << ": " << x << ' ' << y;
                (centre ? at_centre : elsewhere)[clipped ? 1 : 0] += 1;
            }
    }
    for (const int k : {0, 1}) {
        EXPECT_GT(at_centre[k], 20000);
        EXPECT_GT(elsewhere[k], 2000);
    }
}

std::uint32_t id_at(const ShadingSetup& triangles, int lane) {
    return triangles.id[triangles.triangle_of[lane]];
}

// Light that is another in each triangle and at each sample, so that sums tell their order.
float speckle(std::uint32_t id, int x, int y, std::uint32_t channel) {
    const std::uint32_t mixed = (id * 0x9e3779b9U ^ static_cast<std::uint32_t>(x * 40503 + y)) *
                                (0x85ebca6bU + 2 * channel);
    return static_cast<float>(mixed >> 8) * 0x1p-24F;
}
const Stage kSpeckled{{.axis = "test", .name = "speckled", .blurb = "", .source = ""},
                      Pass::light,
                      {},
                      [](ShadingBlock& block, const FrameState&) {
                          for (int r = 0; r < block.runs; ++r) {
                              const auto& [primitive, first, count] = block.run[r];
                              for (int i = first; i < first + count; ++i)
                                  for (std::uint32_t c = 0; c < 3; ++c)
                                      block.albedo[c][i] = block.colour[c][i] =
                                          speckle(primitive != nullptr ? primitive->id
                                                                       : id_at(*block.triangles, i),
                                                  block.x[i], block.y[i], c);
                          }
                      }};

// Triangles of all sizes before the eye, of one material.
geom::Mesh many_triangles(Random& random, int triangles) {
    geom::Mesh mesh;
    for (int i = 0; i < triangles; ++i) {
        const double size = std::exp2(random.in(-8, 0));
        const DVec3 middle = random.in_cube(0.5);
        for (int k = 0; k < 3; ++k) {
            const DVec3 p = middle + random.in_cube(size);
            mesh.index.push_back(static_cast<std::uint32_t>(mesh.position.size()));
            mesh.position.emplace_back(p.x, p.y, p.z * 0.1 - 1.5);
            mesh.normal.emplace_back(0, 0, 1);
        }
        mesh.material.push_back(-1);
    }
    return mesh;
}

TEST(Gather, SharedPixelsOfOneLookHaveTheBitsThatTheirListsWouldHave) {
    Jobs jobs(1);
    Random random(2);
    const scene::View view = view_from_origin();
    const raster::ScreenTransform transform(view, kGatheredSide, kGatheredSide);
    Gatherer listed, by_rows; // from tile to tile, as in frames
    const Stage* stages[] = {&kSpeckled};
    FrameState frame;
    frame.per_item_setup = true;
    for (int i = 0; i < 200; ++i) {
        const geom::Mesh mesh = many_triangles(random, 1 << i % 9);
        const Drawn all(jobs, mesh, transform, 2 << i % 4);
        ASSERT_TRUE(all.geometry.all_unclipped());
        GatherInput in = input_of(mesh, view, transform, all, stages, frame);
        in.background = {10, 200, 30, 128};
        image::Image one(kGatheredSide, kGatheredSide), other(kGatheredSide, kGatheredSide);
        LinearPicture one_light(kGatheredSide, kGatheredSide),
            other_light(kGatheredSide, kGatheredSide);
        in.linear = &one_light;
        const std::uint64_t lanes = shade(listed, all, in, one);
        in.keys.only_material = -1;
        in.linear = &other_light;
        EXPECT_EQ(shade(by_rows, all, in, other), lanes);
        ASSERT_EQ(one, other) << i;
        ASSERT_EQ(one_light, other_light) << i;
    }
}

} // namespace
} // namespace scanout::shade::test
