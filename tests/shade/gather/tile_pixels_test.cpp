// Pixels of a tile by the primitive that fills them: each comes back once, under its primitive's
// name, however many names share a slot of the table.
#include "raster/coverage/coverage.h"
#include "raster/micro/small_triangles.h"
#include "shade/gather/tile_pixels.h"
#include "support/random.h"
#include "support/targets.h"

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::shade::test {
namespace {

using raster::kTileSize;
using scanout::test::Random;

constexpr int kPixels = kTileSize * kTileSize;

class PixelsOfATile : public ::testing::Test {
protected:
    Random random{1};
    TilePixels pixels;
    ShadingKeys keys{nullptr, 0};
    std::vector<std::uint32_t> name_of = std::vector<std::uint32_t>(kPixels);
    std::function<std::uint32_t(std::uint32_t)> id_of = [](std::uint32_t id) { return id; };
    std::function<bool(std::uint32_t)> set_up_per_item = [](std::uint32_t) { return true; };

    // Fills the tile; next: the name of the run that begins at a pixel, `most` pixels at most.
    void fill(const std::function<std::uint32_t(int)>& name, int most) {
        for (int pixel = 0; pixel < kPixels;) {
            const int left = kTileSize - pixel % kTileSize;
            const int count = random.whole(1, std::min(most, left));
            const std::uint32_t id = name(pixel);
            pixels.add(id, pixel, count);
            std::fill_n(name_of.begin() + pixel, count, id);
            pixel += count;
        }
        pixels.arrange(keys, set_up_per_item);
    }

    std::vector<int> seen = std::vector<int>(kPixels);
    void expect_pixel(std::size_t at, std::uint32_t id) {
        ASSERT_LT(at, pixels.size());
        const auto pixel = static_cast<std::size_t>(pixels.pixels()[at]);
        ASSERT_LT(pixel, name_of.size());
        EXPECT_EQ(name_of[pixel], id) << "pixel " << pixel;
        ++seen[pixel];
    }
    // Also that lanes may set up each triangle of a material's batch.
    void expect_names() {
        std::fill(seen.begin(), seen.end(), 0);
        std::size_t at = 0;
        for (const TilePixels::MaterialBatch& batch : pixels.material_batches()) {
            ASSERT_EQ(batch.first, at);
            for (; at < batch.end; ++at) {
                const auto triangle = static_cast<std::size_t>(pixels.triangles()[at]);
                const std::uint32_t id = id_of(pixels.ids()[triangle]);
                expect_pixel(at, id);
                EXPECT_TRUE(set_up_per_item(id));
                EXPECT_EQ(batch.material, keys.of(id).material);
                EXPECT_TRUE(keys.of(id).lit);
                if (at == batch.first) continue;
                const int step = pixels.triangles()[at] - pixels.triangles()[at - 1];
                EXPECT_TRUE(step == 0 || step == 1);
            }
        }
        for (const TilePixels::PrimitiveBatch& batch : pixels.primitive_batches()) {
            EXPECT_EQ(batch.key, keys.of(batch.id));
            if (batch.key.lit && set_up_per_item(batch.id)) {
                EXPECT_GT(batch.count, std::uint32_t{TilePixels::kMaxPixels});
            }
            for (const std::size_t end = at + batch.count; at < end; ++at)
                expect_pixel(at, batch.id);
        }
        EXPECT_EQ(at, pixels.size());
    }
    void expect_each_pixel_once() {
        expect_names();
        EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), kPixels);
    }
    std::size_t batched_triangles() const {
        return pixels.material_batches().empty()
                   ? 0
                   : static_cast<std::size_t>(
                         pixels.triangles()[pixels.material_batches().back().end - 1]) +
                         1;
    }
};

TEST_F(PixelsOfATile, StandTogetherOncePerPrimitive) {
    fill([&](int) { return static_cast<std::uint32_t>(random.whole(0, 999)); }, 40);
    expect_each_pixel_once();
    std::vector<std::uint32_t> names(pixels.ids(), pixels.ids() + batched_triangles());
    EXPECT_FALSE(names.empty());
    EXPECT_FALSE(pixels.primitive_batches().empty());
    for (const TilePixels::PrimitiveBatch& batch : pixels.primitive_batches())
        names.push_back(batch.id);
    std::sort(names.begin(), names.end());
    EXPECT_TRUE(std::adjacent_find(names.begin(), names.end()) == names.end());
}

TEST_F(PixelsOfATile, AreAllThereWhenNamesShareASlot) {
    for (int round = 0; round < 50; ++round) {
        const int names = random.whole(1, 8);
        pixels.clear();
        fill([&](int) { return static_cast<std::uint32_t>(random.whole(1, names)) * 1024; }, 64);
        expect_each_pixel_once();
    }
}

