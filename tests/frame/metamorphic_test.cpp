// Changes of a file that must not change a bit of its picture: the order of its triangles and of
// their vertices, its unit of length, and where in the world it stands (HARD-CASES 18, 20, 21, 69).
#include "file_model.h"
#include "raster/screen/screen.h"

#include <cmath>
#include <numeric>

namespace scanout::test {
namespace {

using frame::Cull;

// Vertices, normals and triangles in another order, each triangle begun at another vertex and,
// where nothing is culled, perhaps wound the other way.
FileModel reordered(const FileModel& m, Random& random, bool may_turn) {
    FileModel out = m;
    std::vector<int> v(m.vertex.size()), n(m.normal.size());
    std::iota(v.begin(), v.end(), 0);
    std::iota(n.begin(), n.end(), 0);
    shuffle(v, random);
    shuffle(n, random);
    for (std::size_t i = 0; i < v.size(); ++i)
        out.vertex[static_cast<std::size_t>(v[i])] = m.vertex[i];
    for (std::size_t i = 0; i < n.size(); ++i)
        out.normal[static_cast<std::size_t>(n[i])] = m.normal[i];
    for (FileFace& f : out.face) {
        const FileFace from = f;
        const int begin = random.whole(0, 2), step = may_turn && random.bits() % 2 == 0 ? 2 : 1;
        for (int k = 0; k < 3; ++k) {
            const auto old = static_cast<std::size_t>((begin + k * step) % 3);
            f.vertex[static_cast<std::size_t>(k)] = v[static_cast<std::size_t>(from.vertex[old])];
            f.normal[static_cast<std::size_t>(k)] = n[static_cast<std::size_t>(from.normal[old])];
        }
    }
    shuffle(out.face, random);
    return out;
}

TEST(Metamorphic, TheOrderOfTrianglesAndVerticesInAFileChangesNoBit) {
    Random random(1);
    int pictures = 0;
    for (const bool inside : {false, true}) {
        for (const Cull cull : {Cull::none, Cull::back, Cull::front}) {
            for (const int samples : {1, 8}) {
                const FileModel m = file_soup(random, 240, inside);
                const auto options = picture_options(samples, cull);
                const Shown first = m.picture(options);
                EXPECT_GT(samples_covered(first), 4000);
                for (int round = 0; round < 8; ++round, ++pictures)
                    ASSERT_TRUE(reordered(m, random, cull == Cull::none)
                                    .picture(options, 1 + round % 3)
                                    .same_but_for_ids(first))
                        << inside << ' ' << static_cast<int>(cull) << ' ' << samples;
            }
        }
    }
    RecordProperty("pictures_equal", pictures);
}

// HARD-CASES 18, 69: of two coincident triangles the one with the lower face number is seen,
// however the other names its vertices: taking the losers away changes no bit.
TEST(Metamorphic, AtAnExactTieTheLowerFaceNumberOfTheFileIsSeen) {
    Random random(2);
    int pictures = 0;
    for (const bool inside : {false, true}) {
        for (const int samples : {1, 4}) {
            const FileModel single = file_soup(random, 150, inside);
            for (int round = 0; round < 6; ++round, ++pictures) {
                FileModel both = single, winners = single;
                // Every face twice, in other materials and vertex orders, the whole list shuffled.
                for (const FileFace& f : single.face) {
                    FileFace twin = f;
                    twin.material = (f.material + 1) % FileModel::kMaterials;
                    const int begin = random.whole(0, 2), step = random.whole(1, 2);
                    for (int k = 0; k < 3; ++k) {
                        const auto from = static_cast<std::size_t>((begin + k * step) % 3);
                        twin.vertex[static_cast<std::size_t>(k)] = f.vertex[from];
                        twin.normal[static_cast<std::size_t>(k)] = f.normal[from];
                    }
                    both.face.push_back(twin);
                }
                shuffle(both.face, random);
                winners.face.clear();
                for (const FileFace& f : both.face) {
                    const auto key = [](FileFace face) {
                        std::sort(face.vertex.begin(), face.vertex.end());
                        return face.vertex;
                    };
                    if (std::none_of(winners.face.begin(), winners.face.end(),
                                     [&](const FileFace& w) { return key(w) == key(f); }))
                        winners.face.push_back(f);
                }
                ASSERT_EQ(winners.face.size(), single.face.size());
                const auto options = picture_options(samples);
                const Shown seen = both.picture(options, 1 + round % 3);
                ASSERT_TRUE(seen.same_but_for_ids(winners.picture(options)))
                    << inside << ' ' << samples;
                // The losers would have looked different.
                std::reverse(both.face.begin(), both.face.end());
                ASSERT_NE(both.picture(options).image, seen.image);
            }
        }
    }
    RecordProperty("pictures_equal", pictures);
}

// HARD-CASES 21: model and camera scaled by every power of two from -50 to 50; the lights have no
// place, only directions.
TEST(Metamorphic, ScalingModelAndCameraByAPowerOfTwoChangesNoBit) {
    Random random(3);
    int pictures = 0;
    for (const bool inside : {false, true}) {
        FileModel m = file_soup(random, 200, inside);
        for (DVec3& v : m.vertex) // full mantissas, off the origin
            v = v * 0.7 + DVec3(0.1, 0.2, 0.3);
        const auto options = picture_options(inside ? 1 : 4);
        const Shown first = m.picture(options);
        EXPECT_GT(samples_covered(first), 4000);
        for (int k = -50; k <= 50; ++k, ++pictures) {
            FileModel scaled = m;
            const double factor = std::ldexp(1.0, k);
            for (DVec3& v : scaled.vertex)
                v = v * factor;
            scaled.eye = m.eye * factor;
            scaled.target = m.target * factor;
            ASSERT_TRUE(scaled.picture(options) == first) << k << ' ' << inside;
        }
    }
    RecordProperty("pictures_equal", pictures);
}

// A point and a spot of the world, and one that hangs on the camera, in bounding radii.
std::vector<scene::Light> placed_lights(const DVec3& middle, double scale) {
    std::vector<scene::Light> lights;
    for (const auto kind : {scene::LightKind::ambient, scene::LightKind::point,
                            scene::LightKind::spot, scene::LightKind::point}) {
        scene::Light light;
        light.kind = kind;
        light.power = kind == scene::LightKind::ambient ? 0.1 : 0.9;
        light.position = (middle + DVec3(0.7, 0.9, 1.1)) * scale;
        light.size = 1.2 * scale; // so large that surfaces stand within it
        if (kind == scene::LightKind::spot) {
            light.position = (middle + DVec3(-0.8, 1.3, 0.4)) * scale;
            light.target = (middle + DVec3(0.1, 0.05, -0.1)) * scale;
        }
        lights.push_back(light);
    }
    lights.back().frame = scene::LightFrame::camera;
    lights.back().position = {0.5, 0.25, 0.125};
    lights.back().size = 0.2;
    return lights;
}

// HARD-CASES 21 with lights that have a place, a reach and a size: those scale with the model.
TEST(Metamorphic, ScalingModelCameraAndLightsByAPowerOfTwoChangesNoBit) {
    Random random(5);
    const DVec3 middle(0.1, 0.2, 0.3);
    int pictures = 0;
    for (const bool inside : {false, true}) {
        FileModel m = file_soup(random, 200, inside);
        for (DVec3& v : m.vertex)
            v = v * 0.7 + middle;
        auto options = picture_options(inside ? 1 : 4);
        const Shown unlit = m.picture(options);
        options.lights = placed_lights(middle, 1);
        const Shown first = m.picture(options);
        EXPECT_GT(samples_covered(first), 4000);
        EXPECT_FALSE(first == unlit);
        for (int k = -50; k <= 50; ++k, ++pictures) {
            FileModel scaled = m;
            const double factor = std::ldexp(1.0, k);
            for (DVec3& v : scaled.vertex)
                v = v * factor;
            scaled.eye = m.eye * factor;
            scaled.target = m.target * factor;
            options.lights = placed_lights(middle, factor);
            ASSERT_TRUE(scaled.picture(options) == first) << k << ' ' << inside;
        }
        // Lights that stay behind light it otherwise.
        options.lights = placed_lights(middle, 2);
        EXPECT_FALSE(m.picture(options) == first);
        options.lights = placed_lights(middle, 1);
        for (scene::Light& light : options.lights)
            light.size *= 2;
        EXPECT_FALSE(m.picture(options) == first);
    }
    RecordProperty("pictures_equal", pictures);
}

// The same with what is measured in lengths of other kinds: shadows, their biases and the plane
// that they fall on, blended layers, and textures that the model's size places.
TEST(Metamorphic, ScalingShadowsLayersAndTexturesByAPowerOfTwoChangesNoBit) {
    Random random(7);
    const DVec3 middle(0.1, 0.2, 0.3);
    FileModel m = file_soup(random, 120, false);
    const auto first_corner = static_cast<int>(m.vertex.size()),
               up = static_cast<int>(m.normal.size());
    m.vertex.insert(m.vertex.end(), {{-3, -3, -3}, {-3, -3, 3}, {3, -3, 3}, {3, -3, -3}});
    m.normal.push_back({0, 1, 0});
    for (const int k : {1, 2}) // a floor
        m.face.push_back({{first_corner, first_corner + k, first_corner + k + 1}, {up, up, up}, 0});
    for (DVec3& v : m.vertex)
        v = v * 0.7 + middle;
    m.opacity = 0.6;
    auto options = picture_options(4);
    options.source = "checker";
    options.mapping = "box";
    options.texture = "trilinear";
    options.shadow_size = 256;
    int pictures = 0;
    for (const char* shadow : {"map", "map_pcf", "map_soft", "projected", "volume"}) {
        options.shadow = shadow;
        options.lights = placed_lights(middle, 1);
        options.effects.clear();
        const Shown first = m.picture(options);
        options.effects["shadow"] = false;
        EXPECT_FALSE(m.picture(options) == first) << shadow;
        options.effects.clear();
        for (const int k : {-50, -23, -1, 1, 17, 50}) {
            FileModel scaled = m;
            const double factor = std::ldexp(1.0, k);
            for (DVec3& v : scaled.vertex)
                v = v * factor;
            scaled.eye = m.eye * factor;
            scaled.target = m.target * factor;
            options.lights = placed_lights(middle, factor);
            ASSERT_TRUE(scaled.picture(options) == first) << k << ' ' << shadow;
            ++pictures;
        }
    }
    options.lights = placed_lights(middle, 1);
    const Shown blended = m.picture(options);
    m.opacity = 1;
    EXPECT_FALSE(m.picture(options) == blended);
    RecordProperty("pictures_equal", pictures);
}

const DVec3 kFar[] = {{1e7, 1e7, -1e7}, {-1e7, 0, 1e7}, {0, 1e7, 0}, {4.6e6, 5.4e6, 210}};

FileModel moved(const FileModel& m, const DVec3& by) {
    FileModel out = m;
    for (DVec3& v : out.vertex)
        v += by;
    out.eye += by;
    out.target += by;
    return out;
}

// HARD-CASES 20
TEST(Metamorphic, MovingModelAndCameraByTenMillionChangesNoBitOnAGrid) {
    Random random(4);
    int pictures = 0;
    for (const bool inside : {false, true}) {
        const FileModel m = file_soup(random, 300, inside); // multiples of 2^-20
        for (const int samples : {1, 4}) {
            const auto options = picture_options(samples);
            const Shown first = m.picture(options);
            EXPECT_GT(samples_covered(first), 4000);
            for (const DVec3& by : kFar) {
                ASSERT_TRUE(moved(m, by).picture(options) == first) << by.x << ' ' << by.y;
                ++pictures;
            }
        }
    }
    RecordProperty("pictures_equal", pictures);
}

// Where a vertex of the file should appear, in long double.
struct Pixel {
    long double x, y, w;
};
Pixel exact_pixel(const FileModel& m, const DVec3& vertex, int width, int height) {
    using Real = long double;
    Real back[3], at[3];
    for (int i = 0; i < 3; ++i) {
        back[i] = static_cast<Real>(m.eye[i]) - m.target[i];
        at[i] = static_cast<Real>(vertex[i]) - m.eye[i];
    }
    const Real level = std::sqrt(back[0] * back[0] + back[2] * back[2]);
    const Real length = std::sqrt(level * level + back[1] * back[1]);
    const Real right[3] = {back[2] / level, 0, -back[0] / level};
    const Real z[3] = {back[0] / length, back[1] / length, back[2] / length};
    const Real up[3] = {z[1] * right[2] - z[2] * right[1], z[2] * right[0] - z[0] * right[2],
                        z[0] * right[1] - z[1] * right[0]};
    const auto dot = [&](const Real* a) { return a[0] * at[0] + a[1] * at[1] + a[2] * at[2]; };
    const Real w = -dot(z), pixels = height / 2.0L / std::tan(std::numbers::pi_v<Real> / 8);
    return {width / 2.0L + dot(right) / w * pixels, height / 2.0L - dot(up) / w * pixels, w};
}

// HARD-CASES 20: coordinates with digits that ten million and they do not hold together.
TEST(Metamorphic, MovingModelAndCameraByTenMillionMovesNoVertexByAThousandthOfAPixel) {
    constexpr int kWidth = 1920, kHeight = 1080;
    Random random(5);
    double worst = 0, worst_still = 0, worst_moved = 0;
    int vertices = 0;
    for (const double size : {0.01, 1.0, 300.0}) {
        FileModel m = file_soup(random, 700, false);
        for (DVec3& v : m.vertex)
            v = (v + random.in_cube(1e-4)) * size;
        m.eye = m.eye * size;
        m.target = m.target * size;
        const auto pixels = [&](const FileModel& model) {
            const scene::Scene scene = model.load();
            const raster::ScreenTransform transform(model.view(scene.mesh, kWidth, kHeight), kWidth,
                                                    kHeight);
            std::vector<DVec2> out; // by corners of faces, in file order
            for (const std::uint32_t i : scene.mesh.index) {
                const raster::ClipVertex c = transform.to_clip(scene.mesh.position[i]);
                out.emplace_back(c.x / c.w, c.y / c.w);
            }
            return out;
        };
        const auto from_exact = [&](const std::vector<DVec2>& got, std::size_t corner) {
            const FileFace& f = m.face[corner / 3];
            const Pixel p = exact_pixel(m, m.vertex[static_cast<std::size_t>(f.vertex[corner % 3])],
                                        kWidth, kHeight);
            return static_cast<double>(
                std::max(std::abs(p.x - got[corner].x), std::abs(p.y - got[corner].y)));
        };
        const std::vector<DVec2> still = pixels(m);
        for (const DVec3& by : kFar) {
            const std::vector<DVec2> there = pixels(moved(m, by));
            ASSERT_EQ(there.size(), still.size());
            for (std::size_t i = 0; i < still.size(); ++i) {
                worst = std::max(
                    {worst, std::abs(still[i].x - there[i].x), std::abs(still[i].y - there[i].y)});
                worst_still = std::max(worst_still, from_exact(still, i));
                worst_moved = std::max(worst_moved, from_exact(there, i));
                ++vertices;
            }
        }
    }
    EXPECT_LE(worst, 1e-3);
    EXPECT_LE(worst_moved, 1e-3);
    EXPECT_GT(worst, 0);
    EXPECT_GT(vertices, 10000);
    RecordProperty("worst_move_px", testing::PrintToString(worst));
    RecordProperty("worst_from_exact_px", testing::PrintToString(worst_still));
    RecordProperty("worst_from_exact_moved_px", testing::PrintToString(worst_moved));
}

// HARD-CASES 69, P8: twenty runs on each of five numbers of threads, in four sizes of tiles: one
// picture, one depth, one id a sample.
TEST(Metamorphic, ThreadsTilesAndRepetitionChangeNoBit) {
    Random random(6);
    const scene::Scene scene = file_soup(random, 200, true).load();
    FileModel camera;
    camera.eye = {0.2, 0.1, 0.3};
    camera.target = {-0.1, 0, 0};
    auto options = picture_options(4);
    const auto plan = frame::plan(options, frame::facts(scene));
    ASSERT_TRUE(plan);
    const scene::View view = camera.view(scene.mesh, options.width, options.height);
    std::optional<Shown> first;
    int pictures = 0;
    for (const int threads : {1, 2, 3, 7, 16}) {
        Jobs jobs(threads);
        for (int run = 0; run < 20; ++run, ++pictures) {
            frame::Renderer renderer(jobs);
            frame::Visibility seen;
            const int tile_size = 8 << run % 4;
            const Shown shown{renderer.render(scene, view, *plan, &seen, tile_size), seen.depth,
                              seen.id};
            if (!first) first = shown;
            ASSERT_TRUE(shown == *first) << threads << ' ' << run << ' ' << tile_size;
        }
    }
    RecordProperty("pictures_equal", pictures);
}

} // namespace
} // namespace scanout::test
