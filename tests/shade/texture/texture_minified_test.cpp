// Textures that are seen smaller than they are: mip levels and footprints.
#include "texture_sampler.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace scanout::shade::test {
namespace {

// A level of a chain, bilinear, repeated.
double in_level(const MipChain& chain, const image::Image& image, int level, double u, double v) {
    const int width = chain.width[level], height = chain.height[level];
    const double x = u * width - 0.5, y = v * height - 0.5;
    double sum = 0;
    for (int j = 0; j < 2; ++j) {
        for (int k = 0; k < 2; ++k) {
            const double tx = std::floor(x) + k, ty = std::floor(y) + j;
            const auto wrapped = [](double t, int size) {
                return static_cast<int>(t - std::floor(t / size) * size);
            };
            const int column = wrapped(tx, width), row = height - 1 - wrapped(ty, height);
            const double texel = level == 0
                                     ? scanout::test::decoded(image.at(column, row).r)
                                     : chain.texels[static_cast<std::size_t>(chain.begin[level] +
                                                                             row * width + column) *
                                                    4];
            sum += texel * (1 - std::abs(x - tx)) * (1 - std::abs(y - ty));
        }
    }
    return sum;
}

TEST(Texture, NothingMinifiedIsReadAsBilinearReadsItToTheBit) {
    Random random(10);
    const scene::Texture texture = noise(16, 8, 11);
    for (const Wrap wrap : kWraps) {
        Sampler sampler(texture, wrap);
        for (int i = 0; i < kBlockSize; ++i) {
            const double angle = random.in(0, 6.28), size = i % 2 == 0 ? 0.999 : 0.01;
            const Vec2 x(std::cos(angle) * size / 16, std::sin(angle) * size / 8);
            sampler.set_slopes(i, {x, {-x.y * 0.25F, x.x}});
        }
        const std::vector<Vec2> uv = random_uv(random, 2);
        sampler.sample("bilinear", uv);
        const ShadingBlock expected = *sampler.block;
        for (const Filter* rung : shade::texture::kRows) {
            if (!rung->needs.footprint) continue;
            const std::string_view filter = rung->card.name;
            for (const MipChain* mips : {static_cast<const MipChain*>(&sampler.chain),
                                         static_cast<const MipChain*>(nullptr)}) {
                sampler.block->map[kDiffuseMap].mips = mips;
                sampler.sample(filter, uv);
                EXPECT_TRUE(same_lanes(*sampler.block, expected, 0, kBlockSize)) << filter;
            }
        }
    }
}

TEST(Texture, MipmapReadsTheNearestLevelAndTrilinearBothWithTheirShares) {
    Random random(11);
    const scene::Texture texture = noise(37, 64, 12);
    Sampler sampler(texture);
    for (int round = 0; round < 500; ++round) {
        std::vector<double> level(kBlockSize);
        for (int i = 0; i < kBlockSize; ++i) {
            double& l = level[static_cast<std::size_t>(i)];
            l = random.in(-1, 7);
            const double size = std::exp2(l), angle = random.in(0, 6.28);
            const Vec2 longer(size * std::cos(angle) / 37, size * std::sin(angle) / 64);
            const Vec2 shorter = longer * static_cast<float>(random.in(0, 0.99));
            sampler.set_slopes(i, i % 2 == 0 ? Slopes{longer, shorter} : Slopes{shorter, longer});
        }
        const std::vector<Vec2> uv = random_uv(random, 1);
        const auto got = [&](std::string_view filter, auto expected) {
            sampler.sample(filter, uv);
            for (std::size_t i = 0; i < uv.size(); ++i) {
                const double l = std::clamp(level[i], 0.0, double(sampler.chain.last));
                if (std::abs(l - std::floor(l) - 0.5) < 1e-4) continue; // which is nearer?
                ASSERT_NEAR(sampler.block->albedo[0][i], expected(l, uv[i]), 3e-5)
                    << filter << " at level " << l;
            }
        };
        const auto read = [&](double l, const Vec2& at) {
            return in_level(sampler.chain, texture.image, static_cast<int>(l), at.x, at.y);
        };
        got("mipmap", [&](double l, const Vec2& at) { return read(std::floor(l + 0.5), at); });
        got("trilinear", [&](double l, const Vec2& at) {
            const double sharp = std::floor(l), share = l - sharp;
            const double near = read(sharp, at);
            return share == 0 ? near : near + share * (read(sharp + 1, at) - near);
        });
    }
}

// Registers that are minified in all lanes are read another way than others.
TEST(Texture, TrilinearReadsTheSameBitsBesideLanesThatAreNotMinified) {
    Random random(17);
    scene::Texture texture = noise(37, 64, 18);
    for (image::Rgba8& p : texture.image.pixels())
        p.a = static_cast<std::uint8_t>(random.bits());
    const Filter* const trilinear = find_row(shade::texture::kRows, "trilinear");
    scanout::test::on_every_target([&](const std::string& target) {
        for (int round = 0; round < 90; ++round) {
            Sampler all(texture, kWraps[round % 3]), half(texture, kWraps[round % 3]);
            const std::vector<Vec2> uv = random_uv(random, 3);
            all.block->count = half.block->count = random.whole(1, kBlockSize);
            for (int i = 0; i < kBlockSize; ++i) {
                // The whole block in one level, or each lane in its own, up to beyond the last.
                const double level = round % 2 == 0 ? random.in(1.01, 9) : 1.5 + round / 10;
                const float size = static_cast<float>(std::exp2(level) / 37);
                all.set_slopes(i, {{size, 0}, {0, size / 64}});
                half.set_slopes(i, i % 2 == 0 ? Slopes{{size, 0}, {0, size / 64}} : Slopes{});
                all.block->u[i] = half.block->u[i] = uv[static_cast<std::size_t>(i)].x;
                all.block->v[i] = half.block->v[i] = uv[static_cast<std::size_t>(i)].y;
            }
            for (const TexelKind kind : {TexelKind::colour, TexelKind::alpha})
                for (const Sampler* s : {&all, &half})
                    trilinear->sample(*s->block, s->block->map[kDiffuseMap], kind);
            for (int i = 0; i < all.block->count; i += 2)
                for (int c = 0; c < 4; ++c)
                    ASSERT_EQ(all.block->sampled[c][i], half.block->sampled[c][i])
                        << target << ", lane " << i << ", channel " << c;
        }
    });
}

// A footprint of n texels by one: n probes of one texel each, in a line.
TEST(Texture, AnisotropicIsTheMeanAlongTheFootprint) {
    Random random(12);
    const scene::Texture texture = noise(64, 64, 13);
    Sampler sampler(texture);
    for (const auto& [filter, most] :
         {std::pair{"anisotropic_2", 2}, std::pair{"anisotropic_4", 4},
          std::pair{"anisotropic_8", 8}, std::pair{"anisotropic_16", 16}}) {
        for (int round = 0; round < 200; ++round) {
            const double angle = random.in(0, 6.28);
            const double x = std::cos(angle), y = std::sin(angle), n = most * 0.9999;
            for (int i = 0; i < kBlockSize; ++i) {
                // Any conjugate axes of the same ellipse are the same footprint.
                const double turn = random.in(0, 6.28), c = std::cos(turn), s = std::sin(turn);
                sampler.set_slopes(i, {Vec2(n * x * c - y * s, n * y * c + x * s) / 64.0F,
                                       Vec2(-n * x * s - y * c, -n * y * s + x * c) / 64.0F});
            }
            const std::vector<Vec2> uv = random_uv(random, 1);
            sampler.sample(filter, uv);
            for (std::size_t i = 0; i < uv.size(); ++i) {
                double mean = 0;
                for (int k = 0; k < most; ++k) {
                    const double along = ((k + 0.5) / most - 0.5) * n / 64;
                    mean += in_level(sampler.chain, texture.image, 0, uv[i].x + along * x,
                                     uv[i].y + along * y) /
                            most;
                }
                ASSERT_NEAR(sampler.block->albedo[0][i], mean, 2e-4) << filter;
            }
        }
    }
}

TEST(Texture, AnisotropicOfARoundFootprintIsTrilinear) {
    Random random(13);
    const scene::Texture texture = noise(64, 32, 14);
    Sampler sampler(texture);
    for (int i = 0; i < kBlockSize; ++i) {
        const double size = std::exp2(random.in(0, 6)), angle = random.in(0, 6.28);
        const Vec2 a(size * std::cos(angle), size * std::sin(angle));
        sampler.set_slopes(i, {{a.x / 64, a.y / 32}, {-a.y * 0.9999F / 64, a.x * 0.9999F / 32}});
    }
    const std::vector<Vec2> uv = random_uv(random, 1);
    sampler.sample("trilinear", uv);
    const ShadingBlock expected = *sampler.block;
    sampler.sample("anisotropic_16", uv);
    double worst = 0;
    for (int i = 0; i < kBlockSize; ++i)
        worst =
            std::max<double>(worst, std::abs(sampler.block->albedo[0][i] - expected.albedo[0][i]));
    EXPECT_LT(worst, 1e-3);
}

TEST(Texture, MinifiedValuesStayWithinThoseOfTheTexture) {
    Random random(14);
    const scene::Texture texture = noise(37, 19, 15);
    float low = 1, high = 0;
    for (const image::Rgba8& p : texture.image.pixels()) {
        low = std::min(low, static_cast<float>(scanout::test::decoded(p.g)));
        high = std::max(high, static_cast<float>(scanout::test::decoded(p.g)));
    }
    for (int round = 0; round < 1300; ++round) { // P13: a million samples
        Sampler sampler(texture, kWraps[round % 3]);
        sampler.set_random_slopes(random);
        const std::vector<Vec2> uv = random_uv(random, std::exp2(random.in(-3, 40)));
        for (const std::string& filter : filters()) {
            sampler.sample(filter, uv);
            for (int i = 0; i < kBlockSize; ++i) {
                ASSERT_GE(sampler.block->albedo[1][i], low * (1 - 0x1p-22F)) << filter;
                ASSERT_LE(sampler.block->albedo[1][i], high * (1 + 0x1p-22F)) << filter;
            }
        }
    }
}

TEST(Texture, FootprintsWithoutEndReadTheSmallestLevel) {
    const scene::Texture texture = noise(64, 64, 16);
    Sampler sampler(texture);
    const float mean = sampler.chain.texels[sampler.chain.texels.size() - 4];
    for (const float slope : {kInfTexel, -kInfTexel, kNaNTexel, 1e30F, 1000.0F}) {
        sampler.set_slopes(0, {{slope, slope}, {slope, slope}});
        for (const Filter* filter : shade::texture::kRows) {
            if (!filter->needs.footprint) continue;
            const std::string_view name = filter->card.name;
            EXPECT_FLOAT_EQ(sampler.one(name, 0.3F, 0.6F).x, mean) << name << ' ' << slope;
        }
    }
}

} // namespace
} // namespace scanout::shade::test
