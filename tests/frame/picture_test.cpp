#include "image/compare.h"
#include "support/lights.h"
#include "support/scenes.h"
#include "support/srgb_formula.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace scanout::test {
namespace {

using image::Image;
using image::Rgba8;

std::int64_t covered(const Image& picture, const Rgba8& background) {
    return std::count_if(picture.pixels().begin(), picture.pixels().end(),
                         [&](const Rgba8& p) { return !(p == background); });
}

int nearest_code(double linear) {
    return static_cast<int>(std::lround(encoded(linear)));
}

// A square that fills the picture and more, facing the eye.
Shot full_screen(int samples, int material = 0) {
    Shot s = shot("full screen", 70, 50);
    s.scene.materials = {plain({0.5F, 0.25F, 0.75F}), textured(0)};
    s.scene.textures = {checkers()};
    add_square(s.scene.mesh, 3, 0, material);
    s.options.samples = samples;
    return s;
}

TEST(Picture, OfAnEmptyMeshIsTheBackground) {
    Shot s = shot("empty", 100, 70);
    s.options.background = {1, 2, 3, 4};
    for (const int samples : {1, 4}) {
        s.options.samples = samples;
        EXPECT_EQ(draw(s), Image(100, 70, {1, 2, 3, 4}));
    }
}

TEST(Picture, OfALitPlaneHasTheColourOfTheFormula) {
    const Image picture = draw(full_screen(1));
    double light = 0.15;
    for (const scene::ViewLight& l : key_and_fill())
        light += static_cast<double>(l.colour.x) * l.towards.z;
    for (const Rgba8& p : picture.pixels()) {
        ASSERT_EQ(p.r, nearest_code(0.5 * light));
        ASSERT_EQ(p.g, nearest_code(0.25 * light));
        ASSERT_EQ(p.b, nearest_code(0.75 * light));
        ASSERT_EQ(p.a, 255);
    }
}

TEST(Picture, OfAPlaneIsTheSameFromBothSides) {
    // Turned by half a turn about y, and wound or mirrored either way.
    const Image front = draw(full_screen(1));
    Shot back = full_screen(1);
    back.pose.yaw = scene::kFullTurn / 2;
    EXPECT_EQ(draw(back), front);
    Shot wound = full_screen(1);
    for (std::size_t i = 0; i < wound.scene.mesh.index.size(); i += 3)
        std::swap(wound.scene.mesh.index[i], wound.scene.mesh.index[i + 1]);
    EXPECT_EQ(draw(wound), front);
    Shot inward = full_screen(1);
    for (Vec3& n : inward.scene.mesh.normal)
        n = -n;
    EXPECT_EQ(draw(inward), front);
    Shot mirrored = full_screen(1);
    mirrored.model.scale = {-1, 1, 1};
    EXPECT_EQ(draw(mirrored), front);
}

TEST(Picture, OfAMirroredModelIsTheMirroredPicture) {
    // A model that is not symmetric, lit by one light on the axis: mirrored in x, the picture is
    // too.
    Shot s = soup("soup", 60, 0.7, 9);
    s.scene.mesh.normal.assign(s.scene.mesh.normal.size(), {0, 0, 1});
    s.options.reflection = "lambert";
    Shot mirrored = s;
    mirrored.model.scale = {-1, 1, 1};
    for (const frame::Cull cull : {frame::Cull::none, frame::Cull::back, frame::Cull::front}) {
        s.options.cull = mirrored.options.cull = cull;
        const Image a = draw(s), b = draw(mirrored);
        std::int64_t differ = 0;
        for (int y = 0; y < a.height(); ++y)
            for (int x = 0; x < a.width(); ++x)
                differ += a.at(x, y) == b.at(a.width() - 1 - x, y) ? 0 : 1;
        // Ties on pixel centres go to the other side, and colours round elsewhere.
        EXPECT_LE(differ, a.width() * a.height() / 100);
        EXPECT_GT(covered(a, s.options.background), 1000);
    }
}

TEST(Picture, HasTheSameBitsAtEveryThreadCountAndEveryTime) {
    for (const Shot& s :
         {soup("soup", 2000, 0.8, 1), soup("inside", 200, 5, 2), solids("solids")}) {
        const Image one = draw(s);
        EXPECT_GT(covered(one, s.options.background), 500);
        for (const int threads : {2, 3, 7, 16})
            for (int run = 0; run < 3; ++run)
                ASSERT_EQ(draw(s, {.threads = threads}), one) << s.name << ' ' << threads;
    }
}

TEST(Picture, DoesNotDependOnTheFrameBefore) {
    Jobs jobs(2);
    frame::Renderer renderer(jobs);
    const Shot shots[] = {solids("a"), soup("b", 300, 2, 3), wires("c"), near_clip("d"),
                          bowl("e", frame::Cull::back)};
    for (int round = 0; round < 2; ++round) {
        for (const Shot& s : shots) {
            const auto view = scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {},
                                               s.options.width, s.options.height);
            ASSERT_TRUE(view);
            const auto plan = frame::plan(s.options, frame::facts(s.scene), *view);
            ASSERT_TRUE(plan);
            ASSERT_EQ(renderer.render(s.scene, *view, *plan), draw(s)) << s.name;
        }
    }
}