TEST_F(PixelsOfATile, MayBeOneOfEveryPrimitive) {
    fill([](int pixel) { return static_cast<std::uint32_t>(pixel) * 1024; }, 1);
    EXPECT_EQ(batched_triangles(), static_cast<std::size_t>(kPixels));
    EXPECT_TRUE(pixels.primitive_batches().empty());
    expect_each_pixel_once();
}

TEST_F(PixelsOfATile, AreForgottenWithTheTile) {
    fill([](int) { return 7U; }, 64);
    pixels.clear();
    EXPECT_TRUE(pixels.primitive_batches().empty());
    EXPECT_EQ(pixels.size(), 0U);
    fill([](int) { return 7U; }, 64);
    expect_each_pixel_once();
    EXPECT_EQ(pixels.primitive_batches().size(), 1U);
}

TEST_F(PixelsOfATile, MakeBatchesOfPrimitivesThatLanesMayNotSetUp) {
    set_up_per_item = [](std::uint32_t id) { return id % 3 != 0; };
    fill([&](int) { return static_cast<std::uint32_t>(random.whole(0, 999)); }, 6);
    expect_each_pixel_once();
    EXPECT_TRUE(
        std::any_of(pixels.primitive_batches().begin(), pixels.primitive_batches().end(),
                    [](const auto& batch) { return batch.count <= TilePixels::kMaxPixels; }));
}

TEST_F(PixelsOfATile, StandTogetherByMaterialAndBehindThemWhatIsNotLit) {
    geom::Mesh mesh;
    constexpr std::uint32_t kTriangles = 900;
    mesh.index.resize(std::size_t{kTriangles} * 3);
    for (std::uint32_t i = 0; i < kTriangles; ++i)
        mesh.material.push_back(random.whole(-1, 4));
    constexpr std::uint32_t kPoints = 100;
    mesh.point_index.resize(kPoints);
    for (std::uint32_t i = 0; i < kPoints; ++i)
        mesh.point_material.push_back(random.whole(-1, 4));
    keys = {&mesh, std::nullopt};
    fill([&](int) { return static_cast<std::uint32_t>(random.whole(0, 999)); }, 12);
    expect_each_pixel_once();
    std::set<std::int32_t> materials;
    for (const TilePixels::MaterialBatch& batch : pixels.material_batches())
        EXPECT_TRUE(materials.insert(batch.material).second) << "two batches of one material";
    EXPECT_EQ(materials.size(), 6U);
    const auto key = [](const TilePixels::PrimitiveBatch& batch) {
        return std::pair(batch.key.lit, batch.key.material);
    };
    EXPECT_TRUE(std::is_sorted(pixels.primitive_batches().begin(), pixels.primitive_batches().end(),
                               [&](const auto& a, const auto& b) { return key(a) < key(b); }));
    EXPECT_FALSE(pixels.primitive_batches().front().key.lit);
}

TEST_F(PixelsOfATile, ComeFromBitsOfRows) {
    for (int round = 0; round < 40; ++round) {
        TileRows rows{};
        std::fill(name_of.begin(), name_of.end(), raster::kNoPrimitive);
        for (std::size_t row = 0; row < kTileSize; ++row)
            for (int x = 0, count = 0; x < kTileSize; x += count) {
                count = std::min(random.whole(1, random.whole(1, kTileSize)), kTileSize - x);
                rows[row].ends |= std::uint64_t{1} << (x + count - 1);
                if (random.whole(0, 4) == 0) continue; // the background
                std::fill_n(name_of.begin() + static_cast<std::ptrdiff_t>(row) * kTileSize + x,
                            count, static_cast<std::uint32_t>(random.whole(0, 3000)));
            }
        const int first = random.whole(0, 20), end = random.whole(40, kTileSize);
        const std::uint64_t columns = ~std::uint64_t{0} >> random.whole(0, 20) << 5;
        std::vector<int> expected(kPixels);
        for (int row = first; row < end; ++row) {
            RowBits& of = rows[static_cast<std::size_t>(row)];
            of.edge = random.whole(0, 1) == 0 ? 0 : random.bits() & random.bits();
            for (int x = 0; x < kTileSize; ++x) {
                const auto pixel = static_cast<std::size_t>(row * kTileSize + x);
                const bool shows = name_of[pixel] != raster::kNoPrimitive;
                of.visible |= std::uint64_t{shows} << x;
                if (shows && ((columns & ~of.edge) >> x & 1) != 0) expected[pixel] = 1;
            }
        }
        InteriorPixels interior;
        find_interior(rows, first, end, columns, interior);
        pixels.clear();
        pixels.add_rows(name_of.data(), interior, first, end);
        pixels.arrange(keys, set_up_per_item);
        expect_names();
        EXPECT_EQ(seen, expected);
    }
}

