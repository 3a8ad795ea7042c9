// A tile's depths in a picture: its own pixels and no others, wherever they lie in memory.
#include "raster/tile/copy_depths.h"
#include "support/targets.h"

#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::raster::test {
namespace {

TEST(CopyDepths, WritesThePixelsOfTheTileAndNoOthers) {
    constexpr std::size_t kLine = 16; // floats of a line of the cache
    scanout::test::on_every_target([](const std::string& target) {
        for (const image::Rect& area : {image::Rect{64, 128, 128, 192},
                                        {0, 64, 48, 65},
                                        {64, 64, 65, 128},
                                        {128, 0, 128 + 41, 30}}) {
            VisibilityTile tile;
            tile.reset(area, 1, {}, TileFormat::depth_only);
            for (int y = area.y0; y < area.y1; ++y)
                for (int x = area.x0; x < area.x1; ++x)
                    tile.draw_sample(x, y, 0, static_cast<float>(1 + y * 256 + x) * 0x1p-20F, 7);
            for (const std::size_t stride : {std::size_t{192}, std::size_t{201}})
                for (std::size_t from_line = 0; from_line < kLine; from_line += 3) {
                    std::vector<float> room(stride * 66 + 2 * kLine, -1.0F);
                    const auto address = reinterpret_cast<std::uintptr_t>(room.data());
                    const std::size_t first =
                        (kLine - address / sizeof(float) % kLine) % kLine + from_line;
                    copy_depths(tile, room.data() + first, stride);
                    std::vector<float> wanted(room.size(), -1.0F);
                    for (int y = area.y0; y < area.y1; ++y)
                        for (int x = area.x0; x < area.x1; ++x)
                            wanted[first + static_cast<std::size_t>(y - area.y0) * stride +
                                   static_cast<std::size_t>(x - area.x0)] = tile.depth(x, y);
                    EXPECT_TRUE(room == wanted) << target << ' ' << stride << ' ' << from_line;
                }
        }
    });
}

} // namespace
} // namespace scanout::raster::test