// A scene without coincident faces, under many orders of the same data.
TEST(Picture, DoesNotDependOnTheOrderOfTheFile) {
    for (Shot s : {soup("soup", 400, 0.8, 4), soup("around the eye", 150, 5, 5)}) {
        s.options.samples = 4;
        s.options.cull = frame::Cull::back;
        const Image first = draw(s);
        Random random(6);
        for (int round = 0; round < 6; ++round) {
            Shot other = s;
            geom::Mesh &mesh = other.scene.mesh, &from = s.scene.mesh;
            // Triangles in another order, each begun at another vertex; vertices renumbered.
            std::vector<std::size_t> order(from.triangles());
            std::iota(order.begin(), order.end(), 0);
            std::vector<std::uint32_t> number(from.position.size());
            std::iota(number.begin(), number.end(), 0);
            const auto shuffle = [&](auto& list) {
                for (std::size_t i = list.size() - 1; i > 0; --i)
                    std::swap(list[i],
                              list[static_cast<std::size_t>(random.whole(0, static_cast<int>(i)))]);
            };
            shuffle(order);
            shuffle(number);
            for (std::size_t v = 0; v < number.size(); ++v) {
                mesh.position[number[v]] = from.position[v];
                mesh.normal[number[v]] = from.normal[v];
                mesh.colour[number[v]] = from.colour[v];
            }
            for (std::size_t t = 0; t < order.size(); ++t) {
                mesh.material[t] = from.material[order[t]];
                const auto begin = static_cast<std::size_t>(random.whole(0, 2));
                for (std::size_t k = 0; k < 3; ++k)
                    mesh.index[3 * t + k] = number[from.index[3 * order[t] + (begin + k) % 3]];
            }
            ASSERT_EQ(draw(other), first) << s.name;
        }
        // Without culling the winding may turn too.
        Shot any = s;
        any.options.cull = frame::Cull::none;
        const Image wound = draw(any);
        for (std::size_t t = 0; t < any.scene.mesh.index.size(); t += 6)
            std::swap(any.scene.mesh.index[t], any.scene.mesh.index[t + 2]);
        ASSERT_EQ(draw(any), wound) << s.name;
    }
}

TEST(Picture, OfALineDoesNotDependOnItsDirection) {
    Shot s = wires("wires");
    s.camera.eye = DVec3(0.2, 0.3, 0.4); // in the cube: some edges pass behind the eye
    s.camera.target = DVec3(0);
    s.camera.fov_degrees = 100;
    const Image first = draw(s);
    EXPECT_GT(covered(first, s.options.background), 40);
    for (std::size_t i = 0; i < s.scene.mesh.line_index.size(); i += 2)
        std::swap(s.scene.mesh.line_index[i], s.scene.mesh.line_index[i + 1]);
    EXPECT_EQ(draw(s), first);
}