// Triangles of at most kSmallSide pixels from vertex to vertex, anywhere in the tile: each shows
// any of its pixels, unless one that comes later does.
class PixelsOfSmallTriangles : public PixelsOfATile {
protected:
    std::vector<raster::BinnedTriangle> triangles;
    std::vector<std::uint32_t> id; // of the triangles' places
    void draw(int count) {
        triangles.clear();
        id.clear();
        std::fill(name_of.begin(), name_of.end(), raster::kNoPrimitive);
        for (int i = 0; i < count; ++i) {
            id.push_back(static_cast<std::uint32_t>(i) * 7919);
            const auto side = [&] {
                return random.whole(1, random.whole(1, raster::kSmallSide + 1));
            };
            const int across = side(), down = side(), density = random.whole(0, 3);
            const int x0 = random.whole(0, kTileSize - across),
                      y0 = random.whole(0, kTileSize - down);
            triangles.push_back(raster::BinnedTriangle::of(static_cast<std::uint32_t>(i), x0, y0,
                                                           x0 + across, y0 + down));
            for (int y = y0; y < y0 + down; ++y)
                for (int x = x0; x < x0 + across; ++x)
                    if (random.whole(0, 3) < density)
                        name_of[static_cast<std::size_t>(y * kTileSize + x)] = id.back();
        }
    }
    // Kernels read up to a register beyond the tile.
    bool take(std::span<const raster::BinnedList> lists, int tile_pixels = kPixels) {
        std::vector<std::uint32_t> ids = name_of;
        ids.resize(ids.size() + 16, raster::kNoPrimitive);
        id_of = [&](std::uint32_t place) { return id[place]; };
        pixels.clear();
        const bool taken = pixels.take_small_triangles(0, lists, ids.data(), tile_pixels);
        pixels.arrange(keys, set_up_per_item);
        return taken;
    }
};

TEST_F(PixelsOfSmallTriangles, AreThoseThatShowTheirIds) {
    int taken = 0, large = 0;
    scanout::test::on_every_target([&](const std::string& target) {
        for (int round = 0; round < 200; ++round) {
            draw(random.whole(1, 585));
            const std::span<const raster::BinnedTriangle> all = triangles;
            const std::size_t first = all.size() / 3;
            const std::array lists = {
                raster::BinnedList{{}, {}, all.first(first), raster::SmallKind::rows, id},
                raster::BinnedList{{}, {}, all.subspan(first), raster::SmallKind::rows, id}};
            if (!take(lists)) {
                EXPECT_FALSE(target.starts_with("avx3"));
                EXPECT_EQ(pixels.size(), 0U);
                continue;
            }
            ++taken;
            large += static_cast<int>(pixels.primitive_batches().size());
            expect_names();
            for (std::size_t pixel = 0; pixel < name_of.size(); ++pixel)
                ASSERT_EQ(seen[pixel], name_of[pixel] == raster::kNoPrimitive ? 0 : 1) << pixel;
        }
    });
    const std::vector<std::string> targets = scanout::test::supported_targets();
    if (std::any_of(targets.begin(), targets.end(),
                    [](const std::string& name) { return name.starts_with("avx3"); })) {
        EXPECT_GT(taken, 100);
        EXPECT_GT(large, 100);
    }
}

TEST_F(PixelsOfSmallTriangles, AreNotLookedForWhereTrianglesAreManyOrTiny) {
    draw(500);
    const auto lists = [&](raster::SmallKind kind) {
        return std::array{raster::BinnedList{{}, {}, triangles, kind, id}};
    };
    EXPECT_FALSE(take(lists(raster::SmallKind::micro)));
    EXPECT_FALSE(take(lists(raster::SmallKind::rows), kPixels / 4));
    EXPECT_EQ(pixels.size(), 0U);
    EXPECT_TRUE(pixels.material_batches().empty());
}

TEST_F(PixelsOfATile, KeepTheirOrderWhereEachShowsATriangleOfItsOwn) {
    for (int pixel = 0; pixel < kPixels; ++pixel)
        name_of[static_cast<std::size_t>(pixel)] =
            static_cast<std::uint32_t>(random.whole(0, 5)); // neighbours may show the same
    std::size_t count = 0;
    for (int row = 0; row < kTileSize; ++row) {
        const std::uint64_t some = random.bits() & random.bits();
        pixels.add_ungrouped(0, name_of.data() + std::ptrdiff_t{row} * kTileSize, row * kTileSize,
                             some);
        count += static_cast<std::size_t>(std::popcount(some));
    }
    pixels.arrange(keys, set_up_per_item);
    ASSERT_EQ(pixels.size(), count);
    ASSERT_EQ(pixels.material_batches().size(), 1U);
    EXPECT_TRUE(pixels.primitive_batches().empty());
    for (std::size_t at = 0; at < count; ++at) {
        expect_pixel(at, pixels.ids()[static_cast<std::size_t>(pixels.triangles()[at])]);
        if (at > 0) {
            EXPECT_LT(pixels.pixels()[at - 1], pixels.pixels()[at]);
        }
    }
}

} // namespace
} // namespace scanout::shade::test
