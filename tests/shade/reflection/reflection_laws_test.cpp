// Laws that reflection models keep, whatever their formula.
#include "shade/block.h"
#include "support/axes.h"
#include "support/lights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace scanout::shade::test {
namespace {

using scanout::test::directional;
using scene::ViewLight;

const scanout::test::Names& kModels = scanout::test::names_on("reflection");

scene::Material physical(float roughness, float metalness) {
    scene::Material m = scanout::test::plain(Vec3(1));
    m.roughness = roughness;
    m.metalness = metalness;
    return m;
}

// A block whose lanes look at one surface from these directions (unit, z > 0).
std::unique_ptr<ShadingBlock> seen_from(const scene::Material& material,
                                        const std::vector<DVec3>& eyes) {
    auto b = new_block(material);
    b->ambient = Vec3(0);
    b->count = static_cast<int>(eyes.size());
    for (std::size_t i = 0; i < eyes.size(); ++i) {
        b->ray_x[i] = static_cast<float>(-eyes[i].x / eyes[i].z);
        b->ray_y[i] = static_cast<float>(-eyes[i].y / eyes[i].z);
    }
    return b;
}

void set_albedo(ShadingBlock& b, float albedo) {
    for (auto& channel : b.albedo)
        std::fill_n(channel, kPaddedBlock, albedo);
}

DVec3 at_angles(double theta, double phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// Light of the same brightness from all sides: how much of it each lane sends to its eye. A light
// of colour c brings c pi of irradiance, so dw / pi of it stands for the solid angle dw.
std::vector<double> reflected(std::string_view model, const scene::Material& material,
                              const std::vector<DVec3>& eyes, float albedo) {
    constexpr int kRings = 192, kAround = 384;
    auto b = seen_from(material, eyes);
    set_albedo(*b, albedo);
    FrameState frame = identity_frame();
    std::vector<double> sum(eyes.size(), 0.0);
    for (int ring = 0; ring < kRings; ++ring) {
        std::vector<ViewLight> lights;
        // Rings of equal angle: narrow where a grazing highlight is.
        const double low = std::numbers::pi / 2 * ring / kRings,
                     high = std::numbers::pi / 2 * (ring + 1) / kRings;
        const double share = (std::cos(low) - std::cos(high)) * 2 / kAround;
        for (int k = 0; k < kAround; ++k)
            lights.push_back(
                directional(Vec3(at_angles((low + high) / 2, 2 * std::numbers::pi * k / kAround)),
                            Vec3(static_cast<float>(share))));
        frame.lights = lights;
        stage("reflection", model).run(*b, frame);
        for (std::size_t i = 0; i < eyes.size(); ++i)
            sum[i] += static_cast<double>(b->colour[0][i]);
    }
    return sum;
}

// From straight on to two degrees above the surface.
std::vector<DVec3> hundred_directions() {
    std::vector<DVec3> eyes;
    for (int i = 0; i < 100; ++i)
        eyes.push_back(at_angles(88.0 / 99 * i * std::numbers::pi / 180, 2.4 * i));
    return eyes;
}

void expect_no_gain(std::string_view model, const scene::Material& material, float albedo,
                    const std::string& what) {
    const std::vector<double> out = reflected(model, material, hundred_directions(), albedo);
    double most = 0;
    for (std::size_t i = 0; i < out.size(); ++i) {
        EXPECT_LE(out[i], 1.002) << what << ", direction " << i;
        EXPECT_GE(out[i], 0) << what;
        most = std::max(most, out[i]);
    }
    EXPECT_GT(most, 0.3) << what << ": too dark to mean anything";
}

TEST(ReflectionLaws, NormalisedBlinnPhongNeverGainsEnergyAndKeepsAllStraightOn) {
    for (const float ns : {0.5F, 1.0F, 3.0F, 10.0F, 40.0F, 200.0F}) {
        const scene::Material m = scanout::test::plain(Vec3(0), Vec3(1), ns);
        expect_no_gain("blinn_phong_normalised", m, 0, "Ns " + std::to_string(ns));
        const double all = std::min(double{ns}, 1.0); // below 1 it fades
        EXPECT_NEAR(reflected("blinn_phong_normalised", m, {{0, 0, 1}}, 0)[0], all, 2e-3) << ns;
        // What is scattered and what is mirrored share the light.
        const scene::Material half = scanout::test::plain(Vec3(0.5F), Vec3(0.5F), ns);
        expect_no_gain("blinn_phong_normalised", half, 0.5F, "half, Ns " + std::to_string(ns));
    }
}

TEST(ReflectionLaws, GgxNeverGainsEnergy) {
    for (const float roughness : {0.3F, 0.5F, 0.8F, 1.0F})
        for (const float metalness : {0.0F, 0.5F, 1.0F})
            expect_no_gain("ggx", physical(roughness, metalness), 1,
                           "Pr " + std::to_string(roughness) + " Pm " + std::to_string(metalness));
    for (const float ks : {0.04F, 0.5F, 1.0F})
        for (const float ns : {2.0F, 30.0F})
            expect_no_gain("ggx", scanout::test::plain(Vec3(1), Vec3(ks), ns), 1,
                           "Ks " + std::to_string(ks) + " Ns " + std::to_string(ns));
}

TEST(ReflectionLaws, LambertKeepsTheLightThatArrives) {
    for (const double out : reflected("lambert", scene::Material(), hundred_directions(), 1))
        EXPECT_NEAR(out, 1, 1e-3);
}

// What one light brings from `light` to `eye` by run(block, frame), without the albedo's part.
template <class Run>
double lit_by(const scene::Material& material, const DVec3& light, const DVec3& eye, float albedo,
              const Run& run) {
    auto b = seen_from(material, {eye});
    set_albedo(*b, albedo);
    FrameState frame = identity_frame();
    const std::vector<ViewLight> lights = {directional(Vec3(light))};
    frame.lights = lights;
    run(*b, frame);
    return static_cast<double>(b->colour[1][0]);
}
double highlight(std::string_view model, const scene::Material& material, const DVec3& light,
                 const DVec3& eye, float albedo = 0) {
    return lit_by(material, light, eye, albedo, [&](ShadingBlock& b, const FrameState& frame) {
        run_stage("reflection", model, b, frame);
    });
}

// Of models whose lobe is a power: straight into the mirror's image its cosine rounds to more than
// 1, which a power would make more of; and of no number it makes nothing.
TEST(ReflectionLaws, PowersOfCosinesAreSharesOfTheLight) {
    Random random(2);
    const scene::Material sharp = scanout::test::plain(Vec3(0), Vec3(1), 10000);
    for (const std::string_view model : {"phong", "blinn_phong"}) {
        double brightest = 0;
        for (int round = 0; round < 1000; ++round) {
            const DVec3 way = at_angles(random.in(0, 1.5), random.in(0, 6.3));
            auto b = seen_from(sharp, {way});
            set_albedo(*b, 0);
            for (int c = 0; c < 3; ++c)
                b->normal[c][0] = static_cast<float>(way[c]);
            FrameState frame = identity_frame();
            const std::vector<ViewLight> lights = {directional(Vec3(way))};
            frame.lights = lights;
            run_stage("reflection", model, *b, frame);
            brightest = std::max(brightest, double{b->colour[1][0]});
            b->normal[1][0] = std::numeric_limits<float>::quiet_NaN();
            stage("reflection", model).run(*b, frame);
            EXPECT_EQ(b->colour[1][0], 0) << model;
        }
        EXPECT_EQ(brightest, 1) << model;
    }
}

TEST(ReflectionLaws, LightAndEyeMayChangePlaces) {
    Random random(1);
    for (int round = 0; round < 300; ++round) {
        const auto direction = [&] { return at_angles(random.in(0, 1.5), random.in(0, 6.3)); };
        const DVec3 l = direction(), e = direction();
        const scene::Material shiny = scanout::test::plain(Vec3(1), Vec3(0.7F), 12);
        const auto both = [&](std::string_view model, const scene::Material& m, double there,
                              double back, float albedo) {
            const double a = highlight(model, m, l, e, albedo) * there,
                         b = highlight(model, m, e, l, albedo) * back;
            EXPECT_NEAR(a, b, 1e-5 + 1e-4 * std::abs(a)) << model << ' ' << round;
        };
        // MTL's highlights leave the cosine of the light out; the others have it.
        both("phong", shiny, 1, 1, 0);
        both("blinn_phong", shiny, 1, 1, 0);
        both("blinn_phong_normalised", shiny, e.z, l.z, 1);
        both("ggx", shiny, e.z, l.z, 1);
        both("ggx", physical(0.6F, 0.3F), e.z, l.z, 0.8F);
        both("lambert", shiny, e.z, l.z, 1);
    }
}

TEST(ReflectionLaws, PhongsAngleIsTwiceBlinns) {
    // Light, normal and eye in one plane.
    const scene::Material m = scanout::test::plain(Vec3(1), Vec3(1), 3);
    int seen = 0;
    for (double l = -70; l <= 70; l += 5) {
        for (double e = -70; e <= 70; e += 5) {
            const double half = (l + e) / 2 * std::numbers::pi / 180;
            const DVec3 light = at_angles(l * std::numbers::pi / 180, 0.4),
                        eye = at_angles(e * std::numbers::pi / 180, 0.4);
            EXPECT_NEAR(highlight("blinn_phong", m, light, eye), std::pow(std::cos(half), 3), 1e-5);
            EXPECT_NEAR(highlight("phong", m, light, eye),
                        std::pow(std::max(std::cos(2 * half), 0.0), 3), 1e-5);
            ++seen;
        }
    }
    EXPECT_EQ(seen, 29 * 29);
}

TEST(ReflectionLaws, HighlightsFallOnlyWhereLightDoes) {
    const scene::Material m = scanout::test::plain(Vec3(1), Vec3(1), 0.5F);
    const DVec3 above = at_angles(1.5, 0), below = at_angles(1.6, 0), eye = at_angles(1.4, 3.1);
    for (const char* model : {"phong", "blinn_phong", "blinn_phong_normalised", "toon", "ggx"}) {
        EXPECT_GT(highlight(model, m, above, eye), 0) << model;
        EXPECT_EQ(highlight(model, m, below, eye), 0) << model;
    }
}

TEST(ReflectionLaws, NormalisedIsTheFactorTimesTheCosineTimesMtls) {
    Random random(2);
    for (const float ns : {1.0F, 20.0F, 300.0F}) {
        const scene::Material m = scanout::test::plain(Vec3(1), Vec3(0.8F), ns);
        const double factor = (ns + 2) * (ns + 4) / (8 * (std::exp2(-ns / 2) + ns));
        for (int round = 0; round < 50; ++round) {
            const DVec3 l = at_angles(random.in(0, 1.5), random.in(0, 6.3)),
                        e = at_angles(random.in(0, 1.5), random.in(0, 6.3));
            const double wanted = highlight("blinn_phong", m, l, e) * factor * l.z;
            EXPECT_NEAR(highlight("blinn_phong_normalised", m, l, e), wanted, 1e-6 + wanted * 1e-5);
        }
    }
}

// The formula from the papers, in double.
double ggx(double n_l, double n_e, double n_h, double e_h, double alpha, double f0, double albedo,
           double metal) {
    const double a2 = alpha * alpha, pi = std::numbers::pi;
    const double d = a2 / (pi * std::pow(n_h * n_h * (a2 - 1) + 1, 2));
    const double v = 0.5 / (n_l * std::sqrt(n_e * n_e * (1 - a2) + a2) +
                            n_e * std::sqrt(n_l * n_l * (1 - a2) + a2));
    const auto fresnel = [](double f, double x) { return f + (1 - f) * std::pow(1 - x, 5); };
    const double scattered = albedo / pi * (1 - fresnel(f0, n_l)) * (1 - fresnel(f0, n_e));
    return pi * n_l *
           ((1 - metal) * (scattered + fresnel(f0, e_h) * d * v) +
            metal * fresnel(albedo, e_h) * d * v);
}

TEST(ReflectionLaws, GgxIsTheFormula) {
    Random random(3);
    for (int round = 0; round < 1000; ++round) {
        const DVec3 l = at_angles(random.in(0, 1.5), random.in(0, 6.3)),
                    e = at_angles(random.in(0, 1.5), random.in(0, 6.3));
        const DVec3 h = (l + e) / std::sqrt(dot3(l + e, l + e));
        const auto roughness = static_cast<float>(random.in(0.15, 1)),
                   metal = static_cast<float>(random.in(0, 1)),
                   albedo = static_cast<float>(random.in(0, 1));
        const double wanted =
            ggx(l.z, e.z, h.z, dot3(e, h), double{roughness} * roughness, 0.04, albedo, metal);
        EXPECT_NEAR(highlight("ggx", physical(roughness, metal), l, e, albedo), wanted,
                    1e-5 + 3e-4 * wanted);
        // Of a material of Ks and Ns.
        const auto ns = static_cast<float>(random.in(1, 200));
        const scene::Material shiny = scanout::test::plain(Vec3(1), Vec3(0.3F), ns);
        const double other = ggx(l.z, e.z, h.z, dot3(e, h), std::sqrt(2 / (double{ns} + 2)),
                                 double{0.3F}, albedo, 0);
        EXPECT_NEAR(highlight("ggx", shiny, l, e, albedo), other, 1e-5 + 3e-4 * other);
    }
}

TEST(ReflectionLaws, ToonHasThreeTonesAndAHighlightThatIsThereOrNot) {
    for (int degrees = 0; degrees <= 120; ++degrees) {
        const double cosine = std::cos((degrees + 0.5) * std::numbers::pi / 180);
        const DVec3 light = at_angles((degrees + 0.5) * std::numbers::pi / 180, 1);
        const double tone = cosine <= 0 ? 0 : (std::floor(cosine * 3) + 0.5) / 3;
        EXPECT_NEAR(highlight("toon", scene::Material(), light, {0, 0, 1}, 1), tone, 1e-6)
            << degrees;
        // Seen straight on, the half vector leans by half of the light's angle.
        const double lobe = std::pow(std::cos((degrees + 0.5) / 2 * std::numbers::pi / 180), 20);
        EXPECT_NEAR(highlight("toon", scanout::test::plain(Vec3(0), Vec3(1), 20), light, {0, 0, 1}),
                    cosine > 0 && lobe >= 0.5 ? 1 : 0, 1e-6)
            << degrees;
    }
}

TEST(ReflectionLaws, EveryModelIsLinearInTheAlbedo) {
    Random random(4);
    const scene::Material shiny = scanout::test::plain(Vec3(1), Vec3(0.4F), 25);
    for (const std::string& model : kModels) {
        for (int round = 0; round < 100; ++round) {
            const DVec3 l = at_angles(random.in(0, 1.5), random.in(0, 6.3)),
                        e = at_angles(random.in(0, 1.5), random.in(0, 6.3));
            for (const scene::Material& m : {shiny, physical(0.5F, 0.6F)}) {
                const double plain = highlight(model, m, l, e, 0),
                             white = highlight(model, m, l, e, 1),
                             grey = highlight(model, m, l, e, 0.25F);
                EXPECT_NEAR(grey, plain + 0.25 * (white - plain), 1e-5 * (1 + white)) << model;
            }
        }
    }
}

// Or as the model's own way on matt surfaces.
TEST(ReflectionLaws, NoHighlightIsLambertToTheBit) {
    Random random(5);
    const Vec3 black(0), white(1);
    for (const ReflectionStage* row : shade::reflection::kRows) {
        const std::string_view model = row->card.name;
        const Stage& matt = row->matt != nullptr ? *row->matt : shade::reflection::lambert;
        for (const auto& [ks, ns] : {std::pair{black, 50.0F}, {white, 0.0F}}) {
            const scene::Material m = scanout::test::plain(Vec3(1), ks, ns);
            for (int round = 0; round < 20; ++round) {
                const DVec3 l = at_angles(random.in(0, 2), random.in(0, 6.3)),
                            e = at_angles(random.in(0, 1.5), random.in(0, 6.3));
                EXPECT_EQ(highlight(model, m, l, e, 0.7F), lit_by(m, l, e, 0.7F, matt.run))
                    << model;
            }
        }
    }
}

TEST(ReflectionLaws, WhatIsWildStaysFinite) {
    for (const std::string& model : kModels) {
        for (const scene::Material& m :
             {scanout::test::plain(Vec3(1), Vec3(1e6F), 1e6F), physical(0, 1), physical(1, 0),
              physical(0, 0), scanout::test::plain(Vec3(1), Vec3(1), 1e-30F)}) {
            auto b = new_block(m);
            // Normals that are too short, that vanish, that look away from the eye; the light
            // straight on, grazing, behind, and straight into the eye.
            for (int i = 0; i < kBlockSize; ++i) {
                b->normal[2][i] = i % 4 == 0 ? 0.0F : (i % 4 == 1 ? 0.01F : (i % 4 == 2 ? -1 : 1));
                b->ray_x[i] = i % 3 == 0 ? 1e6F : 0.0F;
            }
            FrameState frame = identity_frame();
            const std::vector<ViewLight> lights = {
                directional({0, 0, 1}, Vec3(1e4F)), directional({1, 0, 0}, Vec3(1e4F)),
                directional({0, 0, -1}, Vec3(1e4F)), directional({0.6F, 0, -0.8F}, Vec3(1e4F))};
            frame.lights = lights;
            run_stage("reflection", model, *b, frame);
            for (int i = 0; i < kBlockSize; ++i)
                for (int c = 0; c < 3; ++c)
                    ASSERT_TRUE(std::isfinite(b->colour[c][i])) << model << ' ' << i;
        }
    }
}

} // namespace
} // namespace scanout::shade::test