TEST(Picture, OfManyLinesDoesNotDependOnTheirDirections) {
    // Enough pixels that a colour that is mixed from the other end, and rounds differently, shows.
    Random random(7);
    for (int round = 0; round < 20; ++round) {
        Shot s = shot("lines", 257, 131);
        geom::Mesh& mesh = s.scene.mesh;
        for (std::uint32_t i = 0; i < 3000; ++i) {
            add_vertex(mesh, Vec3(random.in_cube(1.2)));
            mesh.colour.emplace_back(random.in_cube(0.5) + DVec3(0.5));
            if (i % 2 == 1) add_line(mesh, i - 1, i);
        }
        s.camera.distance = round % 2 == 0 ? 3 : 0.3;
        const Image first = draw(s);
        EXPECT_GT(covered(first, s.options.background), 2000);
        for (std::size_t i = 0; i < mesh.line_index.size(); i += 2)
            std::swap(mesh.line_index[i], mesh.line_index[i + 1]);
        ASSERT_EQ(draw(s), first) << round;
    }
}

TEST(Picture, OfALineMixesTheColoursOfItsEnds) {
    Shot s = shot("line", 65, 9);
    geom::Mesh& mesh = s.scene.mesh;
    const std::uint32_t left = add_vertex(mesh, {-0.9F, 0, 0}),
                        right = add_vertex(mesh, {0.9F, 0, 0});
    add_line(mesh, left, right);
    mesh.colour = {{1, 0, 0}, {0, 0, 1}};
    s.camera.projection = scene::Projection::orthographic;
    s.camera.distance = 1 / std::tan(22.5 * std::numbers::pi / 180) / 7.5;
    const Image picture = draw(s);
    int before = 256, seen = 0;
    for (int x = 0; x < 65; ++x) {
        const Rgba8& p = picture.at(x, 4);
        if (p == s.options.background) continue;
        EXPECT_LT(p.r, before);
        EXPECT_NEAR(std::pow(p.r / 255.0, 2.2) + std::pow(p.b / 255.0, 2.2), 0.8, 0.02);
        before = p.r;
        ++seen;
    }
    EXPECT_GT(seen, 40);
}

TEST(Picture, ForcingAHighlightThatNoMaterialHasChangesNoBit) {
    Shot s = solids("matt");
    s.options.reflection = "lambert";
    const Image matt = draw(s);
    s.options.reflection = "blinn_phong";
    EXPECT_EQ(draw(s), matt);
    s.options.reflection = "auto";
    EXPECT_EQ(draw(s), matt);
    // And one that a material has does.
    s.scene.materials[0].specular = Vec3(0.5F);
    s.scene.materials[0].shininess = 20;
    EXPECT_NE(draw(s), matt);
}

TEST(Picture, WithManySamplesIsTheSameWhereOneTriangleCoversThePixels) {
    for (const bool clipped : {false, true}) {
        for (const int material : {0, 1}) {
            Shot s = full_screen(1, material);
            s.scene.mesh.index.resize(3); // one triangle
            s.scene.mesh.material.resize(1);
            s.scene.mesh.position = {{-1, -9, 0}, {9, 1, 0}, {-1, 9, 0}, {0, 0, 0}};
            for (Vec3& p : s.scene.mesh.position)
                p = clipped ? p * 1e6F + Vec3(-5, 0, 0) : p + Vec3(-3, 0, 0);
            if (clipped)
                for (Vec2& uv : s.scene.mesh.uv)
                    uv = uv * 3e6F;
            s.model.rotate_degrees = {0, 25, 0};
            const Image one = draw(s);
            EXPECT_EQ(covered(one, s.options.background), 70 * 50);
            for (const int samples : {2, 4, 8, 16}) {
                s.options.samples = samples;
                EXPECT_EQ(draw(s), one) << samples << ' ' << material << ' ' << clipped;
            }
        }
    }
}

TEST(Picture, WithManySamplesHasNoSeamBetweenTriangles) {
    // Two triangles and one colour: along their common edge every pixel is made of both.
    for (const int samples : {1, 2, 4, 8, 16}) {
        const Image picture = draw(full_screen(samples));
        const std::set<std::uint32_t> reds = [&] {
            std::set<std::uint32_t> all;
            for (const Rgba8& p : picture.pixels())
                all.insert(p.r);
            return all;
        }();
        EXPECT_EQ(reds.size(), 1U) << samples;
    }
}

