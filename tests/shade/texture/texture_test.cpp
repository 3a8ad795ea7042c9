#include "texture_sampler.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <set>

namespace scanout::shade::test {
namespace {

TEST(Texture, AConstantOneStaysConstantUnderEveryFilter) {
    Random random(1);
    for (const std::string& filter : filters()) {
        for (const Wrap wrap : kWraps) {
            const scene::Texture grey{"grey", image::Image(5, 3, {100, 200, 7, 255})};
            Sampler sampler(grey, wrap);
            const Vec3 first = sampler.one(filter, 0.5F, 0.5F);
            EXPECT_NEAR(first.x, scanout::test::decoded(100), 1e-7);
            EXPECT_NEAR(first.y, scanout::test::decoded(200), 1e-7);
            EXPECT_NEAR(first.z, scanout::test::decoded(7), 1e-7);
            for (const double size : {0.1, 2.0, 1e5, 1e30}) {
                sampler.set_random_slopes(random);
                sampler.sample(filter, random_uv(random, size));
                for (int i = 0; i < kBlockSize; ++i)
                    for (int c = 0; c < 3; ++c)
                        ASSERT_EQ(sampler.block->albedo[c][i], first[c]) << filter << ' ' << size;
            }
        }
    }
}

TEST(Texture, NearestGivesExactlyTheTexelThatTheSampleFallsInto) {
    Random random(2);
    const scene::Texture texture = noise(13, 7, 3);
    for (const bool clamp : {false, true}) {
        Sampler sampler(texture, clamp ? Wrap::clamp : Wrap::repeat);
        for (int round = 0; round < 2000; ++round) {
            const std::vector<Vec2> uv = random_uv(random, round % 2 == 0 ? 1 : 3);
            sampler.sample("nearest", uv);
            for (int i = 0; i < kBlockSize; ++i) {
                const auto texel = [&](double t, int size) {
                    if (clamp) t = std::min(std::max(t, 0.0), 1.0);
                    t = (t - std::floor(t) == 0 && clamp && t == 1 ? 1 : t - std::floor(t)) * size;
                    // Too near to a border to say, in float.
                    if (std::abs(t - std::round(t)) < 1e-5 && t != 0 && t != size) return -1;
                    return std::min(static_cast<int>(std::floor(t)), size - 1);
                };
                const Vec2& at = uv[static_cast<std::size_t>(i)];
                const int x = texel(at.x, 13), y = texel(at.y, 7);
                if (x < 0 || y < 0) continue;
                const image::Rgba8 expected = texture.image.at(x, 6 - y); // v runs up
                ASSERT_NEAR(sampler.block->albedo[0][i], scanout::test::decoded(expected.r), 1e-7);
                ASSERT_NEAR(sampler.block->albedo[1][i], scanout::test::decoded(expected.g), 1e-7);
                ASSERT_NEAR(sampler.block->albedo[2][i], scanout::test::decoded(expected.b), 1e-7);
            }
        }
    }
}

TEST(Texture, NearestGivesOnlyValuesThatTheTextureHas) {
    Random random(3);
    const scene::Texture texture = noise(16, 16, 4);
    std::set<float> red;
    for (const image::Rgba8& p : texture.image.pixels())
        red.insert(static_cast<float>(scanout::test::decoded(p.r)));
    Sampler sampler(texture);
    for (int round = 0; round < 4000; ++round) {
        sampler.sample("nearest", random_uv(random, std::exp2(random.in(-10, 100))));
        for (int i = 0; i < kBlockSize; ++i)
            ASSERT_TRUE(red.count(sampler.block->albedo[0][i]) == 1);
    }
}

TEST(Texture, BilinearIsTheOverlapOfATexelSizedSquare) {
    Random random(4);
    const scene::Texture texture = noise(8, 4, 5);
    double worst = 0;
    for (const bool clamp : {false, true}) {
        Sampler sampler(texture, clamp ? Wrap::clamp : Wrap::repeat);
        for (int round = 0; round < 4000; ++round) {
            const std::vector<Vec2> uv = random_uv(random, 1.5);
            sampler.sample("bilinear", uv);
            for (int i = 0; i < kBlockSize; ++i) {
                const Vec2& at = uv[static_cast<std::size_t>(i)];
                const double u = clamp ? std::min(std::max<double>(at.x, 0), 1.0) : at.x,
                             v = clamp ? std::min(std::max<double>(at.y, 0), 1.0) : at.y;
                const double x = u * 8 - 0.5, y = v * 4 - 0.5;
                double sum = 0, low = 1, high = 0;
                for (int j = 0; j < 2; ++j) {
                    for (int k = 0; k < 2; ++k) {
                        const int tx = static_cast<int>(std::floor(x)) + k,
                                  ty = static_cast<int>(std::floor(y)) + j;
                        const auto address = [&](int t, int size) {
                            return clamp ? std::min(std::max(t, 0), size - 1)
                                         : ((t % size) + size) % size;
                        };
                        const double texel = scanout::test::decoded(
                            texture.image.at(address(tx, 8), 3 - address(ty, 4)).g);
                        sum += texel * (1 - std::abs(x - tx)) * (1 - std::abs(y - ty));
                        low = std::min(low, texel);
                        high = std::max(high, texel);
                    }
                }
                const double got = sampler.block->albedo[1][i];
                worst = std::max(worst, std::abs(got - sum));
                ASSERT_GE(got, low * (1 - 0x1p-22));
                ASSERT_LE(got, high * (1 + 0x1p-22));
            }
        }
    }
    EXPECT_LE(worst, 4e-6); // half a texel's 2^-21 of the coordinate, times the steepest step
    RecordProperty("worst", testing::PrintToString(worst));
}

TEST(Texture, BilinearStaysWithinItsTexelsAndIsExactAtTheirCentres) {
    Random random(5);
    const scene::Texture texture = noise(16, 8, 6);
    Sampler sampler(texture);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x)
            EXPECT_NEAR(sampler
                            .one("bilinear", (static_cast<float>(x) + 0.5F) / 16,
                                 (static_cast<float>(y) + 0.5F) / 8)
                            .x,
                        scanout::test::decoded(texture.image.at(x, 7 - y).r), 1e-7);
    float low = 1, high = 0;
    for (const image::Rgba8& p : texture.image.pixels()) {
        low = std::min(low, static_cast<float>(scanout::test::decoded(p.b)));
        high = std::max(high, static_cast<float>(scanout::test::decoded(p.b)));
    }
    for (int round = 0; round < 8000; ++round) { // a million samples
        sampler.sample("bilinear", random_uv(random, std::exp2(random.in(-10, 60))));
        for (int i = 0; i < kBlockSize; ++i) {
            ASSERT_GE(sampler.block->albedo[2][i], low * (1 - 0x1p-23F));
            ASSERT_LE(sampler.block->albedo[2][i], high * (1 + 0x1p-23F));
        }
    }
}

// Keys' convolution with a = -1/2, in double and by its definition; held within the inner texels.
double keys(double x) {
    x = std::abs(x);
    if (x < 1) return (1.5 * x - 2.5) * x * x + 1;
    return x < 2 ? ((-0.5 * x + 2.5) * x - 4) * x + 2 : 0;
}

TEST(Texture, BicubicIsKeysConvolutionHeldWithinItsTexels) {
    Random random(21);
    const scene::Texture texture = noise(8, 4, 22);
    Sampler sampler(texture);
    double worst = 0;
    int held = 0;
    for (int round = 0; round < 400; ++round) {
        const std::vector<Vec2> uv = random_uv(random, 1.5);
        sampler.sample("bicubic", uv);
        for (int i = 0; i < kBlockSize; ++i) {
            const Vec2& at = uv[static_cast<std::size_t>(i)];
            const double x = double{at.x} * 8 - 0.5, y = double{at.y} * 4 - 0.5;
            double sum = 0, low = 1, high = 0;
            for (int j = -1; j <= 2; ++j)
                for (int k = -1; k <= 2; ++k) {
                    const int tx = static_cast<int>(std::floor(x)) + k,
                              ty = static_cast<int>(std::floor(y)) + j;
                    const auto wrapped = [](int t, int size) { return (t % size + size) % size; };
                    const double texel = scanout::test::decoded(
                        texture.image.at(wrapped(tx, 8), 3 - wrapped(ty, 4)).g);
                    sum += texel * keys(x - tx) * keys(y - ty);
                    if (j < 0 || j > 1 || k < 0 || k > 1) continue;
                    low = std::min(low, texel);
                    high = std::max(high, texel);
                }
            held += sum < low || sum > high ? 1 : 0;
            const double got = sampler.block->albedo[1][i];
            worst = std::max(worst, std::abs(got - std::clamp(sum, low, high)));
        }
    }
    EXPECT_LE(worst, 1e-5);
    EXPECT_GT(held, 1000) << "the spline overshoots, which is what the bounds are for";
}

TEST(Texture, CoordinatesWithoutSenseReadATexelOfTheTexture) {
    // One row: texel i has the value i. A run under the address sanitizer sees every other read.
    scene::Texture row{"row", image::Image(4, 1)};
    for (int x = 0; x < 4; ++x)
        row.image.at(x, 0) = {static_cast<std::uint8_t>(x + 1), 0, 0, 255};
    struct Case {
        float u;
        int repeat, clamp;
    };
    const float before_0 = -std::numeric_limits<float>::denorm_min();
    const Case cases[] = {
        {0, 0, 0},          {-0.0F, 0, 0},    {1, 0, 3},      {0.9999999F, 3, 3}, {0.25F, 1, 1},
        {-0.25F, 3, 0},     {-1, 0, 0},       {2, 0, 3},      {kNaNTexel, 0, 0},  {kInfTexel, 0, 3},
        {-kInfTexel, 0, 0}, {1e30F, 0, 3},    {-1e30F, 0, 0}, {before_0, 0, 0},   {1e9F, 0, 3},
        {-1e-9F, 0, 0},     {100000.5F, 2, 3}};
    for (const Case& c : cases) {
        for (const bool clamp : {false, true}) {
            Sampler sampler(row, clamp ? Wrap::clamp : Wrap::repeat);
            const int expected = clamp ? c.clamp : c.repeat;
            EXPECT_NEAR(sampler.one("nearest", c.u, 0.5F).x, scanout::test::decoded(expected + 1),
                        1e-9)
                << c.u << (clamp ? " clamped" : " repeated");
            const float filtered = sampler.one("bilinear", c.u, c.u).x;
            EXPECT_TRUE(filtered >=
                            static_cast<float>(scanout::test::decoded(1)) * (1 - 0x1p-22F) &&
                        filtered <= static_cast<float>(scanout::test::decoded(4)) * (1 + 0x1p-22F))
                << c.u << ": " << filtered;
            EXPECT_FALSE(std::isnan(sampler.one("bilinear", 0.3F, c.u).x));
        }
    }
}

// HARD-CASES 37
TEST(Texture, AnyBitsAreCoordinatesOfTexelsInAnyMap) {
    // A run under the address sanitizer sees every read outside the texture.
    Random random(8);
    const scene::Texture texture = noise(37, 19, 9);
    const auto any = [&] {
        return std::bit_cast<float>(static_cast<std::uint32_t>(random.bits()));
    };
    for (int round = 0; round < 2000; ++round) {
        Sampler sampler(texture, kWraps[round % 3]);
        if (round % 4 >= 2) {
            sampler.material.map_diffuse.edit().scale = {any(), any(), 1};
            sampler.material.map_diffuse.edit().offset = {any(), any(), 0};
        }
        std::vector<Vec2> uv(static_cast<std::size_t>(random.whole(1, kBlockSize)));
        for (Vec2& t : uv)
            t = {any(), any()};
        for (int i = 0; i < kBlockSize; ++i)
            sampler.set_slopes(i, {{any(), any()}, {any(), any()}});
        for (const std::string& filter : filters()) {
            sampler.sample(filter, uv);
            for (std::size_t i = 0; i < uv.size(); ++i)
                for (const auto& channel : sampler.block->albedo)
                    ASSERT_TRUE(channel[i] >= 0 && channel[i] <= 1) << filter << ' ' << channel[i];
        }
    }
}

TEST(Texture, TheLargestSidesHaveTheirTexelsInPlace) {
    constexpr int kSide = 16384;
    for (const bool wide : {true, false}) {
        scene::Texture strip{"strip", wide ? image::Image(kSide, 2) : image::Image(2, kSide)};
        for (int i = 0; i < kSide; ++i) {
            image::Rgba8& texel = wide ? strip.image.at(i, 1) : strip.image.at(1, kSide - 1 - i);
            texel = {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i >> 8), 0, 255};
        }
        for (const std::string& filter : filters()) {
            Sampler sampler(strip);
            for (int i = 0; i < kSide; i += 127) {
                const float along = (static_cast<float>(i) + 0.5F) / kSide;
                const Vec3 texel =
                    wide ? sampler.one(filter, along, 0.25F) : sampler.one(filter, 0.75F, along);
                ASSERT_NEAR(texel.x, scanout::test::decoded(i & 255), 1e-6) << filter << ' ' << i;
                ASSERT_NEAR(texel.y, scanout::test::decoded(i >> 8), 1e-6) << filter << ' ' << i;
            }
        }
    }
}

