#include "image/image.h"
#include "shade/gather/block_pixels.h"
#include "shade/gather/tile_runs.h"
#include "support/random.h"
#include "support/targets.h"

#include <algorithm>
#include <bit>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::shade::test {
namespace {

using raster::kTileSize;
using scanout::test::on_every_target;
using scanout::test::Random;

bool bit(std::uint64_t bits, int x) {
    return (bits >> x & 1) != 0;
}

TEST(TileRuns, ArePixelsOfOnePrimitiveSideBySideInsideTheColumns) {
    Random random(1);
    for (int round = 0; round < 50; ++round) {
        TileRows rows{};
        for (RowBits& row : rows) {
            const std::uint64_t some = random.bits(), few = random.bits() & random.bits();
            row = {some | std::uint64_t{1} << (kTileSize - 1), few & random.bits(),
                   round % 2 == 0 ? ~std::uint64_t{0} : random.bits() | random.bits()};
        }
        const int first = static_cast<int>(random.in(0, 20)),
                  end = static_cast<int>(random.in(21, kTileSize));
        const int left = static_cast<int>(random.in(0, 20)),
                  right = round % 3 == 0 ? kTileSize : static_cast<int>(random.in(21, kTileSize));
        std::uint64_t columns = 0;
        for (int x = left; x < right; ++x)
            columns |= std::uint64_t{1} << x;
        on_every_target([&](const std::string& target) {
            InteriorPixels interior{};
            find_interior(rows, first, end, columns, interior);
            int count = 0, runs = 0;
            for (int y = first; y < end; ++y) {
                const auto row = static_cast<std::size_t>(y);
                bool continues = false; // the run of the pixel before
                for (int x = 0; x < kTileSize; ++x) {
                    const bool is_own = x >= left && x < right && bit(rows[row].visible, x) &&
                                        !bit(rows[row].edge, x);
                    const bool starts = is_own && !continues;
                    count += is_own ? 1 : 0;
                    runs += starts ? 1 : 0;
                    ASSERT_EQ(bit(interior.pixels[row], x), is_own) << target;
                    ASSERT_EQ(bit(interior.starts[row], x), starts) << target;
                    continues = is_own && !bit(rows[row].ends, x) && x + 1 < right &&
                                !bit(rows[row].edge, x + 1);
                    ASSERT_TRUE(!is_own || bit(interior.ends[row], x) == !continues) << target;
                }
            }
            EXPECT_EQ(interior.count, count) << target;
            EXPECT_EQ(interior.runs, runs) << target;
        });
    }
}

TEST(PlaceLanes, PutsEveryCodeToItsPixelAndTouchesNoOther) {
    Random random(2);
    std::vector<std::int32_t> pixel(kPaddedBlock);
    std::vector<std::uint32_t> code(kPaddedBlock);
    for (const int width : {1, 10, kTileSize, 100, 1920})
        for (const int count : {0, 1, 7, 16, 17, 63, 127, kBlockSize}) {
            if (count > width * kTileSize) continue; // each pixel once
            for (std::size_t i = 0; i < kPaddedBlock; ++i) {
                code[i] = static_cast<std::uint32_t>(random.bits());
                const auto across = static_cast<std::size_t>(std::min(width, kTileSize));
                const std::size_t place = i * 31 % (across * kTileSize);
                pixel[i] = static_cast<std::int32_t>(place / across * kTileSize + place % across);
            }
            const image::Rgba8 old{1, 2, 3, 4};
            image::Image expected(width, kTileSize, old);
            for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
                expected.at(pixel[i] % kTileSize, pixel[i] / kTileSize) =
                    std::bit_cast<image::Rgba8>(code[i]);
            on_every_target([&](const std::string& target) {
                image::Image picture(width, kTileSize, old);
                store_codes(code.data(), pixel.data(), count, &picture.at(0, 0), width);
                for (int y = 0; y < kTileSize; ++y)
                    for (int x = 0; x < width; ++x)
                        ASSERT_TRUE(picture.at(x, y) == expected.at(x, y)) << target;
            });
        }
}

} // namespace
} // namespace scanout::shade::test
