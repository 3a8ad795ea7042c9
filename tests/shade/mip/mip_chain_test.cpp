// The levels of a texture: means of what they cover, in linear light, at any size (HARD-CASES 46).
#include "shade/mip/mip_chain.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/targets.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace scanout::shade::test {
namespace {

using scanout::test::Random;

image::Image noise(int width, int height, std::uint64_t seed) {
    Random random(seed);
    image::Image image(width, height);
    for (image::Rgba8& p : image.pixels()) {
        const std::uint64_t bits = random.bits();
        p = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8),
             static_cast<std::uint8_t>(bits >> 16), static_cast<std::uint8_t>(bits >> 24)};
    }
    return image;
}

double value_of(const image::Rgba8& p, int channel, TexelKind kind) {
    const int code = channel == 0 ? p.r : channel == 1 ? p.g : channel == 2 ? p.b : p.a;
    const double c = code / 255.0;
    if (kind == TexelKind::data || channel == 3) return c;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

// Texel (x, y) of a level, as the mean of the part of the level above that it covers.
struct Level {
    int width, height;
    std::vector<double> value;
    double at(int x, int y) const { return value[static_cast<std::size_t>(y * width + x)]; }
    Level half() const {
        Level h{std::max(width / 2, 1), std::max(height / 2, 1), {}};
        const double wide = static_cast<double>(width) / h.width,
                     high = static_cast<double>(height) / h.height;
        const auto overlap = [](int i, int j, double size) { // of texel j of the level above
            return std::max(0.0, std::min(j + 1.0, (i + 1) * size) - std::max<double>(j, i * size));
        };
        for (int y = 0; y < h.height; ++y)
            for (int x = 0; x < h.width; ++x) {
                double sum = 0;
                for (int j = 0; j < height; ++j)
                    for (int i = 0; i < width; ++i)
                        sum += at(i, j) * overlap(x, i, wide) * overlap(y, j, high);
                h.value.push_back(sum / (wide * high));
            }
        return h;
    }
};

constexpr std::pair<int, int> kSizes[] = {{1, 1}, {2, 2},  {16, 16}, {7, 5}, {37, 19},
                                          {1, 9}, {13, 1}, {3, 64},  {6, 2}, {33, 31}};

TEST(MipChain, EveryTexelIsTheMeanOfWhatItCoversAtAnySize) {
    Jobs jobs(2);
    for (const auto& [width, height] : kSizes) {
        const image::Image image = noise(width, height, 1);
        for (const TexelKind kind : {TexelKind::colour, TexelKind::data}) {
            const MipChain chain = make_mip_chain(image, kind, jobs);
            ASSERT_EQ(mip_chain_bytes(image), chain.texels.size() * sizeof(float));
            for (int c = 0; c < 4; ++c) {
                Level level{width, height, {}};
                for (const image::Rgba8& p : image.pixels())
                    level.value.push_back(value_of(p, c, kind));
                const double whole = [&] {
                    double sum = 0;
                    for (const double v : level.value)
                        sum += v;
                    return sum / static_cast<double>(level.value.size());
                }();
                for (int k = 1; k <= chain.last; ++k) {
                    level = level.half();
                    ASSERT_EQ(chain.width[k], level.width);
                    ASSERT_EQ(chain.height[k], level.height);
                    double mean = 0;
                    for (std::size_t i = 0; i < level.value.size(); ++i) {
                        const float got =
                            chain.texels[(static_cast<std::size_t>(chain.begin[k]) + i) * 4 +
                                         static_cast<std::size_t>(c)];
                        ASSERT_NEAR(got, level.value[i], 1e-6) << width << 'x' << height;
                        mean += double{got} / static_cast<double>(level.value.size());
                    }
                    ASSERT_NEAR(mean, whole, 1e-6) << "no light is lost: " << width << ' ' << k;
                }
                ASSERT_EQ(chain.width[chain.last] * chain.height[chain.last], 1);
            }
        }
    }
}

TEST(MipChain, OfAConstantIsThatConstantToTheBit) {
    Jobs jobs(1);
    scanout::test::on_every_target([&](const std::string&) {
        for (const auto& [width, height] : kSizes)
            for (int code = 0; code < 256; ++code) {
                const auto c = static_cast<std::uint8_t>(code);
                const MipChain chain = make_mip_chain(image::Image(width, height, {c, c, c, c}),
                                                      TexelKind::data, jobs);
                for (const float texel : chain.texels)
                    ASSERT_EQ(texel, static_cast<float>(code) / 255.0F);
            }
    });
}

// Of four floats a sum in long double is exact.
TEST(MipChain, OfEvenSidesIsRoundedOnce) {
    Jobs jobs(1);
    const image::Image image = noise(64, 32, 9);
    scanout::test::on_every_target([&](const std::string&) {
        const MipChain chain = make_mip_chain(image, TexelKind::data, jobs);
        const auto at = [&](int level, int x, int y, int c) -> float {
            if (level == 0) return static_cast<float>(value_of(image.at(x, y), c, TexelKind::data));
            return chain.texels[static_cast<std::size_t>(
                (chain.begin[level] + y * chain.width[level] + x) * 4 + c)];
        };
        for (int level = 1; chain.height[level - 1] > 1; ++level)
            for (int y = 0; y < chain.height[level]; ++y)
                for (int x = 0; x < chain.width[level]; ++x)
                    for (int c = 0; c < 4; ++c) {
                        long double sum = 0;
                        for (int k = 0; k < 4; ++k)
                            sum += at(level - 1, 2 * x + k % 2, 2 * y + k / 2, c);
                        ASSERT_EQ(at(level, x, y, c), static_cast<float>(sum / 4)) << level;
                    }
    });
}

TEST(MipChain, IsTheSameOnEveryTarget) {
    Jobs jobs(1);
    for (const auto& [width, height] : kSizes) {
        const image::Image image = noise(width, height, 8);
        const auto best = make_mip_chain(image, TexelKind::colour, jobs).texels;
        scanout::test::on_every_target([&](const std::string&) {
            ASSERT_EQ(make_mip_chain(image, TexelKind::colour, jobs).texels, best);
        });
    }
}

TEST(MipChain, DoesNotDependOnTheNumberOfThreads) {
    const image::Image image = noise(301, 77, 2);
    Jobs one(1), many(5);
    EXPECT_EQ(make_mip_chain(image, TexelKind::colour, one).texels,
              make_mip_chain(image, TexelKind::colour, many).texels);
}

TEST(MipChains, ExistWhileTheyAreUsedAndOfTheSameScene) {
    Jobs jobs(1);
    scene::Scene scene;
    scene.textures = {{"a", noise(8, 8, 3)}, {"b", noise(8, 4, 4)}};
    scene.revision = 7;
    const MipUse a{0, TexelKind::colour}, b{1, TexelKind::data};
    MipChains chains;
    chains.update(scene, {}, jobs);
    EXPECT_EQ(chains.bytes(), 0U);
    EXPECT_EQ(chains.find({0, TexelKind::colour}), nullptr);
    const MipUse both[] = {a, b};
    chains.update(scene, both, jobs);
    const MipChain* first = chains.find({0, TexelKind::colour});
    ASSERT_NE(first, nullptr);
    EXPECT_NE(chains.find({1, TexelKind::data}), nullptr);
    EXPECT_EQ(chains.find({1, TexelKind::colour}), nullptr);
    EXPECT_EQ(chains.find({0, TexelKind::data}), nullptr);
    EXPECT_EQ(chains.bytes(), 16U * (16 + 4 + 1 + 8 + 2 + 1));
    chains.update(scene, {both, 1}, jobs);
    EXPECT_EQ(chains.find({0, TexelKind::colour}), first) << "kept from frame to frame";
    EXPECT_EQ(chains.find({1, TexelKind::data}), nullptr);
    const auto top = [&] {
        const MipChain& chain = *chains.find({0, TexelKind::colour});
        return chain.texels[chain.texels.size() - 4];
    };
    const float before = top();
    scene.textures[0].image = noise(8, 8, 5);
    scene.revision = 8;
    chains.update(scene, {both, 1}, jobs);
    EXPECT_NE(top(), before) << "another scene has another chain";
    scene.textures[0].image = noise(8, 8, 3);
    scene.revision = 0;
    chains.update(scene, {both, 1}, jobs);
    EXPECT_EQ(top(), before);
    scene.textures[0].image = noise(8, 8, 6);
    chains.update(scene, {both, 1}, jobs);
    EXPECT_NE(top(), before) << "of a scene without a revision nothing is kept";
    chains.update(scene, {}, jobs);
    EXPECT_EQ(chains.bytes(), 0U);
}

} // namespace
} // namespace scanout::shade::test