TEST(Texture, OfOneTexelIsReadEverywhere) {
    const scene::Texture dot{"dot", image::Image(1, 1, {77, 77, 77, 255})};
    Random random(6);
    for (const std::string& filter : filters())
        for (const Wrap wrap : kWraps) {
            Sampler sampler(dot, wrap);
            sampler.set_random_slopes(random);
            sampler.sample(filter, random_uv(random, 5));
            for (int i = 0; i < kBlockSize; ++i)
                ASSERT_NEAR(sampler.block->albedo[0][i], scanout::test::decoded(77), 1e-8);
        }
}

TEST(Texture, OffsetAndScaleOfTheMapMoveTheCoordinates) {
    const scene::Texture texture = noise(8, 8, 7);
    Sampler moved(texture), plain(texture);
    moved.material.map_diffuse.edit().scale = {2, 4, 1};
    moved.material.map_diffuse.edit().offset = {0.25F, -0.5F, 0};
    Random random(7);
    for (const Vec2& uv : random_uv(random, 2)) {
        const Vec2 x(random.in(-1, 1), random.in(-1, 1)), y(random.in(-1, 1), random.in(-1, 1));
        moved.set_slopes(0, {x, y});
        plain.set_slopes(0, {{x.x * 2, x.y * 4}, {y.x * 2, y.y * 4}});
        for (const std::string& filter : filters())
            EXPECT_EQ(moved.one(filter, uv.x, uv.y),
                      plain.one(filter, uv.x * 2 + 0.25F, uv.y * 4 - 0.5F));
    }
}

