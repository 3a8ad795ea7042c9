// Small triangles drawn by the parts that a tile has of them: the same bits as whole triangles.
#include "raster/exact.h"
#include "raster/micro/small_triangles.h"
#include "support/targets.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

namespace scanout::raster::test {
namespace {

struct Soup {
    std::vector<ScreenVertex> vertices;
    std::vector<std::uint32_t> index;
    std::size_t triangles() const { return index.size() / 3; }
    std::array<ScreenVertex, 3> corners(std::size_t triangle) const {
        const std::uint32_t* at = index.data() + triangle * 3;
        return {vertices[at[0]], vertices[at[1]], vertices[at[2]]};
    }
};

// About the tile of `side` pixels at `corner`: from less than a pixel to kSmallSide wide, on the
// grid of samples, slivers and without area among them; in depth near to flat, steep, and nearly
// denormal; some twice.
Soup soup(Random& random, int count, const Corner& corner, int side = 64, double least = 0.01) {
    Soup soup;
    for (int i = 0; i < count; ++i) {
        const int size = std::min(64 << random.whole(0, 6), kSmallSide * 256),
                  grid = i % 3 == 0 ? ~15 : ~0;
        const int last = std::max(0, (side + 3) * 256 - size);
        const Corner at{corner.x * 256 + random.whole(-512, last),
                        corner.y * 256 + random.whole(-512, last)};
        Corners v;
        for (Corner& c : v)
            c = {(at.x + random.whole(0, size)) & grid, (at.y + random.whole(0, size)) & grid};
        if (i % 5 == 0) v[2] = {(v[0].x + v[1].x) / 2 + random.whole(-1, 1), (v[0].y + v[1].y) / 2};
        const double nearest = least < 0.1 && i % 11 == 0 ? 0x1p-105 : random.in(least, 0.5);
        const double steepness = std::ldexp(1.0, -random.whole(1, 12));
        for (const Corner& c : v) {
            soup.index.push_back(static_cast<std::uint32_t>(soup.vertices.size()));
            soup.vertices.push_back({c.x, c.y, nearest * (1 + random.in(0, steepness))});
        }
        if (i % 4 > 0) continue;
        const std::size_t first = soup.index.size() - 3; // another just there: of the same depths
        for (std::size_t k = first; k < first + 3; ++k)
            soup.index.push_back(soup.index[k]);
    }
    return soup;
}

// What the geometry stage hands to the tile of this area.
std::vector<BinnedTriangle> binned_of(const Soup& soup, const image::Rect& area, int samples) {
    const SampleExtent extent = extent_of(sample_pattern(samples));
    std::vector<BinnedTriangle> binned;
    for (std::size_t t = 0; t < soup.triangles(); ++t) {
        const auto v = soup.corners(t);
        const auto [left, right] = std::minmax({v[0].x, v[1].x, v[2].x});
        const auto [top, bottom] = std::minmax({v[0].y, v[1].y, v[2].y});
        const int x0 = ((left + 255 - extent.high.x) >> 8) - area.x0;
        const int x1 = ((right + 256 - extent.low.x) >> 8) - area.x0;
        const int y0 = ((top + 255 - extent.high.y) >> 8) - area.y0;
        const int y1 = ((bottom + 256 - extent.low.y) >> 8) - area.y0;
        const auto across = [&](int x) { return std::clamp(x, 0, area.width()); };
        const auto down = [&](int y) { return std::clamp(y, 0, area.height()); };
        if (across(x0) < across(x1) && down(y0) < down(y1))
            binned.push_back(BinnedTriangle::of(static_cast<std::uint32_t>(t), across(x0), down(y0),
                                                across(x1), down(y1)));
    }
    return binned;
}

SmallKind kind_of(int x0, int y0, int x1, int y1) {
    const bool one_block = x0 / 8 == (x1 - 1) / 8 && y0 / 8 == (y1 - 1) / 8;
    const int most = std::max(x1 - x0, y1 - y0);
    if (most > 3) return SmallKind::rows;
    return one_block ? SmallKind::micro : SmallKind::micro_straddling;
}

// As the geometry stage sorts them.
std::array<std::vector<BinnedTriangle>, kSmallKinds>
by_kind(const std::vector<BinnedTriangle>& binned) {
    std::array<std::vector<BinnedTriangle>, kSmallKinds> lists;
    for (const BinnedTriangle& triangle : binned) {
        const image::Rect box = triangle.box();
        const SmallKind kind = kind_of(box.x0, box.y0, box.x1, box.y1);
        lists[static_cast<std::size_t>(kind)].push_back(triangle);
    }
    return lists;
}

// Tiles of all sizes, some cut by the picture's edge.
image::Rect any_tile(Random& random, const Corner& corner) {
    const int tile = 8 << random.whole(0, 3);
    const auto side = [&] { return random.whole(0, 2) > 0 ? tile : random.whole(1, tile); };
    return {corner.x, corner.y, corner.x + side(), corner.y + side()};
}

bool is_in(const image::Rect& area, std::size_t pixel) {
    return static_cast<int>(pixel % kTileSize) < area.width() &&
           static_cast<int>(pixel / kTileSize) < area.height();
}

TEST(SmallTriangles, DrawTheSameBitsByTheirParts) {
    scanout::test::on_every_target([](const std::string&) {
        Random random(71);
        int double_depth = 0, seen = 0;
        std::array<std::size_t, kSmallKinds> of_kind{}, steep_of_kind{};
        for (int round = 0; round < 120; ++round) {
            const int samples = 1 << round % 5;
            const Corner corner{64 * random.whole(0, 400), 64 * random.whole(0, 400)};
            const image::Rect area = any_tile(random, corner);
            // The last register is not full.
            const Soup all =
                soup(random, 300 + round, corner, std::max(area.width(), area.height()));
            std::vector<std::uint32_t> whole(all.triangles());
            for (std::size_t i = 0; i < whole.size(); ++i) {
                whole[i] = static_cast<std::uint32_t>(i);
                const auto v = all.corners(i);
                double_depth += has_float_depth({v, whole[i]}) ? 0 : 1;
            }
            VisibilityTile by_kinds, by_rows, by_triangles, depth_alone;
            depth_alone.reset(area, samples, {}, TileFormat::depth_only);
            by_kinds.reset(area, samples);
            by_triangles.reset(area, samples);
            by_rows.reset(area, samples);
            const std::vector<BinnedTriangle> binned = binned_of(all, area, samples);
            const bool shows =
                by_triangles.draw(TriangleList{all.vertices, all.index, whole, whole});
            EXPECT_EQ(by_rows.draw_small(BinnedList{all.vertices, all.index, binned}), shows);
            const auto lists = by_kind(binned);
            bool some = false;
            for (const SmallKind kind : kFrontFacingKinds) {
                const auto& list = lists[static_cast<std::size_t>(kind)];
                of_kind[static_cast<std::size_t>(kind)] += list.size();
                for (const BinnedTriangle& triangle : list)
                    steep_of_kind[static_cast<std::size_t>(kind)] +=
                        has_float_depth(
                            {all.corners(triangle.spatial_index), triangle.spatial_index})
                            ? 0U
                            : 1U;
                if (by_kinds.draw_small(BinnedList{all.vertices, all.index, list, kind}))
                    some = true;
                depth_alone.draw_small(BinnedList{all.vertices, all.index, list, kind});
            }
            EXPECT_EQ(some, shows);
            for (int s = 0; s < samples; ++s)
                EXPECT_TRUE(std::ranges::equal(depth_alone.depths(s), by_kinds.depths(s)));
            int differ = 0;
            for (const VisibilityTile* tile : {&by_kinds, &by_rows})
                for (int s = 0; s < samples; ++s)
                    for (std::size_t i = 0; i < VisibilityTile::kPlane; ++i) {
                        if (!is_in(area, i)) continue;
                        differ += tile->ids(s)[i] != by_triangles.ids(s)[i] ||
                                  std::bit_cast<std::uint32_t>(tile->depths(s)[i]) !=
                                      std::bit_cast<std::uint32_t>(by_triangles.depths(s)[i]);
                        seen += by_triangles.ids(s)[i] != kNoPrimitive ? 1 : 0;
                    }
            EXPECT_EQ(differ, 0) << samples << " samples";
        }
        for (const SmallKind kind : kFrontFacingKinds) {
            EXPECT_GT(of_kind[static_cast<std::size_t>(kind)], 1000U);
            EXPECT_GT(steep_of_kind[static_cast<std::size_t>(kind)], 500U);
        }
        EXPECT_GT(double_depth, 35000);
        EXPECT_GT(seen, 400000);
    });
}

// Through the middle of a pixel, hundreds of steps long and of an area of a few: what their planes
// of depth lose by cancelling is told of small areas alone, and here it matters.
Soup slivers(Random& random, int count) {
    Soup soup;
    while (static_cast<int>(soup.triangles()) < count) {
        const int p = random.whole(300, 900), q = random.whole(-900, 900);
        int x = 0, y = 0; // p y - q x = 1
        for (x = 0; x < p && (1 + q * x) % p != 0; ++x) {
        }
        if (x == p) continue; // they have a divisor
        y = (1 + q * x) / p;
        const Corner sample{random.whole(8, 50) * 256 + 128, random.whole(8, 50) * 256 + 128};
        const int side = random.whole(0, 1) * 2 - 1;
        const Corners v = {{{sample.x - p, sample.y - q},
                            {sample.x + p, sample.y + q},
                            {sample.x - p + side * x, sample.y - q + side * y}}};
        const double nearest = random.in(0.1, 0.5), slope = random.in(-0x1p-20, 0x1p-20);
        for (const Corner& c : v) { // in a plane that is nearly flat
            soup.index.push_back(static_cast<std::uint32_t>(soup.vertices.size()));
            soup.vertices.push_back({c.x, c.y, nearest * (1 + slope * (c.x - sample.x))});
        }
    }
    return soup;
}

TEST(SmallTriangles, ThatAreSliversDrawTheSameBitsByTheirParts) {
    scanout::test::on_every_target([](const std::string&) {
        Random random(74);
        int seen = 0, differ = 0, double_depth = 0;
        for (int round = 0; round < 100; ++round) {
            const Soup all = slivers(random, 501); // the last register is not full
            const image::Rect area{0, 0, 64, 64};
            std::vector<std::uint32_t> whole(all.triangles());
            std::iota(whole.begin(), whole.end(), 0U);
            for (const std::uint32_t i : whole)
                double_depth += has_float_depth({all.corners(i), i}) ? 0 : 1;
            VisibilityTile by_kinds, by_triangles;
            by_kinds.reset(area, 1);
            by_triangles.reset(area, 1);
            by_triangles.draw(TriangleList{all.vertices, all.index, whole, whole});
            by_kinds.draw_small(BinnedList{all.vertices, all.index, binned_of(all, area, 1)});
            for (std::size_t i = 0; i < VisibilityTile::kPlane; ++i) {
                differ += by_kinds.ids(0)[i] != by_triangles.ids(0)[i] ||
                          by_kinds.depths(0)[i] != by_triangles.depths(0)[i];
                seen += by_triangles.ids(0)[i] != kNoPrimitive ? 1 : 0;
            }
        }
        EXPECT_EQ(differ, 0);
        EXPECT_GT(seen, 10000);
        EXPECT_GT(double_depth, 40000);
    });
}

TEST(SmallTriangles, BehindWhatIsDrawnLeaveTheSameBits) {
    scanout::test::on_every_target([](const std::string&) {
        Random random(72);
        int shows = 0;
        for (int round = 0; round < 20; ++round) {
            const int samples = 1 << round % 5;
            const Corner corner{64 * random.whole(0, 400), 64 * random.whole(0, 400)};
            const Soup front = soup(random, 1000, corner, 64, 0.25);
            const Soup behind = soup(random, 2000 + round, corner, 64, 0.15);
            const image::Rect area{corner.x, corner.y, corner.x + 64, corner.y + 64};
            const std::vector<BinnedTriangle> first = binned_of(front, area, samples),
                                              rest = binned_of(behind, area, samples);
            // A wall that covers the tile, not as deep in one corner as in the others.
            const auto wall = [&](int x, int y, double depth) {
                return ScreenVertex{(corner.x + x) * 256, (corner.y + y) * 256, depth};
            };
            // Two nearer ones end between blocks: next to what they hide is what they do not.
            const std::vector<ScreenVertex> walls = {
                wall(-9, -9, 0.2),   wall(200, -9, 0.24), wall(-9, 200, 0.24),
                wall(24, -200, 0.5), wall(24, 200, 0.5),  wall(-300, 0, 0.5),
                wall(-200, 40, 0.4), wall(200, 40, 0.4),  wall(0, -300, 0.4)};
            const std::vector<std::uint32_t> corners = {0, 1, 2, 3, 4, 5, 6, 7, 8},
                                             name = {0, 1, 2};
            VisibilityTile at_once, in_two, depth_alone;
            for (VisibilityTile* tile : {&at_once, &in_two, &depth_alone}) {
                tile->reset(area, samples, {},
                            tile == &depth_alone ? TileFormat::depth_only
                                                 : TileFormat::depth_and_id);
                tile->draw(TriangleList{walls, corners, name, name});
                tile->draw_small(BinnedList{front.vertices, front.index, first});
            }
            in_two.build_hi_z();
            // By the other kernel: triangles that are rejected by mistake must not be so on both
            // sides.
            std::vector<std::uint32_t> whole(behind.triangles());
            std::iota(whole.begin(), whole.end(), 0U);
            shows +=
                at_once.draw(TriangleList{behind.vertices, behind.index, whole, whole}) ? 1 : 0;
            in_two.draw_small_hi_z(BinnedList{behind.vertices, behind.index, rest});
            depth_alone.build_hi_z();
            depth_alone.draw_small_hi_z(BinnedList{behind.vertices, behind.index, rest});
            for (int s = 0; s < samples; ++s)
                EXPECT_TRUE(std::ranges::equal(depth_alone.depths(s), in_two.depths(s)));
            int differ = 0;
            for (int s = 0; s < samples; ++s)
                for (std::size_t i = 0; i < VisibilityTile::kPlane; ++i)
                    differ += in_two.ids(s)[i] != at_once.ids(s)[i] ||
                              std::bit_cast<std::uint32_t>(in_two.depths(s)[i]) !=
                                  std::bit_cast<std::uint32_t>(at_once.depths(s)[i]);
            EXPECT_EQ(differ, 0) << samples << " samples";
        }
        EXPECT_EQ(shows, 20);
    });
}

TEST(SmallTriangles, ATileKnowsWhetherNothingElseShows) {
    Random random(79);
    const Corner corner{64, 128};
    const Soup some = soup(random, 300, corner, 64, 0.25), behind = soup(random, 300, corner);
    const image::Rect area{corner.x, corner.y, corner.x + 64, corner.y + 64};
    const std::vector<BinnedTriangle> binned = binned_of(some, area, 1),
                                      others = binned_of(behind, area, 1);
    const BinnedList list{some.vertices, some.index, binned};
    const std::vector<std::uint32_t> name = {0};
    VisibilityTile tile;
    const auto begin = [&] {
        tile.reset(area, 1);
        EXPECT_TRUE(tile.draw_small(list));
        ASSERT_NE(tile.small_lists_alone(), nullptr);
        ASSERT_EQ(tile.small_lists_alone()->size(), 1U);
        EXPECT_EQ(tile.small_lists_alone()->front().triangles.data(), binned.data());
    };
    begin();
    EXPECT_FALSE(tile.draw_small(list)); // nothing shows that is not there
    EXPECT_EQ(tile.small_lists_alone()->size(), 1U);
    tile.build_hi_z();
    EXPECT_TRUE(tile.draw_small_hi_z(BinnedList{behind.vertices, behind.index, others}));
    EXPECT_EQ(tile.small_lists_alone(), nullptr);

    begin();
    tile.build_hi_z();
    EXPECT_FALSE(tile.draw_small_hi_z(list));
    EXPECT_NE(tile.small_lists_alone(), nullptr);
    tile.draw(TriangleList{behind.vertices, behind.index, name, name});
    EXPECT_EQ(tile.small_lists_alone(), nullptr);

    begin();
    tile.draw_sample(area.x0, area.y0, 0, 0.9F, 7);
    EXPECT_EQ(tile.small_lists_alone(), nullptr);

    begin();
    VisibilityTile from;
    from.reset(area, 1);
    tile.take(from, area);
    EXPECT_EQ(tile.small_lists_alone(), nullptr);

    begin();
    const std::array v = some.corners(2);
    for (const ClippedTriangle& clipped : split_polygon(
             std::array{point_on_screen(v[0]), point_on_screen(v[1]), point_on_screen(v[2])}, 0))
        tile.draw_clipped(clipped);
    EXPECT_EQ(tile.small_lists_alone(), nullptr);
}

// Each once, and nearly all beside one whose rows a loop goes over as often.
TEST(SmallTriangles, StripsStandByTheirRows) {
    scanout::test::on_every_target([](const std::string&) {
        Random random(91);
        for (const std::size_t count : {0U, 1U, 31U, 100U, 511U, 512U, 513U, 1500U}) {
            std::vector<BinnedTriangle> binned(count);
            for (std::size_t i = 0; i < count; ++i) {
                const int x = random.whole(0, 60), y = random.whole(0, 63);
                binned[i] =
                    BinnedTriangle::of(static_cast<std::uint32_t>(i), x, y,
                                       random.whole(x + 1, std::min(64, x + kSmallSide + 1)),
                                       random.whole(y + 1, std::min(64, y + kSmallSide + 1)));
            }
            std::vector<BinnedTriangle> ordered = binned;
            sort_by_rows(ordered);
            std::vector<bool> found(count);
            std::size_t alike = 0;
            for (std::size_t i = 0; i < count; ++i) {
                ASSERT_LT(ordered[i].spatial_index, count);
                EXPECT_FALSE(found[ordered[i].spatial_index]);
                found[ordered[i].spatial_index] = true;
                EXPECT_EQ(ordered[i].where, binned[ordered[i].spatial_index].where);
                if (i == 0) continue;
                const image::Rect box = ordered[i].box(), last = ordered[i - 1].box();
                // From ten rows on, which few have, it does not matter.
                alike += box.y0 % 8 == last.y0 % 8 &&
                         std::clamp(box.height(), 3, 10) == std::clamp(last.height(), 3, 10);
            }
            // 8 heights and 8 first rows, of 512 parts at a time; few parts are left as they are.
            const bool are_ordered = count >= 100;
            EXPECT_TRUE(!are_ordered || alike + 64 * ((count + 511) / 512) >= count) << alike;
        }
    });
}

TEST(SmallTriangles, ThatLieInOneTileArePlacedThere) {
    scanout::test::on_every_target([](const std::string&) {
        Random random(72);
        for (int bits = 3; bits < 7; ++bits) {
            const TileGrid grid{bits, 37};
            std::vector<VisibleTriangle> list(1000 + kRegisterPadding);
            const auto any = [&] { return static_cast<std::uint32_t>(random.whole(0, 36 * 8)); };
            for (VisibleTriangle& t : list) {
                const std::uint32_t x = any(), y = any();
                const auto side = [&] {
                    return static_cast<std::uint32_t>(
                        random.whole(1, random.whole(1, kSmallSide + 1)));
                };
                t = {static_cast<std::uint32_t>(random.bits()), y << 16 | x,
                     (y + side()) << 16 | (x + side())};
                if (random.whole(0, 9) > 0) t.from |= VisibleTriangle::kSmall;
                if (random.whole(0, 9) == 0) t.from |= VisibleTriangle::kBackFacing;
            }
            const auto live =
                std::span<const VisibleTriangle>(list).first(1000 - static_cast<std::size_t>(bits));
            BinningResult placed;
            bin_small_triangles(grid, live, placed);
            int alone = 0;
            std::array<int, kSmallKinds> of_kind{};
            for (std::size_t i = 0; i < live.size(); ++i) {
                const VisibleTriangle& t = live[i];
                const int side = 1 << bits, x = t.x0() / side, y = t.y0() / side;
                if (!t.small() || (t.x1() - 1) / side != x || (t.y1() - 1) / side != y) {
                    EXPECT_EQ(placed.tile[i], BinningResult::kNone);
                    continue;
                }
                ++alone;
                EXPECT_EQ(placed.tile[i], y * 37 + x);
                EXPECT_EQ(placed.where[i],
                          BinnedTriangle::of(t.spatial_index, t.x0() - x * side, t.y0() - y * side,
                                             t.x1() - x * side, t.y1() - y * side)
                              .where);
                const SmallKind kind = t.back_facing() ? SmallKind::back_facing
                                                       : kind_of(t.x0(), t.y0(), t.x1(), t.y1());
                EXPECT_EQ(placed.kind[i], static_cast<std::int32_t>(kind));
                ++of_kind[static_cast<std::size_t>(kind)];
            }
            for (const SmallKind kind : {SmallKind::micro, SmallKind::rows, SmallKind::back_facing})
                EXPECT_GT(of_kind[static_cast<std::size_t>(kind)], 10);
            // A tile of 8 pixels is one block.
            EXPECT_EQ(of_kind[static_cast<std::size_t>(SmallKind::micro_straddling)] > 10,
                      bits > 3);
            EXPECT_GT(alone, 100);
        }
    });
}

} // namespace
} // namespace scanout::raster::test
