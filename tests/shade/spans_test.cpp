// Pixels of a tile by the primitive that fills them: each comes back once, under its primitive's
// name, however many names share a slot of the table.
#include "raster/coverage.h"
#include "shade/spans.h"
#include "support/random.h"

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::shade::test {
namespace {

using raster::kTileSize;
using scanout::test::Random;

constexpr int kPixels = kTileSize * kTileSize;

class SpansOfATile : public ::testing::Test {
protected:
    Random random{1};
    Spans spans;
    Looks looks{nullptr, 0};
    std::vector<std::uint32_t> name_of = std::vector<std::uint32_t>(kPixels);

    // Fills the tile; next: the name and the length of the run that begins at a pixel.
    void fill(const std::function<std::uint32_t(int)>& name, int most) {
        for (int pixel = 0; pixel < kPixels;) {
            const int left = kTileSize - pixel % kTileSize;
            const int count = random.whole(1, std::min(most, left));
            const std::uint32_t id = name(pixel);
            spans.add(looks, id, pixel, count);
            std::fill_n(name_of.begin() + pixel, count, id);
            pixel += count;
        }
        spans.arrange();
    }
    void expect_each_pixel_once() {
        std::vector<int> seen(kPixels);
        std::vector<std::int32_t> pixels(kPixels + Spans::kBeyond);
        for (const Spans::Group& group : spans.groups()) {
            spans.put_pixels(group, pixels.data());
            for (std::size_t i = 0; i < group.count; ++i) {
                const auto pixel = static_cast<std::size_t>(pixels[i]);
                ASSERT_LT(pixel, name_of.size());
                EXPECT_EQ(name_of[pixel], group.id);
                ++seen[pixel];
            }
        }
        EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), kPixels);
    }
};

TEST_F(SpansOfATile, HaveOneGroupAPrimitive) {
    fill([&](int) { return static_cast<std::uint32_t>(random.whole(0, 999)); }, 40);
    expect_each_pixel_once();
    std::vector<std::uint32_t> names;
    for (const Spans::Group& group : spans.groups())
        names.push_back(group.id);
    std::sort(names.begin(), names.end());
    EXPECT_TRUE(std::adjacent_find(names.begin(), names.end()) == names.end());
}

TEST_F(SpansOfATile, AreAllThereWhenNamesShareASlot) {
    for (int round = 0; round < 50; ++round) {
        const int names = random.whole(1, 8);
        spans.clear();
        fill([&](int) { return static_cast<std::uint32_t>(random.whole(1, names)) * 1024; }, 64);
        expect_each_pixel_once();
    }
}

TEST_F(SpansOfATile, MayBeOnePixelOfEveryPrimitive) {
    fill([](int pixel) { return static_cast<std::uint32_t>(pixel) * 1024; }, 1);
    EXPECT_EQ(spans.groups().size(), static_cast<std::size_t>(kPixels));
    expect_each_pixel_once();
}

TEST_F(SpansOfATile, AreForgottenWithTheTile) {
    fill([](int) { return 7U; }, 64);
    spans.clear();
    EXPECT_TRUE(spans.groups().empty());
    fill([](int) { return 7U; }, 64);
    expect_each_pixel_once();
    EXPECT_EQ(spans.groups().size(), 1U);
}

} // namespace
} // namespace scanout::shade::test
