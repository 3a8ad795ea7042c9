// Anti-aliasing against exact areas: each rung's declared error, what areas and filters promise.
#include "frame/anti_aliasing.h"
#include "image/compare.h"
#include "math/srgb.h"
#include "oracle/coverage.h"
#include "rows.h"
#include "support/scenes.h"

#include <cmath>
#include <map>

namespace scanout::test {
namespace {

constexpr int kFrameSide = 64;

// Triangles in pixels, x right and y down, seen square: the nearest has the greatest z.
struct Flat {
    Shot shot = scanout::test::shot("flat", kFrameSide, kFrameSide);

    explicit Flat(const std::string& aa) {
        shot.options.aa = aa;
        shot.options.tone = "clamp";
        shot.options.background = {0, 0, 0, 255};
    }
    // Plainly in the colour: the material undoes the ambient light, the normal leaves out the rest.
    void add(const std::array<DVec3, 3>& corner, const Vec3& colour = Vec3(1)) {
        const Vec3 unlit{3.0F / 7, 6.0F / 7, -2.0F / 7};
        shot.scene.materials.push_back(plain(colour / scene::kAmbient));
        std::uint32_t index[3];
        for (std::size_t k = 0; k < 3; ++k)
            index[k] =
                add_vertex(shot.scene.mesh,
                           Vec3(DVec3(corner[k].x, kFrameSide - corner[k].y, corner[k].z)), unlit);
        add_triangle(shot.scene.mesh, index[0], index[1], index[2],
                     static_cast<int>(shot.scene.materials.size() - 1));
    }
    image::Image draw(shade::LinearPicture* linear = nullptr, int scale = 1) const {
        scene::View view;
        view.projection = scene::Projection::orthographic;
        view.half_width = view.half_height = kFrameSide / 2.0;
        view.translation = {-kFrameSide / 2.0, -kFrameSide / 2.0, 0};
        frame::FrameOptions options = shot.options;
        options.width = options.height = kFrameSide * scale;
        const auto plan = frame::plan(options, frame::facts(shot.scene));
        EXPECT_TRUE(plan) << plan.error().what;
        Jobs jobs(1);
        frame::Renderer renderer(jobs);
        return renderer.render(shot.scene, view, *plan, nullptr, 64, linear);
    }
    // The share of every pixel that shows something.
    std::vector<double> shares() const {
        shade::LinearPicture linear;
        draw(&linear);
        const int scale = linear.width / kFrameSide;
        std::vector<double> share(static_cast<std::size_t>(kFrameSide) * kFrameSide);
        for (int y = 0; y < linear.height; ++y)
            for (int x = 0; x < linear.width; ++x)
                share[static_cast<std::size_t>(y / scale * kFrameSide + x / scale)] +=
                    double{linear.at(x, y)[3]} / (scale * scale);
        return share;
    }
};

double on_grid(double pixels) { // 1/256 pixel, so that the raster sees what the oracle sees
    return std::nearbyint(pixels * 256) / 256;
}

// Everything on one side of a line.
struct HalfPlane {
    std::array<DVec3, 3> corner;
    explicit HalfPlane(Random& random) {
        const double angle = random.in(0, 2 * std::numbers::pi);
        const DVec2 n(std::cos(angle), std::sin(angle)), along(-n.y, n.x);
        const DVec2 on = DVec2(kFrameSide / 2.0) + n * random.in(-25, 25);
        const auto place = [](const DVec2& p) { return DVec3(on_grid(p.x), on_grid(p.y), 0.5); };
        corner = {place(on + along * 110.0), place(on - along * 110.0), place(on + n * 110.0)};
    }
    // Of the pixel's box, by clipping it along the line.
    double area(int x, int y) const {
        const DVec2 p(corner[0].x, corner[0].y), q(corner[1].x, corner[1].y);
        const DVec2 d = q - p, r(corner[2].x - p.x, corner[2].y - p.y);
        const double sign = d.x * r.y - d.y * r.x > 0 ? 1 : -1;
        const auto side = [&](const DVec2& v) {
            return sign * (d.x * (v.y - p.y) - d.y * (v.x - p.x));
        };
        const DVec2 box[4] = {{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}};
        std::vector<DVec2> kept;
        for (int i = 0; i < 4; ++i) {
            const DVec2 &a = box[i], &b = box[(i + 1) % 4];
            const double at = side(a), then = side(b);
            if (at >= 0) kept.push_back(a);
            if ((at > 0) != (then > 0)) kept.push_back(a + (b - a) * (at / (at - then)));
        }
        double twice = 0;
        for (std::size_t i = 0; i < kept.size(); ++i) {
            const DVec2 &a = kept[i], &b = kept[(i + 1) % kept.size()];
            twice += a.x * b.y - a.y * b.x;
        }
        return std::abs(twice) / 2;
    }
};

TEST(AntiAliasing, HasTheDeclaredErrorOfCoverageAtRandomEdges) {
    // HARD-CASES L1, where it has the pattern: RMSE and greatest error over pixels on an edge.
    struct Rung {
        double rmse, most;
    };
    const std::map<std::string, Rung> ladder = {{"none", {0.2486, 0.5}},
                                                {"samples_2", {0.1590, 0.496}},
                                                {"samples_4", {0.0910, 0.308}},
                                                {"samples_8", {0.0569, 0.226}},
                                                {"samples_16", {0.0437, 0.171}},
                                                {"supersampling_2", {0.0863, 0.25}},
                                                {"supersampling_4", {0.0304, 0.125}},
                                                {"area", {0, 0}}};
    for (const auto& [name, rung] : ladder) {
        Random random(7);
        double squares = 0, most = 0;
        int edges = 0;
        for (int round = 0; round < 120; ++round) {
            const HalfPlane half(random);
            Flat flat(name);
            flat.add(half.corner);
            const std::vector<double> got = flat.shares();
            for (int y = 0; y < kFrameSide; ++y)
                for (int x = 0; x < kFrameSide; ++x) {
                    const double exact = half.area(x, y);
                    const double error =
                        std::abs(got[static_cast<std::size_t>(y * kFrameSide + x)] - exact);
                    most = std::max(most, error);
                    if (exact <= 0 || exact >= 1) {
                        ASSERT_LE(error, 1e-6) << name; // off the edge all are exact
                        continue;
                    }
                    squares += error * error;
                    ++edges;
                }
        }
        const double rmse = std::sqrt(squares / edges);
        RecordProperty(name + "_rmse", testing::PrintToString(rmse));
        RecordProperty(name + "_most", testing::PrintToString(most));
        EXPECT_GT(edges, 5000);
        EXPECT_LE(rmse, rung.rmse * 1.05 + 1e-6) << name;
        EXPECT_GE(rmse, rung.rmse * 0.9) << name; // it is this rung, and no better one
        EXPECT_LE(most, rung.most * 1.05 + 1e-6) << name;
    }
}

TEST(AntiAliasing, ByAreasFindsWhatIsHiddenExactly) {
    Random random(3);
    for (int round = 0; round < 6; ++round) {
        Flat flat("area");
        std::vector<oracle::ExactTriangle> shape;
        for (int i = 0; i < 12; ++i) { // the last is nearest
            oracle::Corners v;
            std::array<DVec3, 3> corner;
            for (std::size_t k = 0; k < 3; ++k) {
                v[k] = {random.whole(-4000, 20000), random.whole(-4000, 20000)};
                corner[k] = {static_cast<double>(v[k].x) / 256, static_cast<double>(v[k].y) / 256,
                             0.2 + 0.02 * i};
            }
            // Red counts: the sum over what is seen tells them apart.
            flat.add(corner, Vec3(static_cast<float>(i + 1) / 16, 0, 0));
            shape.emplace_back(v);
        }
        shade::LinearPicture linear;
        flat.draw(&linear);
        double worst = 0;
        for (int y = 0; y < kFrameSide; ++y)
            for (int x = 0; x < kFrameSide; ++x) {
                double red = 0, share = 0;
                constexpr int kGrid = 32;
                for (int j = 0; j < kGrid; ++j)
                    for (int i = 0; i < kGrid; ++i) {
                        const int px = x * 256 + i * 8 + 4, py = y * 256 + j * 8 + 4;
                        for (int t = 11; t >= 0; --t) {
                            if (!shape[static_cast<std::size_t>(t)].covers(px, py)) continue;
                            red += (t + 1) / 16.0 / (kGrid * kGrid);
                            share += 1.0 / (kGrid * kGrid);
                            break;
                        }
                    }
                worst = std::max({worst, std::abs(double{linear.at(x, y)[0]} - red),
                                  std::abs(double{linear.at(x, y)[3]} - share)});
            }
        EXPECT_LT(worst, 0.02); // the grid's own error: 32 x 32 points, a few edges
    }
}

TEST(AntiAliasing, ByAreasLeavesNoSeamAndCutsPlanesWhereTheyCross) {
    Flat flat("area");
    // A fan of thin triangles round a point that is nowhere special covers the picture once.
    Random random(5);
    const DVec3 hub(on_grid(31.3), on_grid(29.7), 0.5);
    std::vector<DVec3> rim;
    for (int i = 0; i < 97; ++i) {
        const double angle = 2 * std::numbers::pi * i / 97;
        rim.emplace_back(on_grid(31 + 100 * std::cos(angle)), on_grid(30 + 100 * std::sin(angle)),
                         0.5);
    }
    for (std::size_t i = 0; i < rim.size(); ++i)
        flat.add({hub, rim[i], rim[(i + 1) % rim.size()]}, Vec3(0.5F));
    for (const double share : flat.shares())
        ASSERT_NEAR(share, 1, 1e-6);
    const image::Image picture = flat.draw();
    for (const image::Rgba8& p : picture.pixels())
        ASSERT_TRUE((p == image::Rgba8{188, 188, 188, 255}));
    // One plane rises to the right, one to the left: they meet at x = 20.3.
    Flat crossing("area");
    const auto slope = [&](double sign, const Vec3& colour) {
        const auto at = [&](double x, double y) {
            return DVec3(x, y, 0.5 + sign * (x - on_grid(20.3)) / 512);
        };
        crossing.add({at(-100, -100), at(200, -100), at(50, 300)}, colour);
    };
    slope(1, {1, 0, 0});
    slope(-1, {0, 1, 0});
    shade::LinearPicture linear;
    crossing.draw(&linear);
    for (int y = 0; y < kFrameSide; ++y)
        for (int x = 0; x < kFrameSide; ++x) {
            const double right = std::clamp(x + 1 - on_grid(20.3), 0.0, 1.0);
            ASSERT_NEAR(linear.at(x, y)[0], right, 1e-4) << x << ',' << y;
            ASSERT_NEAR(linear.at(x, y)[1], 1 - right, 1e-4) << x << ',' << y;
        }
}

TEST(AntiAliasing, BySupersamplingIsTheMeanOfALargerPicture) {
    for (const int n : {2, 4}) {
        Random random(4);
        Flat small("supersampling_" + std::to_string(n));
        for (int i = 0; i < 30; ++i) {
            std::array<DVec3, 3> corner;
            for (DVec3& c : corner)
                c = {random.in(-10, 70), random.in(-10, 70), 0.2 + 0.02 * i};
            small.add(corner, Vec3(random.in_cube(0.5) + DVec3(0.5)));
        }
        Flat large = small;
        large.shot.options.aa = "none";
        shade::LinearPicture linear;
        large.draw(&linear, n);
        const image::Image got = small.draw();
        for (int y = 0; y < kFrameSide; ++y)
            for (int x = 0; x < kFrameSide; ++x) {
                double sum[3] = {};
                for (int j = 0; j < n; ++j)
                    for (int i = 0; i < n; ++i)
                        for (std::size_t c = 0; c < 3; ++c)
                            sum[c] += double{linear.at(x * n + i, y * n + j)[c]} / (n * n);
                const image::Rgba8 p = got.at(x, y);
                const int code[3] = {p.r, p.g, p.b};
                for (int c = 0; c < 3; ++c)
                    ASSERT_LE(std::abs(code[c] - srgb_encode(static_cast<float>(sum[c]))),
                              sum[c] > 1e-3 ? 1 : 0); // sums of floats and doubles
            }
    }
}

TEST(AntiAliasing, OfOneColourIsThatColour) {
    for (const frame::AntiAliasing* aa : frame::aa::kRows) {
        Flat flat{std::string(aa->card.name)};
        flat.add({DVec3(-100, -100, 0.5), DVec3(300, -100, 0.5), DVec3(-100, 300, 0.5)},
                 {0.25F, 0.5F, 0.75F});
        const image::Image picture = flat.draw();
        const image::Rgba8 expected{srgb_encode(0.25F), srgb_encode(0.5F), srgb_encode(0.75F), 255};
        for (const image::Rgba8& p : picture.pixels())
            ASSERT_TRUE(p == expected) << aa->card.name;
        // And of nothing, the background.
        Flat nothing{std::string(aa->card.name)};
        nothing.shot.options.background = {12, 200, 77, 128};
        EXPECT_EQ(nothing.draw(), image::Image(kFrameSide, kFrameSide, {12, 200, 77, 128}));
    }
}

TEST(AntiAliasing, OfGlassIsWhatOneSampleShows) {
    image::Image first;
    for (const frame::AntiAliasing* aa : frame::aa::kRows) {
        Flat flat{std::string(aa->card.name)};
        flat.shot.options.background = {200, 30, 90, 255};
        flat.add({DVec3(-100, -100, 0.4), DVec3(300, -100, 0.4), DVec3(-100, 300, 0.4)},
                 {0.25F, 0.5F, 0.75F});
        flat.add({DVec3(-100, -100, 0.5), DVec3(300, -100, 0.5), DVec3(-100, 300, 0.5)},
                 {1, 0.1F, 0});
        flat.shot.scene.materials[1].opacity = 0.25F;
        const image::Image picture = flat.draw();
        if (first.empty()) first = picture;
        EXPECT_EQ(image::compare(picture, first, 1).over_tolerance, 0) << aa->card.name;
    }
    EXPECT_TRUE((first.at(30, 30) ==
                 image::Rgba8{srgb_encode(0.4375F), srgb_encode(0.4F), srgb_encode(0.5625F), 255}));
    // Areas cannot blend: the plan says so and takes samples.
    Flat flat("area");
    flat.add({DVec3(0, 0, 0.5), DVec3(9, 0, 0.5), DVec3(0, 9, 0.5)});
    flat.shot.scene.materials[0].opacity = 0.5F;
    const auto plan = frame::plan(flat.shot.options, frame::facts(flat.shot.scene));
    ASSERT_TRUE(plan);
    EXPECT_EQ(plan->aa->card.name, "samples_16");
    EXPECT_NE(plan->decision("aa")->because.find("transparency"), std::string::npos);
}

// How much the light of a small square changes on its way across a pixel, to its mean.
double flicker(const std::string& aa) {
    double low = 1e9, high = 0, sum = 0;
    constexpr int kSteps = 16;
    for (int step = 0; step < kSteps; ++step) {
        const double x = 30 + step / 16.0, y = 30 + step / 32.0;
        Flat flat(aa);
        const auto at = [&](double dx, double dy) { return DVec3(x + dx, y + dy, 0.5); };
        flat.add({at(0, 0), at(0.75, 0), at(0, 0.75)});
        flat.add({at(0.75, 0), at(0.75, 0.75), at(0, 0.75)});
        const image::Image picture = flat.draw();
        double light = 0;
        for (const image::Rgba8& p : picture.pixels())
            light += double{srgb_decode(p.r)};
        low = std::min(low, light);
        high = std::max(high, light);
        sum += light / kSteps;
    }
    return (high - low) / sum;
}

TEST(AntiAliasing, ASmallThingThatMovesFlickersLessTheBetterItIsFiltered) {
    EXPECT_GT(flicker("none"), 0.9);
    EXPECT_LT(flicker("samples_4"), 0.8);
    EXPECT_LT(flicker("tent"), 0.25);
    EXPECT_LT(flicker("gaussian"), 0.25);
    EXPECT_LT(flicker("area"), 0.02); // its area never changes
}

TEST(AntiAliasing, WeightsReachFurtherTheWiderTheFilter) {
    // One bright pixel: how many pixels show some of it.
    std::map<std::string, int> lit;
    for (const char* aa : {"samples_16", "area", "tent", "gaussian"}) {
        Flat flat(aa);
        const auto at = [](double x, double y) { return DVec3(x, y, 0.5); };
        flat.add({at(30, 30), at(31, 30), at(30, 31)});
        flat.add({at(31, 30), at(31, 31), at(30, 31)});
        const image::Image picture = flat.draw();
        for (const image::Rgba8& p : picture.pixels())
            lit[aa] += p.r > 0 ? 1 : 0;
    }
    EXPECT_EQ(lit["samples_16"], 1);
    EXPECT_EQ(lit["area"], 1);
    EXPECT_EQ(lit["tent"], 9);
    EXPECT_EQ(lit["gaussian"], 9);
}

TEST(AntiAliasing, ShadesEachPrimitiveOncePerPixelThatShowsIt) {
    const auto lanes = [](const std::string& aa) {
        Shot s = star("star");
        s.options.aa = aa;
        frame::FrameStats stats;
        draw(s, {.stats = &stats});
        return stats.items_shaded;
    };
    const std::uint64_t by_samples = lanes("samples_16");
    EXPECT_EQ(lanes("tent"), by_samples); // nothing is shaded again for a neighbour
    EXPECT_EQ(lanes("gaussian"), by_samples);
    EXPECT_GE(lanes("area"), by_samples); // also what no sample sees
    EXPECT_LT(lanes("area"), by_samples * 3 / 2);
    // Of supersampling every pixel of the larger picture is.
    EXPECT_NEAR(static_cast<double>(lanes("supersampling_2")),
                4 * static_cast<double>(lanes("none")), 0.1 * static_cast<double>(lanes("none")));
    EXPECT_NEAR(static_cast<double>(lanes("supersampling_4")),
                16 * static_cast<double>(lanes("none")), 0.4 * static_cast<double>(lanes("none")));
}

TEST(AntiAliasing, IsChosenByNameOrByNumberNotByBoth) {
    const frame::SceneFacts facts;
    frame::FrameOptions options;
    options.samples = 8;
    EXPECT_EQ(frame::plan(options, facts)->aa->card.name, "samples_8");
    options.aa = "samples_4";
    const auto both = frame::plan(options, facts);
    ASSERT_FALSE(both);
    EXPECT_EQ(both.error().exit, Exit::usage);
    options.samples = 1;
    EXPECT_EQ(frame::plan(options, facts)->aa->samples, 4);
    options.aa = "supersampling_4";
    options.width = frame::kMaxSide / 4 + 1;
    EXPECT_FALSE(frame::plan(options, facts));
    options.width = frame::kMaxSide / 4;
    EXPECT_TRUE(frame::plan(options, facts));
}

} // namespace
} // namespace scanout::test
