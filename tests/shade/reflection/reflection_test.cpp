#include "rows.h"
#include "shade/block.h"
#include "support/lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

namespace scanout::shade::test {
namespace {

// MTL's illum 2, with ambient light of 0.15:
// 0.15 Kd + sum over lights before the surface (Kd n.l + Ks max(n.h, 0)^Ns).
double formula(const ShadingBlock& b, int i, int channel, std::span<const scene::ViewLight> lights,
               bool orthographic, bool highlight) {
    const double n[3] = {b.normal[0][i], b.normal[1][i], b.normal[2][i]};
    const double ray[3] = {orthographic ? 0 : b.ray_x[i], orthographic ? 0 : b.ray_y[i], -1};
    const double length = std::sqrt(ray[0] * ray[0] + ray[1] * ray[1] + 1);
    double colour = 0.15 * b.albedo[channel][i];
    for (const scene::ViewLight& light : lights) {
        double n_l = 0, n_h = 0, h_h = 0;
        for (int k = 0; k < 3; ++k) {
            const double l = light.towards[k], h = l - ray[k] / length;
            n_l += n[k] * l;
            n_h += n[k] * h;
            h_h += h * h;
        }
        colour +=
            static_cast<double>(light.colour[channel]) * b.albedo[channel][i] * std::max(n_l, 0.0);
        const double ns = static_cast<double>(b.material->shininess);
        if (highlight && h_h > 0 && n_h > 0 && n_l > 0)
            colour += static_cast<double>(light.colour[channel]) * b.material->specular[channel] *
                      std::min(ns, 1.0) * std::pow(n_h / std::sqrt(h_h), std::max(ns, 1.0));
    }
    return colour;
}

void randomise(ShadingBlock& b, Random& random) {
    for (int i = 0; i < kBlockSize; ++i) {
        DVec3 n = random.in_cube(1);
        const double length = std::sqrt(dot3(n, n));
        for (int k = 0; k < 3; ++k) {
            b.normal[k][i] = static_cast<float>(n[k] / length);
            b.albedo[k][i] = static_cast<float>(random.in(0, 1));
        }
        b.ray_x[i] = static_cast<float>(random.in(-1, 1));
        b.ray_y[i] = static_cast<float>(random.in(-1, 1));
    }
}

double worst_error(std::string_view name, float shininess, bool orthographic, std::uint64_t seed) {
    Random random(seed);
    const scene::Material material =
        scanout::test::plain(Vec3(1), Vec3(0.3F, 0.9F, 0.5F), shininess);
    auto b = new_block(material);
    FrameState frame = identity_frame();
    frame.orthographic = orthographic;
    double worst = 0;
    for (int round = 0; round < 1000; ++round) {
        // The default lights, and any others.
        std::vector<scene::ViewLight> lights = scanout::test::key_and_fill();
        if (round % 2 == 1) {
            for (scene::ViewLight& light : lights) {
                const DVec3 l = random.in_cube(1);
                light.towards = Vec3(l / std::sqrt(dot3(l, l)));
            }
        }
        frame.lights = lights;
        randomise(*b, random);
        run_stage("reflection", name, *b, frame);
        for (int i = 0; i < kBlockSize; ++i)
            for (int c = 0; c < 3; ++c)
                worst = std::max(worst,
                                 std::abs(b->colour[c][i] - formula(*b, i, c, lights, orthographic,
                                                                    name != "lambert")));
    }
    return worst;
}

TEST(Reflection, LambertIsTheFormula) {
    const double worst = worst_error("lambert", 20, false, 1);
    EXPECT_LE(worst, 1e-5);
    RecordProperty("worst", testing::PrintToString(worst));
}

TEST(Reflection, BlinnPhongIsTheFormula) {
    for (const float shininess : {0.5F, 1.0F, 2.0F, 20.0F, 100.0F}) {
        for (const bool orthographic : {false, true}) {
            const double worst = worst_error("blinn_phong", shininess, orthographic, 2);
            EXPECT_LE(worst, 1e-5) << shininess;
            RecordProperty("worst_" + std::to_string(static_cast<int>(shininess)) +
                               (orthographic ? "_orthographic" : ""),
                           testing::PrintToString(worst));
        }
    }
    // cos^Ns turns an error of the cosine into Ns times as much: half an ulp of 1 at Ns 1000.
    const double sharp = worst_error("blinn_phong", 1000, false, 3);
    EXPECT_LE(sharp, 1e-4);
    RecordProperty("worst_1000", testing::PrintToString(sharp));
}

// Of Ns to 0 the limit is Ns 0: no highlight. ggx has mirrors or none.
TEST(Reflection, AHighlightFadesAsNsGoesTo0AndNothingJumps) {
    for (const char* model : {"phong", "blinn_phong", "blinn_phong_normalised"}) {
        Random random(7);
        const scene::Material none = scanout::test::plain(Vec3(1), Vec3(1), 0);
        auto base = new_block(none);
        FrameState frame = identity_frame();
        frame.lights = scanout::test::key_and_fill();
        randomise(*base, random);
        const auto shaded = [&](float ns) {
            const scene::Material material = scanout::test::plain(Vec3(1), Vec3(1), ns);
            auto b = new_block(material);
            *b = *base;
            b->material = &material;
            run_stage("reflection", model, *b, frame);
            std::array<double, std::size_t{3} * kBlockSize> colours{};
            for (std::size_t i = 0; i < colours.size(); ++i)
                colours[i] = double{b->colour[i % 3][i / 3]};
            return colours;
        };
        constexpr float kStep = 0.01F;
        auto before = shaded(0);
        for (float ns = kStep * 0.01F; ns < 2; ns += kStep) {
            const auto now = shaded(ns);
            for (std::size_t i = 0; i < now.size(); ++i)
                EXPECT_NEAR(now[i], before[i], 4 * double{kStep}) << model << " " << ns;
            before = now;
        }
    }
}

TEST(Reflection, WithoutAHighlightBlinnPhongIsLambertToTheBit) {
    Random random(4);
    const Vec3 black(0), white(1);
    for (const auto& [ks, ns] : {std::pair{black, 50.0F}, {white, 0.0F}}) {
        const scene::Material material = scanout::test::plain(Vec3(1), ks, ns);
        auto matt = new_block(material), glossy = new_block(material);
        FrameState frame = identity_frame();
        frame.lights = scanout::test::key_and_fill();
        randomise(*matt, random);
        *glossy = *matt;
        run_stage("reflection", "lambert", *matt, frame);
        run_stage("reflection", "blinn_phong", *glossy, frame);
        for (int i = 0; i < kBlockSize; ++i)
            for (int c = 0; c < 3; ++c)
                ASSERT_EQ(matt->colour[c][i], glossy->colour[c][i]);
    }
}

TEST(Reflection, LinesAndPointsKeepTheirPlainColour) {
    Random random(5);
    const scene::Material material = scanout::test::plain(Vec3(1), Vec3(1), 10);
    FrameState frame = identity_frame();
    frame.lights = scanout::test::key_and_fill();
    for (const char* name : {"lambert", "phong", "blinn_phong", "blinn_phong_normalised", "ggx"}) {
        auto b = new_block(material);
        randomise(*b, random);
        b->lit = false;
        run_stage("reflection", name, *b, frame);
        for (int i = 0; i < kBlockSize; ++i)
            for (int c = 0; c < 3; ++c)
                ASSERT_EQ(b->colour[c][i], b->albedo[c][i]);
    }
}

TEST(Reflection, ALaneDoesNotDependOnItsPlaceOrOnTheOthers) {
    Random random(6);
    const scene::Material material = scanout::test::plain(Vec3(1), Vec3(0.7F), 30);
    FrameState frame = identity_frame();
    frame.lights = scanout::test::key_and_fill();
    for (const char* name : {"lambert", "phong", "blinn_phong", "blinn_phong_normalised", "ggx"}) {
        auto whole = new_block(material);
        randomise(*whole, random);
        auto one = new_block(material);
        run_stage("reflection", name, *whole, frame);
        for (int i = 0; i < kBlockSize; ++i) {
            one->count = 1 + i % 20;
            const int to = i % one->count;
            for (int c = 0; c < 3; ++c) {
                one->normal[c][to] = whole->normal[c][i];
                one->albedo[c][to] = whole->albedo[c][i];
            }
            one->ray_x[to] = whole->ray_x[i];
            one->ray_y[to] = whole->ray_y[i];
            run_stage("reflection", name, *one, frame);
            for (int c = 0; c < 3; ++c)
                ASSERT_EQ(one->colour[c][to], whole->colour[c][i]) << name << ' ' << i;
        }
    }
}

TEST(Reflection, ALightThatShinesIntoTheEyeIsFinite) {
    const scene::Material material = scanout::test::plain(Vec3(1), Vec3(1), 10);
    auto b = new_block(material);
    const scene::ViewLight behind[] = {scanout::test::directional({0, 0, -1})};
    FrameState frame = identity_frame();
    frame.lights = behind;
    run_stage("reflection", "blinn_phong", *b, frame);
    for (int i = 0; i < kBlockSize; ++i)
        EXPECT_EQ(b->colour[0][i], scene::kAmbient);
}

TEST(DefaultLights, AreUnitAndInFrontOfTheModel) {
    for (const scene::ViewLight& light : scanout::test::key_and_fill()) {
        const DVec3 l(light.towards);
        EXPECT_NEAR(dot3(l, l), 1, 1e-6);
        EXPECT_GT(l.z, 0.25);
    }
    // The key comes from above left, the fill from the right.
    EXPECT_LT(scanout::test::key_and_fill()[0].towards.x, 0);
    EXPECT_GT(scanout::test::key_and_fill()[0].towards.y, 0);
    EXPECT_GT(scanout::test::key_and_fill()[1].towards.x, 0);
}

TEST(Catalogue, FindsEveryStageAndFilterByItsNameAlone) {
    for (const Stage* stage : stages())
        EXPECT_EQ(find_stage(stage->card.axis, stage->card.name), stage) << stage->card.name;
    for (const Filter* filter : shade::texture::kRows)
        EXPECT_EQ(find_row(shade::texture::kRows, filter->card.name), filter) << filter->card.name;
    EXPECT_EQ(find_stage("texture", "lambert"), nullptr);
    EXPECT_EQ(find_stage("reflection", ""), nullptr);
    EXPECT_EQ(find_stage("", "lambert"), nullptr);
    EXPECT_EQ(find_row(shade::texture::kRows, "lambert"), nullptr);
}

} // namespace
} // namespace scanout::shade::test
