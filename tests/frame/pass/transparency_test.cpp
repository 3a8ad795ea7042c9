// The laws of transparency: what every technique owes to its scene, whatever the order of the file,
// the length of the lists, the tiles and the threads.
#include "image/compare.h"
#include "support/scenes.h"

#include <algorithm>
#include <numeric>

#include <gmock/gmock.h>

namespace scanout::test {
namespace {

image::Image drawn(const Shot& s, int threads = 1, int tile_size = 64) {
    return draw(s, {.threads = threads, .tile_size = tile_size});
}

// A soup in which two of five materials let light through.
Shot glass_soup(std::string name, int triangles, double size, std::uint64_t seed) {
    Shot s = soup(std::move(name), triangles, size, seed);
    s.scene.materials[1].opacity = 0.25F;
    s.scene.materials[4].opacity = 0.7F;
    return s;
}

std::vector<Shot> all_shots() {
    std::vector<Shot> shots = {glass_soup("glass", 600, 0.8, 11),
                               glass_soup("glass around the eye", 300, 6, 12)};
    for (const Shot& s : transparent_shots())
        shots.push_back(s);
    return shots;
}

// Triangles in another order; each keeps its vertices and its material.
Shot shuffled(const Shot& s, Random& random) {
    Shot out = s;
    const geom::Mesh& mesh = s.scene.mesh;
    std::vector<std::size_t> order(mesh.triangles());
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = order.size() - 1; i > 0; --i)
        std::swap(order[i], order[static_cast<std::size_t>(random.whole(0, static_cast<int>(i)))]);
    for (std::size_t i = 0; i < order.size(); ++i) {
        out.scene.mesh.material[i] = mesh.material[order[i]];
        for (std::size_t k = 0; k < 3; ++k)
            out.scene.mesh.index[i * 3 + k] = mesh.index[order[i] * 3 + k];
    }
    return out;
}

TEST(Transparency, TheOrderOfTrianglesInTheFileChangesNoBit) {
    Random random(1);
    for (Shot s : all_shots()) {
        for (const int samples : {1, 4, 8}) {
            s.options.samples = samples;
            const image::Image first = drawn(s);
            for (int round = 0; round < 3; ++round)
                EXPECT_EQ(drawn(shuffled(s, random)), first) << s.name << ' ' << samples;
        }
    }
}

TEST(Transparency, TheLengthOfListsTilesAndThreadsChangeNoBit) {
    for (Shot s : all_shots()) {
        for (const int samples : {1, 4}) {
            s.options.samples = samples;
            s.options.max_fragments = 1 << 20;
            const image::Image first = drawn(s);
            for (const int most : {1, 7, 500}) {
                s.options.max_fragments = most;
                EXPECT_EQ(drawn(s), first) << s.name << ' ' << most;
            }
            for (const int tile_size : {8, 32})
                EXPECT_EQ(drawn(s, 3, tile_size), first) << s.name << ' ' << tile_size;
        }
    }
}

TEST(Transparency, AMaterialWithAlphaOneLooksTheSameOnEveryWay) {
    std::vector<Shot> shots = golden_shots();
    shots.push_back(soup("soup", 800, 0.8, 3));
    shots.push_back(soup("around the eye", 300, 6, 4));
    for (Shot s : shots) {
        if (frame::facts(s.scene).alpha.see_through_triangles() > 0) continue;
        if (s.options.aa != "auto") continue;
        if (s.options.depth_test != "auto") continue; // it is for what is not blended
        for (const int samples : {1, 4, 16}) {
            s.options.samples = samples;
            for (const image::Rgba8 background :
                 {image::Rgba8{48, 51, 56, 255}, {0, 0, 0, 0}, {9, 200, 100, 77}}) {
                s.options.background = background;
                s.options.effects.clear();
                s.options.transparency = "auto";
                const image::Image opaque = drawn(s);
                s.options.effects["cut_out"] = true;
                EXPECT_EQ(drawn(s), opaque) << s.name << " cut out, " << samples;
                s.options.effects.clear();
                s.options.effects["blending"] = true;
                for (const char* technique : {"exact", "sorted"}) {
                    s.options.transparency = technique;
                    if (std::string(technique) == "sorted" && s.name != "samples_8") continue;
                    EXPECT_EQ(drawn(s), opaque) << s.name << ' ' << technique << ' ' << samples;
                }
            }
        }
    }
}

TEST(Transparency, ForcingBlendingBesideWhatIsCutOutChangesNoBit) {
    Shot s = panes("leaves", "auto");
    s.scene.mesh.material.assign(s.scene.mesh.triangles(), 0);
    for (std::size_t i = 0; i < 6; ++i)
        s.scene.mesh.material[s.scene.mesh.triangles() - 1 - i] = i < 3 ? 4 : 0;
    const frame::SceneFacts facts = frame::facts(s.scene);
    ASSERT_EQ(facts.alpha.blended_triangles, 0U);
    ASSERT_EQ(facts.alpha.cut_out_triangles, 3U);
    for (const int samples : {1, 8}) {
        s.options.samples = samples;
        s.options.effects.clear();
        const image::Image automatic = drawn(s);
        s.options.effects["blending"] = true;
        EXPECT_EQ(drawn(s), automatic);
    }
}

TEST(Transparency, AMaterialWithAlphaZeroDrawsNothing) {
    for (const char* technique : {"auto", "cut_out", "sorted", "exact"}) {
        for (const int samples : {1, 4}) {
            Shot with = panes("with", technique);
            with.options.samples = samples;
            with.options.background = {10, 20, 30, 0};
            geom::Mesh& mesh = with.scene.mesh;
            Shot without = with;
            with.scene.materials.push_back(glass(Vec3(1), 0));
            with.scene.materials.back().specular = Vec3(1);
            with.scene.materials.back().shininess = 1;
            add_square(mesh, 0.9F, 0.8F, 6);
            EXPECT_EQ(drawn(with), drawn(without)) << technique;
            // Nor does an alpha map of zeros, on the way of those that blend.
            with.scene.materials.back() = textured(2);
            with.scene.textures.push_back({"nothing", image::Image(2, 2, {255, 255, 255, 0})});
            EXPECT_EQ(drawn(with), drawn(without)) << technique;
        }
    }
}

TEST(Transparency, LayersThatAreCoplanarAreOrderedByTheirId) {
    for (const bool red_first : {true, false}) {
        Shot s = shot("coplanar");
        const scene::Material red = glass({1, 0, 0}, 0.5F), blue = glass({0, 0, 1}, 0.5F);
        s.scene.materials = {red_first ? red : blue, red_first ? blue : red};
        add_square(s.scene.mesh, 0.9F, 0, 0);
        // The same square; other triangles would have depths that differ in the last bit.
        add_square(s.scene.mesh, 0.9F, 0, 1);
        s.scene.mesh.uv.clear();
        s.options.background = {0, 0, 0, 255};
        const image::Rgba8 middle = drawn(s).at(40, 20);
        const int front = red_first ? middle.r : middle.b, back = red_first ? middle.b : middle.r;
        EXPECT_GT(front, back + 30);
        EXPECT_GT(back, 20);
    }
}

// Panes one behind the other, in any order: no two cross.
TEST(Transparency, SortedIsExactWhereNoTrianglesCross) {
    Random random(5);
    Shot s = shot("stack");
    for (int i = 0; i < 12; ++i) {
        s.scene.materials.push_back(
            glass(Vec3(random.unit(), random.unit(), random.unit()), 0.1F + 0.06F * (i % 5)));
        add_square(s.scene.mesh, 0.9F, -0.6F + 0.1F * static_cast<float>(i), i);
    }
    for (const int samples : {1, 4}) {
        s.options.samples = samples;
        const Shot mixed = shuffled(s, random);
        s.options.transparency = "sorted";
        const image::Image sorted = drawn(s);
        s.options.transparency = "exact";
        EXPECT_EQ(drawn(s), sorted);
        s = mixed;
    }
    EXPECT_GT(image::compare(drawn(panes("sorted", "sorted")), drawn(panes("exact", "exact")), 2)
                  .over_tolerance,
              40);
}

void add_rectangle(geom::Mesh& mesh, float x0, float y0, float x1, float y1, float z0, float z1,
                   int material) {
    add_quad(mesh, {{{x0, y0, z0}, {x1, y0, z1}, {x1, y1, z1}, {x0, y1, z0}}}, {0, 0, 1}, material);
}

// A square of 8 x 8 texels, 6 pixels each; and the same with one square for every texel that is
// opaque. Something stands behind, and something crosses. Samples lie on no texel's edge.
TEST(Transparency, CutOutSamplesAreThoseOfTheOpaqueTexelsAlone) {
    for (const int samples : {1, 2, 4, 8}) {
        Shot cut = shot("cut"), whole = shot("whole");
        cut.scene.textures = {leaf(false)};
        for (image::Rgba8& texel : cut.scene.textures[0].image.pixels())
            texel = {99, 150, 200, texel.a};
        const image::Image texels = cut.scene.textures[0].image;
        whole.scene.textures = {{"plain", image::Image(1, 1, {99, 150, 200, 255})}};
        add_rectangle(cut.scene.mesh, 8, 8, 56, 56, 0, 0, 0);
        for (int y = 0; y < 8; ++y) {
            for (int x = 0; x < 8; ++x) {
                const auto left = static_cast<float>(8 + 6 * x),
                           top = static_cast<float>(56 - 6 * y);
                if (texels.at(x, y).a == 255)
                    add_rectangle(whole.scene.mesh, left, top - 6, left + 6, top, 0, 0, 0);
            }
        }
        for (Shot* s : {&cut, &whole}) {
            s->options.samples = samples;
            s->options.texture = "nearest";
            s->scene.materials = {textured(0), plain({0.2F, 0.9F, 0.4F})};
            add_rectangle(s->scene.mesh, 3, 5, 60, 50, -0.3F, 0.2F, 1);
        }
        EXPECT_EQ(image::compare(draw_in_pixels(cut), draw_in_pixels(whole)).differing_pixels, 0)
            << samples;
        cut.options.effects["cut_out"] = false;
        EXPECT_GT(image::compare(draw_in_pixels(cut), draw_in_pixels(whole), 8).over_tolerance, 50);
    }
}

// Threads and holes far finer than a pixel: pixels show the one or the other, in the shares that
// the texture has, and the surface does not vanish, as means below the threshold would have it.
TEST(Transparency, CutOutKeepsItsShareWhereItIsMinified) {
    constexpr int kOpaque = 112; // of 256 texels, 44 %
    image::Image fence(16, 16, {99, 150, 200, 0});
    for (std::size_t i = 0; i < 256; ++i)
        if (i % 4 == 0 || i / 16 % 4 == 0) fence.pixels()[i].a = 255;
    for (const float turns : {0.5F, 5.9F, 21.9F, 43.7F}) { // 0.17 to 15 texels a pixel
        Shot s = shot("fence");
        s.scene.textures = {{"fence", fence}};
        s.scene.materials = {textured(0)};
        const image::Image empty = draw_in_pixels(s);
        add_rectangle(s.scene.mesh, 8, 8, 56, 56, 0, 0, 0);
        for (Vec2& uv : s.scene.mesh.uv)
            uv = uv * turns;
        const auto shown = image::compare(draw_in_pixels(s), empty).differing_pixels;
        EXPECT_NEAR(static_cast<double>(shown) / (48 * 48), kOpaque / 256.0, 0.06) << turns;
    }
}

TEST(Transparency, WhatIsNotCalledForHoldsNoMemory) {
    frame::FrameStats stats;
    draw(solids("opaque"), {.stats = &stats});
    EXPECT_EQ(stats.transparency_bytes, 0U);
    EXPECT_EQ(stats.fragments_blended, 0U);
    draw(panes("panes", "auto"), {.stats = &stats});
    EXPECT_GT(stats.transparency_bytes, 0U);
    EXPECT_GT(stats.fragments_blended, 1000U);
}

TEST(Transparency, LeavingItOutChangesThePicture) {
    const Shot s = panes("panes", "auto");
    const image::Image all = drawn(s);
    for (const char* effect : {"cut_out", "blending"}) {
        Shot less = s;
        less.options.effects[effect] = false;
        EXPECT_GT(image::compare(drawn(less), all, 2).over_tolerance, 40) << effect;
    }
}

} // namespace
} // namespace scanout::test