TEST(Picture, MixesEdgesInLinearLight) {
    // A white square over a black background: a pixel of which k of 4 samples are white holds the
    // code of k / 4, not k / 4 of the code.
    Shot s = shot("edge", 64, 64);
    float light = scene::kAmbient;
    for (const scene::ViewLight& l : key_and_fill())
        light += l.colour.x * l.towards.z;
    s.scene.materials = {plain(Vec3(1 / light))};
    add_square(s.scene.mesh, 0.5F, 0, 0);
    s.pose.roll = 11 * scene::kAngleUnitsPerDegree;
    s.options.background = {0, 0, 0, 255};
    s.options.samples = 4;
    const Image picture = draw(s);
    const std::set<int> allowed = {0, nearest_code(0.25), nearest_code(0.5), nearest_code(0.75),
                                   255};
    std::set<int> seen;
    for (const Rgba8& p : picture.pixels())
        seen.insert(p.r);
    EXPECT_EQ(seen, allowed);
}

TEST(Picture, CulledFrontAndCulledBackTogetherCoverWhatNothingCulledDoes) {
    Shot s = bowl("bowl", frame::Cull::none);
    const Image all = draw(s);
    s.options.cull = frame::Cull::back;
    const Image outside = draw(s);
    s.options.cull = frame::Cull::front;
    const Image inside = draw(s);
    std::int64_t both = 0;
    for (std::size_t i = 0; i < all.pixels().size(); ++i) {
        const bool out = !(outside.pixels()[i] == s.options.background),
                   in = !(inside.pixels()[i] == s.options.background);
        ASSERT_EQ(!(all.pixels()[i] == s.options.background), out || in);
        ASSERT_TRUE(all.pixels()[i] == (out ? outside : inside).pixels()[i] ||
                    all.pixels()[i] == inside.pixels()[i]);
        both += out && in ? 1 : 0;
    }
    EXPECT_GT(covered(outside, s.options.background), 50);
    EXPECT_GT(both, 50);
    // A closed solid shows no back, so culling backs changes nothing.
    Shot solid = solids("solid");
    const Image whole = draw(solid);
    solid.options.cull = frame::Cull::back;
    EXPECT_EQ(draw(solid), whole);
}

TEST(Picture, ShowsTheTextureTheRightWayUp) {
    // The checkers' lower left is red and their lower right green.
    Shot s = shot("texture", 64, 64);
    s.scene.materials = {textured(0)};
    s.scene.textures = {checkers()};
    add_square(s.scene.mesh, 0.7F, 0, 0);
    const Image picture = draw(s);
    const auto is = [&](int x, int y, char c) {
        const Rgba8 p = picture.at(x, y);
        return c == 'r' ? p.r > p.g + 40 && p.r > p.b + 40 : p.g > p.r + 40 && p.g > p.b + 40;
    };
    const auto edge = [&](int from, int step) {
        while (picture.at(from, 32) == s.options.background)
            from += step;
        return from;
    };
    const int left = edge(0, 1) + 4, right = edge(63, -1) - 4;
    int bottom = 63;
    while (picture.at(32, bottom) == s.options.background)
        --bottom;
    EXPECT_TRUE(is(left, bottom - 3, 'r'));
    EXPECT_TRUE(is(right, bottom - 3, 'g'));
    EXPECT_FALSE(is(left, 63 - bottom + 3, 'r'));
}

