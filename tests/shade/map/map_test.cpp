// The maps of a material: what each changes, and that its neutral element changes no bit. Normals
// and bumps: HARD-CASES 30, 31.
#include "rows.h"
#include "shade/block.h"
#include "support/lights.h"

#include <cmath>
#include <limits>

namespace scanout::shade::test {
namespace {

constexpr Map kEvery[] = {kNormalMap,    kBumpMap,      kSpecularMap, kShininessMap,
                          kRoughnessMap, kMetalnessMap, kEmissionMap};

struct Mapped {
    explicit Mapped(Map m, image::Image image) : texture{"map", std::move(image)}, map(m) {
        material.specular = {0.9F, 0.5F, 0.25F};
        material.shininess = 40;
        material.emission = {0.5F, 0.25F, 2};
        material.roughness = 0.6F;
        material.metalness = 0.8F;
        block->map[map] = {&texture, &(material.*map_slots()[map].map).edit(), nullptr,
                           Wrap::repeat};
        frame.filter = find_row(shade::texture::kRows, "bilinear");
        frame.orthographic = true;
        face(0, {0, 0, 1}, {0, 0, 1});
        for (int i = 0; i < kBlockSize; ++i) {
            face(i, {0, 0, 1}, {0, 0, 1});
            block->u_x[i] = block->v_y[i] = 0;
            slopes(i, 0.01F, 0, 0, -0.01F); // u to the right, v up
        }
        block->runs = kBlockSize;
    }
    // A triangle of its own a lane: the plane's normal and the shading normal, view space.
    void face(int i, const Vec3& plane, const Vec3& normal) {
        for (int c = 0; c < 3; ++c) {
            primitive[i].facing[c] = plane[c];
            block->normal[c][i] = normal[c];
        }
        block->run[i] = {&primitive[i], i, 1};
    }
    void slopes(int i, float u_x, float v_x, float u_y, float v_y) {
        block->u_x[i] = u_x;
        block->v_x[i] = v_x;
        block->u_y[i] = u_y;
        block->v_y[i] = v_y;
    }
    void run(const char* stage) { run_stage("map", stage, *block, frame); }
    DVec3 normal(int i) const {
        return {block->normal[0][i], block->normal[1][i], block->normal[2][i]};
    }
    scene::Texture texture;
    Map map;
    scene::Material material = scanout::test::plain(Vec3(1));
    std::unique_ptr<ShadingBlock> block = new_block(material);
    FrameState frame = identity_frame();
    Primitive primitive[kBlockSize] = {};
};

image::Image one_texel(std::uint8_t r, std::uint8_t g, std::uint8_t b, std::uint8_t a = 255) {
    return {1, 1, {r, g, b, a}};
}

// --- colours and numbers

TEST(Maps, SpecularAndGlossMultiplyTheMaterialsOwn) {
    Mapped specular(kSpecularMap, one_texel(255, 51, 0));
    specular.run("specular");
    Mapped gloss(kShininessMap, one_texel(51, 51, 51));
    gloss.run("gloss");
    for (int i = 0; i < kBlockSize; ++i) {
        EXPECT_EQ(specular.block->specular[0][i], 0.9F);
        EXPECT_FLOAT_EQ(specular.block->specular[1][i], 0.1F); // linear: 51 / 255
        EXPECT_EQ(specular.block->specular[2][i], 0);
        EXPECT_FLOAT_EQ(gloss.block->shininess[i], 8);
    }
    Mapped white(kShininessMap, one_texel(255, 255, 255)), black(kShininessMap, one_texel(0, 0, 0));
    white.run("gloss");
    black.run("gloss");
    EXPECT_EQ(white.block->shininess[5], 40);
    EXPECT_EQ(black.block->shininess[5], 0) << "no highlight, as Ns 0";
}

TEST(Maps, AScalarMapReadsTheChannelThatTheFileNames) {
    for (const auto& [channel, expected] :
         {std::pair{'r', 0.2F}, {'g', 0.4F}, {'b', 0.6F}, {'m', 0.8F}}) {
        Mapped gloss(kShininessMap, one_texel(51, 102, 153, 204));
        gloss.material.map_shininess.edit().channel = channel;
        gloss.run("gloss");
        EXPECT_FLOAT_EQ(gloss.block->shininess[0], 40 * expected) << channel;
    }
    Mapped bright(kShininessMap, one_texel(51, 102, 153, 204));
    bright.run("gloss");
    EXPECT_NEAR(bright.block->shininess[0], 40 * (0.2126 * 0.2 + 0.7152 * 0.4 + 0.0722 * 0.6),
                1e-5);
}

// To the bit: a map that gives one Ks or one Ns is a material that says them.
TEST(Maps, EveryModelReflectsWhatTheMapsGive) {
    Random random(8);
    const scene::Texture any{"any", one_texel(1, 2, 3)};
    std::vector<scene::ViewLight> lights;
    for (int k = 0; k < 3; ++k) {
        const DVec3 to = random.in_cube(1) + DVec3(0, 0, 1.2);
        lights.push_back(
            scanout::test::directional(Vec3(to / std::sqrt(dot3(to, to))), {1, 0.5F, 0.25F}));
    }
    for (const char* model : {"phong", "blinn_phong", "blinn_phong_normalised", "ggx"}) {
        for (const float ns : {1.0F, 7.3F, 900.0F}) {
            const Vec3 ks(0.7F, 0.2F, 0.05F);
            const scene::Material mapped = scanout::test::plain(Vec3(1), Vec3(1), 1234),
                                  plain = scanout::test::plain(Vec3(1), ks, ns);
            auto by_maps = new_block(mapped), by_material = new_block(plain);
            by_maps->map[kSpecularMap] = {&any, mapped.map_specular.operator->(), nullptr,
                                          Wrap::repeat};
            by_maps->map[kShininessMap] = {&any, mapped.map_shininess.operator->(), nullptr,
                                           Wrap::repeat};
            std::fill_n(by_maps->shininess, kPaddedBlock, ns);
            for (int c = 0; c < 3; ++c)
                std::fill_n(by_maps->specular[c], kPaddedBlock, ks[c]);
            FrameState frame = identity_frame();
            frame.lights = lights;
            for (int i = 0; i < kBlockSize; ++i) {
                const DVec3 n = random.in_cube(1) + DVec3(0, 0, 1.5);
                for (ShadingBlock* b : {by_maps.get(), by_material.get()}) {
                    b->ray_x[i] = static_cast<float>(i) / kBlockSize - 0.5F;
                    for (int c = 0; c < 3; ++c)
                        b->normal[c][i] = static_cast<float>(n[c] / std::sqrt(dot3(n, n)));
                }
            }
            run_stage("reflection", model, *by_maps, frame);
            run_stage("reflection", model, *by_material, frame);
            for (int c = 0; c < 3; ++c)
                for (int i = 0; i < kBlockSize; ++i)
                    ASSERT_EQ(by_maps->colour[c][i], by_material->colour[c][i]) << model << ns;
        }
    }
}

TEST(Maps, RoughnessAndMetalnessMultiplyTheMaterialsOwn) {
    for (const auto& [code, share] : {std::pair{255, 1.0F}, {51, 0.2F}, {0, 0.0F}}) {
        const auto c = static_cast<std::uint8_t>(code);
        Mapped rough(kRoughnessMap, one_texel(c, c, c)), metal(kMetalnessMap, one_texel(c, c, c));
        rough.run("roughness");
        metal.run("metalness");
        for (int i = 0; i < kBlockSize; ++i) {
            ASSERT_FLOAT_EQ(rough.block->roughness[i], 0.6F * share);
            ASSERT_FLOAT_EQ(metal.block->metalness[i], 0.8F * share);
        }
        if (code != 255) continue;
        EXPECT_EQ(rough.block->roughness[5], 0.6F) << "white changes no bit";
        EXPECT_EQ(metal.block->metalness[5], 0.8F) << "white changes no bit";
    }
    Mapped blue(kMetalnessMap, one_texel(255, 255, 51));
    blue.material.map_metalness.edit().channel = 'b';
    blue.run("metalness");
    EXPECT_FLOAT_EQ(blue.block->metalness[0], 0.16F);
}

// To the bit: a map that gives one Pr or one Pm is a material that says them.
TEST(Maps, MirrorsAreAsRoughAndAsMetallicAsTheMapsSay) {
    Random random(9);
    const scene::Texture any{"any", one_texel(1, 2, 3)};
    std::vector<scene::ViewLight> lights;
    for (int k = 0; k < 3; ++k) {
        const DVec3 to = random.in_cube(1) + DVec3(0, 0, 1.2);
        lights.push_back(
            scanout::test::directional(Vec3(to / std::sqrt(dot3(to, to))), {1, 0.5F, 0.25F}));
    }
    for (const float pr : {0.0F, 0.03F, 0.4F, 1.0F}) {
        for (const float pm : {0.0F, 0.3F, 1.0F}) {
            scene::Material mapped = scanout::test::plain(Vec3(1)), plain = mapped;
            mapped.roughness = mapped.metalness = 0.77F;
            plain.roughness = pr;
            plain.metalness = pm;
            auto by_maps = new_block(mapped), by_material = new_block(plain);
            by_maps->map[kRoughnessMap] = {&any, mapped.map_roughness.operator->(), nullptr,
                                           Wrap::repeat};
            by_maps->map[kMetalnessMap] = {&any, mapped.map_metalness.operator->(), nullptr,
                                           Wrap::repeat};
            std::fill_n(by_maps->roughness, kPaddedBlock, pr);
            std::fill_n(by_maps->metalness, kPaddedBlock, pm);
            FrameState frame = identity_frame();
            frame.lights = lights;
            for (int i = 0; i < kBlockSize; ++i) {
                const DVec3 n = random.in_cube(1) + DVec3(0, 0, 1.5);
                for (ShadingBlock* b : {by_maps.get(), by_material.get()}) {
                    b->ray_x[i] = static_cast<float>(i) / kBlockSize - 0.5F;
                    for (int c = 0; c < 3; ++c) {
                        b->normal[c][i] = static_cast<float>(n[c] / std::sqrt(dot3(n, n)));
                        b->albedo[c][i] = 0.25F * static_cast<float>(c + 1);
                    }
                }
            }
            run_stage("reflection", "ggx", *by_maps, frame);
            run_stage("reflection", "ggx", *by_material, frame);
            for (int c = 0; c < 3; ++c)
                for (int i = 0; i < kBlockSize; ++i)
                    ASSERT_EQ(by_maps->colour[c][i], by_material->colour[c][i]) << pr << ' ' << pm;
        }
    }
}

TEST(Maps, EmissionIsAddedToWhatTheSurfaceReflects) {
    Mapped lamp(kEmissionMap, one_texel(255, 0, 255));
    for (auto& channel : lamp.block->colour)
        std::fill_n(channel, kBlockSize, 0.125F);
    lamp.run("emission");
    EXPECT_EQ(lamp.block->colour[0][3], 0.625F);
    EXPECT_EQ(lamp.block->colour[1][3], 0.125F);
    EXPECT_EQ(lamp.block->colour[2][3], 2.125F);
    lamp.block->map[kEmissionMap].texture = nullptr; // Ke alone
    lamp.run("emission");
    EXPECT_EQ(lamp.block->colour[1][3], 0.375F);
    lamp.material.emission = Vec3(0);
    const ShadingBlock before = *lamp.block;
    lamp.run("emission");
    EXPECT_TRUE(same_lanes(*lamp.block, before, 0, kBlockSize));
}

TEST(Maps, NothingIsReadWhereThereIsNoMap) {
    for (const Map map : kEvery) {
        Mapped none(map, one_texel(9, 9, 9));
        none.block->map[map].texture = nullptr;
        none.material.emission = Vec3(0);
        const ShadingBlock before = *none.block;
        for (const char* stage :
             {"normal", "bump", "specular", "gloss", "roughness", "metalness", "emission"})
            none.run(stage);
        EXPECT_TRUE(same_lanes(*none.block, before, 0, kBlockSize));
    }
}

// --- normals

TEST(NormalMap, FlatOneChangesNoBit) {
    Random random(1);
    for (const int blue : {129, 200, 255}) {
        Mapped flat(kNormalMap, image::Image(4, 4, {128, 128, static_cast<std::uint8_t>(blue)}));
        for (int i = 0; i < kBlockSize; ++i) {
            const DVec3 n = random.in_cube(1);
            flat.face(i, Vec3(random.in_cube(1)), Vec3(n / std::sqrt(dot3(n, n))));
            const DVec3 x = random.in_cube(1), y = random.in_cube(1);
            flat.slopes(i, x.x, x.y, y.x, y.y);
        }
        const ShadingBlock before = *flat.block;
        flat.run("normal");
        for (int c = 0; c < 3; ++c)
            for (int i = 0; i < kBlockSize; ++i)
                ASSERT_EQ(flat.block->normal[c][i], before.normal[c][i]);
    }
}

TEST(NormalMap, RedLeansAlongUAndGreenAlongV) {
    // 254: as far along as blue is out: 45 degrees.
    Mapped red(kNormalMap, one_texel(254, 128, 254)), green(kNormalMap, one_texel(128, 254, 254));
    const double h = std::sqrt(0.5);
    // u and v as the picture lies; u mirrored; v mirrored; turned by a right angle; a steeper
    // slope.
    const struct {
        float u_x, v_x, u_y, v_y;
        DVec3 along_u, along_v;
    } cases[] = {{0.01F, 0, 0, -0.01F, {1, 0, 0}, {0, 1, 0}},
                 {-0.01F, 0, 0, -0.01F, {-1, 0, 0}, {0, 1, 0}},
                 {0.01F, 0, 0, 0.01F, {1, 0, 0}, {0, -1, 0}},
                 {0, 0.01F, 0.01F, 0, {0, -1, 0}, {1, 0, 0}},
                 {1e-6F, 0, 0, -1e3F, {1, 0, 0}, {0, 1, 0}}};
    for (const auto& c : cases) {
        for (Mapped* m : {&red, &green}) {
            for (int i = 0; i < kBlockSize; ++i) {
                m->face(i, {0, 0, 1}, {0, 0, 1});
                m->slopes(i, c.u_x, c.v_x, c.u_y, c.v_y);
            }
            m->run("normal");
            const DVec3 expected = ((m == &red ? c.along_u : c.along_v) + DVec3(0, 0, 1)) * h;
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(m->normal(7)[k], expected[k], 1e-6);
        }
    }
    red.material.map_normal.edit().scale = {-1, 1, 1}; // the picture runs against u
    red.face(0, {0, 0, 1}, {0, 0, 1});
    red.slopes(0, 0.01F, 0, 0, -0.01F);
    red.run("normal");
    EXPECT_NEAR(red.normal(0).x, -h, 1e-6);
}

// The slopes of a plane with known directions of u and v, seen through any pixel.
TEST(NormalMap, LeansAlongTheDirectionsOfAnyPlaneInPerspective) {
    Random random(2);
    Mapped red(kNormalMap, one_texel(254, 128, 128)), green(kNormalMap, one_texel(128, 254, 128));
    red.frame.orthographic = green.frame.orthographic = false;
    double worst = 0;
    for (int round = 0; round < 300; ++round) {
        std::vector<DVec3> along_u(kBlockSize), along_v(kBlockSize);
        for (int i = 0; i < kBlockSize; ++i) {
            DVec3 n = random.in_cube(1), e1 = random.in_cube(1);
            const DVec3 ray(random.in(-0.5, 0.5), random.in(-0.5, 0.5), -1);
            n = n / std::sqrt(dot3(n, n));
            if (dot3(n, ray) > 0) n = -n;
            if (dot3(n, ray) > -0.1) { // edge on
                n = DVec3(0, 0, 1);
            }
            e1 = e1 - n * dot3(n, e1);
            e1 = e1 / std::sqrt(dot3(e1, e1));
            DVec3 e2 = cross3(n, e1);
            if (i % 2 == 0) e2 = -e2; // mirrored
            const double u_size = random.in(0.1, 10), v_size = random.in(0.1, 10);
            // du/dP = e1 / u_size; the point moves with the pixel.
            const double t = random.in(1, 3);
            const auto moved = [&](const DVec3& by) {
                return (by - ray * (dot3(n, by) / dot3(n, ray))) * (t / 500);
            };
            const DVec3 right = moved({1, 0, 0}), down = moved({0, -1, 0});
            for (Mapped* m : {&red, &green}) {
                m->face(i, Vec3(n * random.in(0.1, 2)), Vec3(n));
                m->block->ray_x[i] = static_cast<float>(ray.x);
                m->block->ray_y[i] = static_cast<float>(ray.y);
                m->slopes(i, dot3(e1, right) / u_size, dot3(e2, right) / v_size,
                          dot3(e1, down) / u_size, dot3(e2, down) / v_size);
            }
            along_u[static_cast<std::size_t>(i)] = e1;
            along_v[static_cast<std::size_t>(i)] = e2;
        }
        red.run("normal");
        green.run("normal");
        for (int i = 0; i < kBlockSize; ++i)
            for (int c = 0; c < 3; ++c) {
                const auto lane = static_cast<std::size_t>(i);
                worst = std::max({worst, std::abs(red.normal(i)[c] - along_u[lane][c]),
                                  std::abs(green.normal(i)[c] - along_v[lane][c])});
            }
    }
    EXPECT_LT(worst, 1e-4);
    RecordProperty("worst", testing::PrintToString(worst));
}

TEST(NormalMap, StaysUnitAndFiniteWhateverTheCoordinatesAre) {
    Random random(3);
    constexpr float kOdd[] = {0, -0.0F, 0x1p60F, -0x1p60F, 1e-38F, 1, -1e-20F};
    image::Image image(8, 8);
    for (image::Rgba8& p : image.pixels())
        p = {static_cast<std::uint8_t>(random.bits()), static_cast<std::uint8_t>(random.bits()),
             static_cast<std::uint8_t>(random.bits()), 255};
    Mapped any(kNormalMap, image);
    any.frame.orthographic = false;
    for (int round = 0; round < 3000; ++round) {
        const auto odd = [&] { return kOdd[random.whole(0, 6)]; };
        for (int i = 0; i < kBlockSize; ++i) {
            const DVec3 n = random.in_cube(1);
            any.face(i, round % 3 == 0 ? Vec3(odd(), odd(), odd()) : Vec3(random.in_cube(1)),
                     Vec3(n / std::sqrt(dot3(n, n))));
            any.slopes(i, odd(), odd(), odd(), odd());
            any.block->u[i] = static_cast<float>(random.unit());
            any.block->v[i] = static_cast<float>(random.unit());
            any.block->ray_x[i] = static_cast<float>(random.in(-2, 2));
        }
        any.run("normal");
        for (int i = 0; i < kBlockSize; ++i) {
            const DVec3 n = any.normal(i);
            ASSERT_NEAR(dot3(n, n), 1, 2e-6);
            for (int k = 0; k < 2; ++k) {
                const auto& t = any.block->tangent[k];
                ASSERT_TRUE(std::isfinite(t[0][i]) && std::isfinite(t[1][i]) &&
                            std::isfinite(t[2][i]));
            }
        }
    }
}

// HARD-CASES 30: without coordinates, for every normal, poles included.
TEST(NormalMap, WithoutCoordinatesTheFrameIsOrthonormalForEveryNormal) {
    Random random(4);
    Mapped flat(kNormalMap, one_texel(128, 128, 255));
    double worst = 0;
    for (int round = 0; round < 8000; ++round) { // a million
        for (int i = 0; i < kBlockSize; ++i) {
            DVec3 n = random.in_cube(1);
            if (round % 4 == 0) n = {n.x * 1e-4, n.y * 1e-4, i % 2 == 0 ? 1 : -1}; // near the poles
            if (round % 16 == 0) n = {0, 0, i % 2 == 0 ? 1 : -1};
            n = n / std::sqrt(dot3(n, n));
            flat.face(i, Vec3(n), Vec3(n));
            flat.slopes(i, 0, 0, 0, 0);
        }
        if (round < 20)
            flat.run("normal"); // on every target
        else
            stage("map", "normal").run(*flat.block, flat.frame);
        for (int i = 0; i < kBlockSize; ++i) {
            const auto vector = [&](const float(&v)[3][kPaddedBlock]) {
                return DVec3(v[0][i], v[1][i], v[2][i]);
            };
            const DVec3 n = flat.normal(i), t = vector(flat.block->tangent[0]),
                        b = vector(flat.block->tangent[1]);
            worst = std::max({worst, std::abs(dot3(n, t)), std::abs(dot3(n, b)),
                              std::abs(dot3(t, b)), std::abs(std::sqrt(dot3(t, t)) - 1),
                              std::abs(std::sqrt(dot3(b, b)) - 1)});
        }
    }
    EXPECT_LE(worst, 1e-6);
}

// --- bumps

TEST(BumpMap, OfOneHeightChangesNoBit) {
    Mapped level(kBumpMap, image::Image(8, 8, {77, 77, 77, 255}));
    Random random(5);
    for (int i = 0; i < kBlockSize; ++i) {
        const DVec3 n = random.in_cube(1);
        level.face(i, Vec3(n), Vec3(n / std::sqrt(dot3(n, n))));
        level.block->u[i] = static_cast<float>(random.unit());
    }
    const ShadingBlock before = *level.block;
    level.run("bump");
    for (int i = 0; i < kBlockSize; ++i) {
        for (int c = 0; c < 3; ++c)
            ASSERT_EQ(level.block->normal[c][i], before.normal[c][i]);
        ASSERT_EQ(level.block->u[i], before.u[i]) << "the lanes are back where they were";
        ASSERT_EQ(level.block->v[i], before.v[i]);
    }
}

TEST(BumpMap, ARampLeansTheNormalAgainstItsSlope) {
    // Four codes a texel, along u or along v (rows run down).
    image::Image along_u(64, 64), along_v(64, 64);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const auto u = static_cast<std::uint8_t>(4 * x),
                       v = static_cast<std::uint8_t>(4 * (63 - y));
            along_u.at(x, y) = {u, u, u, 255};
            along_v.at(x, y) = {v, v, v, 255};
        }
    for (const float strength : {1.0F, 20.0F, -3.0F}) {
        const double slope = strength * 4 / 255.0, length = std::sqrt(1 + slope * slope);
        Mapped u(kBumpMap, along_u), v(kBumpMap, along_v);
        for (Mapped* m : {&u, &v}) {
            m->material.map_bump.edit().bump_multiplier = strength;
            for (int i = 0; i < kBlockSize; ++i)
                m->block->u[i] = m->block->v[i] = 0.3F + 0.003F * static_cast<float>(i % 100);
            m->run("bump");
        }
        for (int i = 0; i < kBlockSize; ++i) {
            ASSERT_NEAR(u.normal(i).x, -slope / length, 2e-5 * std::abs(strength));
            ASSERT_NEAR(u.normal(i).y, 0, 1e-6);
            ASSERT_NEAR(v.normal(i).x, 0, 1e-6);
            ASSERT_NEAR(v.normal(i).y, -slope / length, 2e-5 * std::abs(strength));
            ASSERT_NEAR(v.normal(i).z, 1 / length, 2e-5 * std::abs(strength));
        }
    }
}

} // namespace
} // namespace scanout::shade::test
