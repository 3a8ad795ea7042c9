// The laws of the stencil buffer: counts against exact coverage, outlines against what the frame's
// light says of its pixels, whatever the tiles, the threads and the order of the file.
#include "frame/plan/bytes.h"
#include "frame/stencil.h"
#include "oracle/coverage.h"
#include "raster/screen/primitive.h"
#include "rows.h"
#include "support/scenes.h"

#include <algorithm>
#include <map>

#include <gmock/gmock.h>

namespace scanout::test {
namespace {

constexpr int kStencilSide = 64;
constexpr image::Rgba8 kOrange{255, 140, 0, 255};

Shot with(Shot s, const std::string& stencil) {
    s.options.stencil = stencil;
    return s;
}

// What each count looks like, and back.
std::vector<image::Rgba8> colours_of_counts() {
    frame::StencilBuffer marks(256, 1);
    for (int count = 0; count < 256; ++count)
        marks.row(0)[static_cast<std::size_t>(count)] = static_cast<std::uint8_t>(count);
    image::Image row(256, 1);
    find_row(frame::stencil::kRows, "overdraw")->show(marks, 0, row);
    return {row.pixels().begin(), row.pixels().end()};
}

// By pixel, row by row; -1: a colour that no count has.
std::vector<int> counts_in(const image::Image& picture, const image::Rgba8& background) {
    static const std::vector<image::Rgba8> kColours = colours_of_counts();
    std::vector<int> counts;
    for (const image::Rgba8& pixel : picture.pixels()) {
        const auto found = std::find(kColours.begin() + 1, kColours.end(), pixel);
        const int count = static_cast<int>(found - kColours.begin());
        counts.push_back(pixel == background ? 0 : (count < 256 ? count : -1));
    }
    return counts;
}
std::vector<int> counts_in(const Shot& s, const DrawOptions& how = {}) {
    return counts_in(draw(with(s, "overdraw"), how), s.options.background);
}

Shot in_pixels() {
    Shot s = with(shot("pixels", kStencilSide, kStencilSide), "overdraw");
    s.scene.materials = {plain({0.5F, 0.5F, 0.5F})};
    return s;
}
std::vector<int> counts_in_pixels(const Shot& s, const DrawOptions& how = {}) {
    return counts_in(draw_in_pixels(s, how), s.options.background);
}
// Mesh x, y are pixels, y up from the lower left corner; z greater is nearer.
void add_rectangle(Shot& s, float x0, float y0, float x1, float y1, float z) {
    add_quad(s.scene.mesh, {{{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}}, {0, 0, 1}, 0);
}

void reverse_triangles(geom::Mesh& mesh) {
    std::reverse(mesh.material.begin(), mesh.material.end());
    for (std::size_t i = 0, j = mesh.triangles() - 1; i < j; ++i, --j)
        std::swap_ranges(mesh.index.begin() + static_cast<std::ptrdiff_t>(i * 3),
                         mesh.index.begin() + static_cast<std::ptrdiff_t>(i * 3 + 3),
                         mesh.index.begin() + static_cast<std::ptrdiff_t>(j * 3));
}

TEST(Overdraw, IsTheNumberOfTrianglesThatCoverThePixelsCentreExactly) {
    Random random(1);
    for (const int reach : {80 * 256, 700 * 256, 60000 * 256}) { // the last: cut into pieces
        for (int round = 0; round < 4; ++round) {
            Shot s = in_pixels();
            s.options.samples = round == 3 ? 4 : 1;
            std::vector<int> expected(kStencilSide * kStencilSide, 0);
            for (int i = 0; i < 120; ++i) {
                oracle::Corners corners;
                std::uint32_t index[3];
                for (std::size_t k = 0; k < 3; ++k) {
                    const auto at = [&] {
                        return random.whole(-reach, reach + kStencilSide * 256);
                    };
                    corners[k] = {at(), at()};
                    index[k] = add_vertex(s.scene.mesh,
                                          {static_cast<float>(corners[k].x) / 256,
                                           kStencilSide - static_cast<float>(corners[k].y) / 256,
                                           static_cast<float>(random.in(0.1, 0.9))});
                }
                add_triangle(s.scene.mesh, index[0], index[1], index[2], 0);
                const oracle::ExactTriangle triangle(corners);
                for (int pixel = 0; pixel < kStencilSide * kStencilSide; ++pixel)
                    expected[static_cast<std::size_t>(pixel)] += triangle.covers(
                        pixel % kStencilSide * 256 + 128, pixel / kStencilSide * 256 + 128);
            }
            const std::vector<int> counts = counts_in_pixels(s);
            EXPECT_EQ(counts, expected) << reach << ' ' << round;
            EXPECT_GT(*std::max_element(counts.begin(), counts.end()), 10);
        }
    }
}

// The near plane cuts some into two pieces, and these count as one.
TEST(Overdraw, IsTheSumOfTrianglesDrawnAlone) {
    Shot s = soup("around the eye", 80, 6, 2);
    const std::vector<int> counts = counts_in(s);
    std::vector<int> expected(counts.size(), 0);
    const geom::Mesh all = s.scene.mesh;
    for (std::size_t i = 0; i < all.triangles(); ++i) {
        for (std::size_t k = 0; k < 3; ++k)
            s.scene.mesh.index[k] = all.index[i * 3 + k];
        s.scene.mesh.index.resize(3);
        s.scene.mesh.material = {all.material[i]};
        s.scene.mesh.face.resize(1);
        frame::Visibility alone;
        draw(s, {.visibility = &alone});
        for (std::size_t pixel = 0; pixel < alone.id.size(); ++pixel)
            expected[pixel] += alone.id[pixel] != raster::kNoPrimitive;
    }
    EXPECT_EQ(counts, expected);
    EXPECT_GT(*std::max_element(counts.begin(), counts.end()), 2);
}

// The scale of the card; and beyond its end.
TEST(Overdraw, OfStackedSquaresHasTheColoursOfTheScale) {
    const std::pair<int, image::Rgba8> scale[] = {
        {1, {31, 47, 143, 255}},    {2, {32, 96, 255, 255}},   {4, {0, 200, 200, 255}},
        {8, {32, 208, 32, 255}},    {16, {255, 224, 0, 255}},  {32, {255, 128, 0, 255}},
        {64, {255, 0, 0, 255}},     {128, {255, 0, 255, 255}}, {255, {255, 255, 255, 255}},
        {300, {255, 255, 255, 255}}};
    for (const auto& [count, colour] : scale) {
        Shot s = in_pixels();
        for (int i = 0; i < count; ++i)
            add_rectangle(s, 10, 10, 50, 40, 0.5F + static_cast<float>(i % 7) / 64);
        const image::Image picture = draw_in_pixels(s, {.threads = 2});
        for (int y = 0; y < kStencilSide; ++y)
            for (int x = 0; x < kStencilSide; ++x) {
                const bool inside =
                    x >= 10 && x < 50 && y >= kStencilSide - 40 && y < kStencilSide - 10;
                ASSERT_EQ(picture.at(x, y), inside ? colour : s.options.background)
                    << count << " at " << x << ", " << y;
            }
    }
}

TEST(Overdraw, GivesEveryCountAColourOfItsOwn) {
    const std::vector<image::Rgba8> colours = colours_of_counts();
    for (std::size_t i = 1; i < colours.size(); ++i)
        EXPECT_EQ(std::count(colours.begin() + 1, colours.end(), colours[i]), 1) << i;
}

TEST(Overdraw, CountsEveryLineAndPointOnItsPixels) {
    Shot s = in_pixels();
    geom::Mesh& mesh = s.scene.mesh;
    add_rectangle(s, 0, 0, 30, 64, 0.9F); // in front: hidden lines count, too
    const auto vertex = [&](float x, float y) { return add_vertex(mesh, {x, y, 0.5F}); };
    add_line(mesh, vertex(3.5F, 33.5F), vertex(43.5F, 33.5F), 0);
    add_line(mesh, vertex(20.5F, 10.5F), vertex(20.5F, 60.5F), 0);
    add_line(mesh, vertex(20.5F, 60.5F), vertex(20.5F, 10.5F), 0);
    add_point(mesh, vertex(40.5F, 33.5F), 0);
    std::vector<int> expected(kStencilSide * kStencilSide, 0);
    for (int y = 0; y < kStencilSide; ++y)
        for (int x = 0; x < kStencilSide; ++x) {
            int& count = expected[static_cast<std::size_t>(y * kStencilSide + x)];
            const int up = kStencilSide - 1 - y;
            count = (x < 30) + (up == 33 && x >= 3 && x <= 43) +
                    2 * (x == 20 && up >= 10 && up <= 60) + (x == 40 && up == 33);
        }
    for (const int samples : {1, 8}) {
        s.options.samples = samples;
        for (const int tile_size : {8, 64})
            EXPECT_EQ(counts_in_pixels(s, {.tile_size = tile_size}), expected) << samples;
    }
}

TEST(Overdraw, OfFrontsAndOfBacksAddsUpToThatOfBoth) {
    for (Shot s :
         {solids("solids"), bowl("bowl", frame::Cull::none), soup("around the eye", 300, 6, 2)}) {
        std::map<frame::Cull, std::vector<int>> counts;
        for (const frame::Cull cull : {frame::Cull::none, frame::Cull::back, frame::Cull::front}) {
            s.options.cull = cull;
            counts[cull] = counts_in(s);
        }
        int most = 0;
        for (std::size_t i = 0; i < counts[frame::Cull::none].size(); ++i) {
            const int fronts = counts[frame::Cull::back][i], backs = counts[frame::Cull::front][i];
            ASSERT_EQ(counts[frame::Cull::none][i], fronts + backs) << s.name << ' ' << i;
            most = std::max(most, std::min(fronts, backs));
        }
        EXPECT_GE(most, 1) << s.name;
    }
}

TEST(Overdraw, DependsOnNoOrderNoTileNoThreadNoDepthAndNoMaterial) {
    for (Shot s : {soup("soup", 600, 0.8, 1), soup("around the eye", 200, 6, 2)}) {
        s.options.stencil = "overdraw";
        const image::Image first = draw(s);
        for (const int tile_size : {8, 16, 32})
            for (const int threads : {1, 3})
                EXPECT_EQ(draw(s, {.threads = threads, .tile_size = tile_size}), first) << s.name;
        reverse_triangles(s.scene.mesh);
        EXPECT_EQ(draw(s), first) << s.name;
        s.options.depth_test = "never";
        EXPECT_EQ(draw(s), first) << s.name;
        s.options.aa = "supersampling_2";
        EXPECT_EQ(draw(s), first) << s.name;
        for (scene::Material& material : s.scene.materials)
            material.opacity = 0.3F;
        EXPECT_EQ(draw(s), first) << s.name;
    }
}

TEST(Overdraw, ShadesNothingAndStillKnowsWhatIsSeen) {
    Shot s = shadowed("shadowed", "map");
    frame::Visibility usual, counted;
    draw(s, {.visibility = &usual});
    frame::FrameStats stats;
    s.options.stencil = "overdraw";
    s.options.convolution = "low_pass";
    draw(s, {.stats = &stats, .visibility = &counted});
    EXPECT_EQ(counted.id, usual.id);
    EXPECT_EQ(counted.depth, usual.depth);
    EXPECT_EQ(stats.items_shaded, 0U);
    EXPECT_EQ(stats.shadow_bytes, 0U);
    s.options.samples = 4;
    const auto plan = frame::plan(s.options, frame::facts(s.scene));
    ASSERT_TRUE(plan);
    EXPECT_EQ(plan->aa->samples, 1);
    ASSERT_EQ(plan->techniques.size(), 2U);
    EXPECT_EQ(plan->techniques[0]->name, "overdraw");
    EXPECT_EQ(plan->techniques[1]->name, "low_pass");
    for (const frame::Decision& d : plan->decisions)
        EXPECT_EQ(d.on(), d.effect == "stencil" || d.effect == "cull" ||
                              d.effect == "convolution" || d.effect == "render_scale")
            << d.effect;
}

// Every way on which something comes into a pixel.
std::vector<Shot> outlined_shots() {
    std::vector<Shot> shots = {solids("solids"),
                               bowl("bowl", frame::Cull::back),
                               wires("wires"),
                               edges("edges"),
                               holed_cube("holed"),
                               panes("panes", "exact"),
                               panes("cut panes", "cut_out"),
                               star("star"),
                               shadowed("shadowed", "volume"),
                               soup("soup", 60, 0.8, 1)};
    shots.push_back(panes("leaf", "sorted"));
    geom::Mesh& mesh = shots.back().scene.mesh;
    mesh.index.resize(6); // of the soft leaf, which is clear at its rim, nothing else
    mesh.material = {5, 5};
    mesh.face.resize(2);
    shots.back().options.background = {0, 0, 0, 0};
    return shots;
}

// Does a pixel of the picture hold light of the model?
std::vector<bool> lit_pixels(const Shot& s) {
    shade::LinearPicture light;
    draw(s, {.linear = &light});
    const int scale = light.width / s.options.width;
    std::vector<bool> lit;
    for (int y = 0; y < s.options.height; ++y)
        for (int x = 0; x < s.options.width; ++x) {
            bool any = false;
            for (int i = 0; i < scale * scale; ++i)
                any = any || light.at(x * scale + i % scale, y * scale + i / scale)[3] > 0;
            lit.push_back(any);
        }
    return lit;
}

bool near_lit(const std::vector<bool>& lit, int width, int height, int x, int y) {
    for (int v = 0; v < height; ++v)
        for (int u = 0; u < width; ++u)
            if (lit[static_cast<std::size_t>(v * width + u)] &&
                (u - x) * (u - x) + (v - y) * (v - y) <= 4)
                return true;
    return false;
}

TEST(Outline, IsWhereNothingIsShownAndSomethingIsWithinTwoPixels) {
    for (Shot s : outlined_shots()) {
        s.options.width = s.options.height = 48;
        for (const char* aa : {"none", "samples_4", "samples_16", "area", "tent", "supersampling_2",
                               "supersampling_4"}) {
            s.options.aa = aa;
            const std::vector<bool> lit = lit_pixels(s);
            const image::Image plain = draw(s), outlined = draw(with(s, "outline"));
            int changed = 0;
            for (int y = 0; y < 48; ++y)
                for (int x = 0; x < 48; ++x) {
                    const bool line =
                        !lit[static_cast<std::size_t>(y * 48 + x)] && near_lit(lit, 48, 48, x, y);
                    changed += line;
                    ASSERT_EQ(outlined.at(x, y), line ? kOrange : plain.at(x, y))
                        << s.name << " with " << aa << " at " << x << ", " << y;
                }
            EXPECT_GT(changed, 30) << s.name << " with " << aa;
        }
    }
}

TEST(Outline, DependsOnNoTileAndNoThread) {
    for (Shot s : outlined_shots()) {
        s.options.width = 131;
        s.options.height = 67;
        s.options.stencil = "outline";
        for (const char* aa : {"none", "samples_4", "supersampling_4", "tent"}) {
            s.options.aa = aa;
            const image::Image first = draw(s);
            for (const int tile_size : {8, 32})
                EXPECT_EQ(draw(s, {.threads = 3, .tile_size = tile_size}), first)
                    << s.name << ' ' << aa;
        }
    }
}

TEST(Outline, OfNothingIsNothing) {
    Shot s = with(solids("solids"), "outline");
    s.options.depth_test = "never";
    const image::Image picture = draw(s);
    for (const image::Rgba8& pixel : picture.pixels())
        ASSERT_EQ(pixel, s.options.background);
}

// Straight to the side: two pixels, at the picture's edge none.
TEST(Outline, OfASquareIsTwoPixelsWide) {
    Shot s = with(in_pixels(), "outline");
    add_rectangle(s, 20, 0, 40, 30, 0.5F);
    const image::Image picture = draw_in_pixels(s);
    const auto orange = [&](int x, int y) { return picture.at(x, y) == kOrange; };
    for (int y = kStencilSide - 30; y < kStencilSide; ++y)
        for (int x = 0; x < kStencilSide; ++x)
            ASSERT_EQ(orange(x, y), x == 18 || x == 19 || x == 40 || x == 41) << x << ", " << y;
    EXPECT_TRUE(orange(30, kStencilSide - 32) && !orange(30, kStencilSide - 33));
    EXPECT_TRUE(orange(19, kStencilSide - 31) &&
                !orange(18, kStencilSide - 32)); // corners are round
}

TEST(Stencil, HoldsAByteAPixelOnlyWhileItIsAskedFor) {
    Jobs jobs(2);
    frame::Renderer renderer(jobs);
    const Shot shots[] = {solids("solids"), bowl("bowl", frame::Cull::none)};
    for (const char* name : {"auto", "outline", "none", "overdraw", "outline", "auto"}) {
        for (const Shot& s : shots) { // what another frame marked is forgotten
            const Shot asked = with(s, name);
            const auto view = scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {},
                                               kStencilSide, kStencilSide);
            ASSERT_TRUE(view);
            const auto plan = frame::plan(asked.options, frame::facts(s.scene), *view);
            ASSERT_TRUE(plan);
            const bool marks = name != std::string("auto") && name != std::string("none");
            EXPECT_EQ(plan->stencil != nullptr, marks);
            EXPECT_EQ(renderer.render(s.scene, *view, *plan), draw(asked)) << name;
            EXPECT_EQ(renderer.stats().stencil_bytes, marks ? 64U * 64 : 0U) << name;
            EXPECT_EQ(frame::bytes_by_effect(s.scene, *plan)["stencil"], marks ? 64U * 64 : 0U);
            const bool named = std::any_of(plan->techniques.begin(), plan->techniques.end(),
                                           [](const Technique* t) { return t->axis == "stencil"; });
            EXPECT_EQ(named, marks) << name;
        }
    }
    EXPECT_EQ(draw(with(shots[0], "none")), draw(shots[0]));
}

TEST(Stencil, SaysWhatItMarksInNumbers) {
    const Shot s = wires("wires");
    const auto because = [&](const std::string& name) {
        const auto plan = frame::plan(with(s, name).options, frame::facts(s.scene));
        return plan ? to_string(*plan->decision("stencil")) : plan.error().what;
    };
    EXPECT_EQ(because("auto"), "stencil none: an outline or counts come only on request");
    EXPECT_EQ(because("outline"),
              "stencil outline: 2 pixels around the visible part of 0 triangles, "
              "12 lines and 9 points (forced)");
    EXPECT_EQ(because("overdraw"), "stencil overdraw: counts the surfaces over each pixel of 0 "
                                   "triangles, 12 lines and 9 points (forced)");
    EXPECT_THAT(because("glow"), testing::HasSubstr("choose auto none outline overdraw"));
}

} // namespace
} // namespace scanout::test
