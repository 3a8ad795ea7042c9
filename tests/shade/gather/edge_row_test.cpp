// What edge pixels show, against each pixel's samples one by one: on every target.
#include "shade/gather/edge_row.h"
#include "support/random.h"
#include "support/targets.h"

#include <gtest/gtest.h>

namespace scanout::shade::test {
namespace {

using raster::kNoPrimitive;
using raster::kTileSize;
using scanout::test::Random;

// Each sample shows one of few primitives, or none.
raster::VisibilityTile random_tile(Random& random, int samples) {
    raster::VisibilityTile tile;
    tile.reset({0, 0, kTileSize, kTileSize}, samples);
    for (int y = 0; y < kTileSize; ++y)
        for (int x = 0; x < kTileSize; ++x)
            for (int s = 0; s < samples; ++s)
                if (const int id = random.whole(-2, 3); id >= 0)
                    tile.draw_sample(x, y, s, 0.5F, static_cast<std::uint32_t>(id));
    return tile;
}

void expect_pixel(const raster::VisibilityTile& tile, int x, int y, const EdgeRow& row) {
    const int samples = tile.samples();
    const auto number_of = [&](std::uint32_t id) {
        int number = 0;
        for (int s = 0; s < samples; ++s)
            number += tile.id(x, y, s) == id ? 1 : 0;
        return static_cast<float>(number);
    };
    const auto all = static_cast<float>(samples);
    ASSERT_EQ(row.transmittance[x], number_of(kNoPrimitive) / all);
    for (int s = 0; s < samples; ++s) {
        const std::uint32_t id = tile.id(x, y, s);
        bool first = id != kNoPrimitive;
        for (int before = 0; before < s; ++before)
            first = first && tile.id(x, y, before) != id;
        ASSERT_EQ((row.first[s] >> x & 1) != 0, first) << x << ' ' << y << ' ' << s;
        if (first) {
            ASSERT_EQ(row.coverage[s][x], number_of(id) / all);
        }
    }
}

TEST(EdgeRow, TellsWhatEachSampleShowsFirstAndHowMuchOfThePixel) {
    Random random(3);
    for (const int samples : {2, 4, 8, 16}) {
        const raster::VisibilityTile tile = random_tile(random, samples);
        scanout::test::on_every_target([&](const std::string&) {
            for (int y = 0; y < kTileSize && !testing::Test::HasFatalFailure(); ++y) {
                const std::uint64_t edges = random.bits() & random.bits();
                EdgeRow row;
                find_edge_row(tile, y, edges, row);
                for (int x = 0; x < kTileSize; ++x)
                    if ((edges >> x & 1) != 0)
                        expect_pixel(tile, x, y, row);
                    else
                        for (int s = 0; s < samples; ++s)
                            ASSERT_EQ(row.first[s] >> x & 1, 0U);
            }
        });
    }
}

} // namespace
} // namespace scanout::shade::test