TEST(Picture, ShowsTheTexelsThatRaysHitOnAPlaneThroughTheEyesPlane) {
    // A floor of noise that runs under and behind the eye: both its triangles are clipped, in each
    // winding, and every pixel has the colour of the texel where its ray meets the floor.
    Random random(8);
    scene::Texture noise{"noise", image::Image(16, 16)};
    for (Rgba8& p : noise.image.pixels())
        p = {static_cast<std::uint8_t>(random.whole(40, 255)),
             static_cast<std::uint8_t>(random.whole(40, 255)),
             static_cast<std::uint8_t>(random.whole(40, 255)), 255};
    const auto linear = [](int code) {
        return code <= 10 ? code / 255.0 / 12.92 : std::pow((code / 255.0 + 0.055) / 1.055, 2.4);
    };
    int checked = 0;
    for (const bool turned : {false, true}) {
        for (const double height : {0.2, 0.05, -0.1}) { // from below, too
            Shot s = shot("floor", 80, 60);
            s.scene.materials = {textured(0)};
            s.scene.textures = {noise};
            s.options.texture = "nearest";
            add_quad(s.scene.mesh, {{{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}}, {0, 1, 0},
                     0);
            if (turned)
                for (std::size_t i = 0; i < 6; i += 3)
                    std::swap(s.scene.mesh.index[i], s.scene.mesh.index[i + 2]);
            const DVec3 eye(0.1, height, 0.2);
            s.camera.eye = eye;
            s.camera.target = eye + DVec3(0, 0, -1); // level: view axes are the world's
            const Image picture = draw(s);
            double light = 0.15;
            for (const scene::ViewLight& l : key_and_fill())
                light += l.colour.x * std::max(0.0, (height > 0 ? 1.0 : -1.0) * l.towards.y);
            const double half = std::tan(22.5 * std::numbers::pi / 180);
            for (int y = 0; y < 60; ++y) {
                for (int x = 0; x < 80; ++x) {
                    const double dx = (2 * (x + 0.5) / 80 - 1) * half * 80 / 60,
                                 dy = (1 - 2 * (y + 0.5) / 60) * half;
                    const double w = -height / dy;
                    if (w < 0) continue;
                    const double u = (eye.x + w * dx + 1) / 2 * 16, v = (1 - (eye.z - w)) / 2 * 16;
                    const double room = w * w * 1e-2 + 1e-3; // the snapped edges' share of a pixel
                    const auto whole = [&](double t) {
                        return std::abs(t - std::round(t)) > room && t > 0 && t < 16;
                    };
                    if (!whole(u) || !whole(v)) continue;
                    const Rgba8 texel =
                        noise.image.at(static_cast<int>(u), 15 - static_cast<int>(v));
                    ASSERT_NEAR(picture.at(x, y).r, nearest_code(light * linear(texel.r)), 1);
                    ASSERT_NEAR(picture.at(x, y).g, nearest_code(light * linear(texel.g)), 1);
                    ++checked;
                }
            }
        }
    }
    EXPECT_GT(checked, 5000);
}

TEST(Picture, OfEverySizeIsDrawn) {
    for (const auto& [width, height] :
         {std::pair{1, 1}, {1, 500}, {500, 1}, {257, 3}, {64, 64}, {65, 63}, {128, 129}}) {
        for (Shot s : {solids("solids"), wires("wires"), textured_cube("cube", "bilinear")}) {
            s.options.width = width;
            s.options.height = height;
            for (const int samples : {1, 16}) {
                s.options.samples = samples;
                const Image picture = draw(s, {.threads = 2});
                ASSERT_EQ(picture.width(), width);
                ASSERT_EQ(picture.height(), height);
            }
        }
        Shot full = full_screen(1);
        full.options.width = width;
        full.options.height = height;
        full.camera.distance = 0.01;
        EXPECT_EQ(covered(draw(full), full.options.background), width * height);
    }
}

TEST(Picture, OfPointsShowsOnePixelEach) {
    Shot s = shot("points", 64, 64);
    for (int i = 0; i < 5; ++i) {
        const float at = -0.6F + 0.3F * static_cast<float>(i);
        add_point(s.scene.mesh, add_vertex(s.scene.mesh, {at, at, 0}), i % 2 == 0 ? 0 : -1);
    }
    s.scene.materials = {plain({1, 0, 0})};
    const Image picture = draw(s);
    EXPECT_EQ(covered(picture, s.options.background), 5);
    EXPECT_EQ(std::count(picture.pixels().begin(), picture.pixels().end(), Rgba8{255, 0, 0, 255}),
              3);
    s.options.samples = 16; // a point is a whole pixel at every number of samples
    EXPECT_EQ(draw(s), picture);
}

TEST(Picture, SurvivesHugeAndTinyZoom) {
    for (const int zoom : {-scene::kMaxZoomLevel, scene::kMaxZoomLevel}) {
        for (Shot s : {solids("solids"), wires("wires"), near_clip("floor")}) {
            s.pose.zoom = zoom;
            s.options.samples = 4;
            const Image picture = draw(s, {.threads = 2});
            EXPECT_EQ(picture, draw(s));
            // Zoomed in without end, the eye stands in the cube and sees its inside everywhere.
            EXPECT_TRUE(s.name != "solids" || zoom < 0 ||
                        covered(picture, s.options.background) == std::int64_t{64} * 64);
        }
    }
    for (const double scale : {1e-30, 1e-6, 1e30, 1e200}) {
        Shot s = full_screen(1, 1);
        s.model.scale = DVec3(scale);
        s.camera.distance = 2.6 * scale;
        // The same picture at every scale of the scene
        Shot plain_scale = full_screen(1, 1);
        plain_scale.camera.distance = 2.6;
        EXPECT_EQ(draw(s), draw(plain_scale)) << scale;
    }
}

// What the eye stands within is cut by near and by the guard band, on all sides.
TEST(Picture, IsTheSameAtEveryScaleOfModelAndCamera) {
    for (const auto projection :
         {scene::Projection::perspective, scene::Projection::orthographic}) {
        for (Shot s : {solids("solids"), glossy("glossy", "blinn_phong"),
                       near_clip("floor behind the eye")}) {
            s.camera.eye = s.camera.target = std::nullopt;
            s.camera.elevation_degrees = 20;
            s.camera.projection = projection;
            for (const double distance : {0.25, 3.0}) {
                s.camera.distance = distance;
                s.model.scale = DVec3(1);
                frame::Visibility seen, first;
                const Image picture = draw(s, {.visibility = &first});
                EXPECT_GT(covered(picture, s.options.background), 300);
                for (const int exponent : {-880, -500, -200, -100, -20, 20, 100, 200, 500, 880}) {
                    s.model.scale = DVec3(std::ldexp(1.0, exponent));
                    s.camera.distance = std::ldexp(distance, exponent);
                    EXPECT_EQ(draw(s, {.visibility = &seen}), picture) << s.name << exponent;
                    EXPECT_EQ(seen.id, first.id) << s.name << exponent;
                }
            }
        }
    }
}

// Far closer to its target than a vertex can be told from its neighbour, the eye is where it is.
TEST(Picture, FromWithinAModelIsTheSameHoweverCloseTheEyeIsToItsCentre) {
    for (Shot s : {solids("solids"), soup("soup", 300, 1, 5)}) {
        s.camera.distance = 0x1p-80;
        frame::Visibility seen, first;
        const Image picture = draw(s, {.visibility = &first});
        EXPECT_GT(covered(picture, s.options.background), 4000);
        for (const int exponent : {-85, -87, -95, -100, -102, -104}) {
            s.camera.distance = std::ldexp(1.0, exponent);
            EXPECT_EQ(draw(s, {.visibility = &seen}), picture) << s.name << exponent;
            EXPECT_EQ(seen.id, first.id) << s.name << exponent;
        }
    }
}

// Without perspective a model looks the same from anywhere on the view axis.
TEST(Picture, WithoutPerspectiveIsTheSameHoweverFarAwayTheModelIsMoved) {
    Shot s = solids("solids");
    s.camera.azimuth_degrees = s.camera.elevation_degrees = 0;
    s.camera.projection = scene::Projection::orthographic;
    frame::Visibility seen, first;
    const Image picture = draw(s, {.visibility = &first});
    for (const double z : {-1e30, -1e12, -1e5, 1e3, 1e7, 1e20, 1e200}) {
        s.model.translate = {0, 0, z};
        EXPECT_EQ(draw(s, {.visibility = &seen}), picture) << z;
        EXPECT_EQ(seen.id, first.id) << z;
    }
}

TEST(Picture, CountsWhatItDid) {
    frame::FrameStats stats;
    Shot s = full_screen(4);
    draw(s, {.threads = 2, .stats = &stats});
    EXPECT_EQ(stats.triangles_submitted, 2U);
    EXPECT_GE(stats.triangles_drawn, 2U);
    // Shaded once a pixel, twice where both triangles meet.
    EXPECT_GE(stats.items_shaded, 70U * 50);
    EXPECT_LE(stats.items_shaded, 70U * 50 + 140);
    s.options.cull = frame::Cull::front;
    draw(s, {.threads = 2, .stats = &stats});
    EXPECT_EQ(stats.triangles_drawn, 0U);
    EXPECT_EQ(stats.items_shaded, 0U);
}

} // namespace
} // namespace scanout::test