TEST(Texture, MirroredIsTheTurnedPictureInEverySecondTile) {
    Random random(15);
    const scene::Texture texture = noise(16, 8, 17);
    Sampler mirrored(texture, Wrap::mirror), clamped(texture, Wrap::clamp);
    const auto folded = [](float t) {
        const float turn = t - 2 * std::floor(t / 2);
        return turn > 1 ? 2 - turn : turn;
    };
    for (const char* filter : {"nearest", "bilinear", "trilinear"}) {
        for (const Vec2& uv : random_uv(random, 5))
            EXPECT_EQ(mirrored.one(filter, uv.x, uv.y),
                      clamped.one(filter, folded(uv.x), folded(uv.y)))
                << filter << ' ' << uv.x << ' ' << uv.y;
    }
    // 1 and -0 are edges; what has no place reads the corner.
    for (const float u : {kNaNTexel, kInfTexel, -kInfTexel, 1e30F, 0.0F, -0.0F, 2.0F, -2.0F})
        EXPECT_EQ(mirrored.one("nearest", u, u), mirrored.one("nearest", 0, 0)) << u;
    EXPECT_EQ(mirrored.one("nearest", 1, 1), mirrored.one("nearest", 0.9999F, 0.9999F));
}

TEST(Texture, AlphaIsReadAloneByEveryFilter) {
    Random random(16);
    image::Image image(8, 8);
    for (image::Rgba8& p : image.pixels())
        p = {9, 9, 9, static_cast<std::uint8_t>(random.bits())};
    image::Image grey(8, 8); // alpha is linear
    for (std::size_t i = 0; i < image.pixels().size(); ++i)
        grey.pixels()[i] = {image.pixels()[i].a, 0, 0, 255};
    const scene::Texture transparent{"transparent", image}, plain{"plain", grey};
    Sampler alpha(transparent), data(plain);
    data.chain = make_mip_chain(grey, TexelKind::data, Sampler::jobs());
    const std::vector<Vec2> uv = random_uv(random, 1);
    for (const Filter* filter : shade::texture::kRows) {
        for (int i = 0; i < kBlockSize; ++i) {
            const DVec3 x = random.in_cube(0.5), y = random.in_cube(0.5);
            const Slopes slopes{{x.x, x.y}, {y.x, y.y}};
            alpha.set_slopes(i, slopes);
            data.set_slopes(i, slopes);
            alpha.block->u[i] = data.block->u[i] = uv[static_cast<std::size_t>(i)].x;
            alpha.block->v[i] = data.block->v[i] = uv[static_cast<std::size_t>(i)].y;
        }
        filter->sample(*alpha.block, alpha.block->map[kDiffuseMap], TexelKind::alpha);
        filter->sample(*data.block, data.block->map[kDiffuseMap], TexelKind::data);
        for (int i = 0; i < kBlockSize; ++i)
            ASSERT_EQ(alpha.block->sampled[3][i], data.block->sampled[0][i]) << filter->card.name;
    }
}

TEST(Texture, MultipliesTheAlbedo) {
    const scene::Texture white{"white", image::Image(2, 2, {255, 255, 255, 255})};
    Sampler sampler(white);
    for (const std::string& filter : filters()) {
        sampler.sample(filter, {Vec2(0.3F, 0.3F)});
        EXPECT_EQ(sampler.block->albedo[0][0], 1);
        sampler.block->albedo[0][0] = 0.125F;
        run_stage("texture", filter, *sampler.block, {});
        EXPECT_EQ(sampler.block->albedo[0][0], 0.125F);
    }
}

} // namespace
} // namespace scanout::shade::test
