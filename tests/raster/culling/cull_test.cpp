// What culling lets through, against exact arithmetic: never less than covers a sample of the
// picture, and of triangles a few pixels wide never more.
#include "raster/culling/cull.h"
#include "raster/exact.h"
#include "raster/micro/small_triangles.h"
#include "support/targets.h"

#include <algorithm>
#include <set>

namespace scanout::raster::test {
namespace {

constexpr int kWidth = 61, kHeight = 47;

// Does it cover a sample of a pixel of the picture?
bool covers_a_sample(const Corners& v, std::span<const SampleOffset> pattern) {
    const ExactTriangle exact(v);
    const auto [left, right] = std::minmax({v[0].x, v[1].x, v[2].x});
    const auto [top, bottom] = std::minmax({v[0].y, v[1].y, v[2].y});
    for (int y = std::max(top >> 8, 0); y <= std::min(bottom >> 8, kHeight - 1); ++y)
        for (int x = std::max(left >> 8, 0); x <= std::min(right >> 8, kWidth - 1); ++x)
            for (const SampleOffset& s : pattern)
                if (exact.covers(x * 256 + s.x, y * 256 + s.y)) return true;
    return false;
}

struct RandomSoup {
    std::vector<ScreenVertex> vertices;
    std::vector<std::uint32_t> index;
    std::vector<Corners> triangles;
};

// Up to `most` pixels wide and high, about the picture and beyond its edges; on the grid of
// samples, slivers and without area among them.
RandomSoup soup(Random& random, int count, int most) {
    RandomSoup soup;
    for (int i = 0; i < count; ++i) {
        const Corner at{random.whole(-3 * 256, (kWidth + 3) * 256),
                        random.whole(-3 * 256, (kHeight + 3) * 256)};
        const int size = 1 << random.whole(5, 8), grid = i % 3 == 0 ? ~15 : ~0;
        Corners v;
        for (Corner& c : v)
            c = {(at.x + random.whole(0, size) * most) & grid,
                 (at.y + random.whole(0, size) * most) & grid};
        if (i % 5 == 0) v[2] = {(v[0].x + v[1].x) / 2 + random.whole(-1, 1), (v[0].y + v[1].y) / 2};
        for (const Corner& c : v) {
            soup.index.push_back(static_cast<std::uint32_t>(soup.vertices.size()));
            soup.vertices.push_back({c.x, c.y, 0.5});
        }
        soup.triangles.push_back(v);
    }
    return soup;
}

std::set<std::uint32_t> visible(const RandomSoup& soup, int samples, Facing keep,
                                bool samples_only = true, bool mirrored = false) {
    const auto pattern = sample_pattern(samples);
    const SampleExtent extent = extent_of(pattern);
    CullResult found;
    cull_triangles({kWidth, kHeight, keep, mirrored, extent,
                    samples_only ? pattern : std::span<const SampleOffset>()},
                   soup.vertices, soup.index, 1000, found);
    EXPECT_EQ(found.to_clip_count, 0U);
    std::set<std::uint32_t> ids;
    for (std::size_t i = 0; i < found.visible_count; ++i) {
        const VisibleTriangle& box = found.visible[i];
        EXPECT_TRUE(box.x0() < box.x1() && box.x1() <= kWidth);
        EXPECT_TRUE(box.y0() < box.y1() && box.y1() <= kHeight);
        EXPECT_TRUE(i == 0 || found.visible[i - 1].spatial_index < box.spatial_index); // in order
        ids.insert(box.spatial_index - 1000);
        const Corners& v = soup.triangles[box.spatial_index - 1000];
        const auto [left, right] = std::minmax({v[0].x, v[1].x, v[2].x});
        const auto [top, bottom] = std::minmax({v[0].y, v[1].y, v[2].y});
        const bool bounds = box.x0() == std::max((left + 255 - extent.high.x) >> 8, 0) &&
                            box.y0() == std::max((top + 255 - extent.high.y) >> 8, 0) &&
                            box.x1() == std::min((right + 256 - extent.low.x) >> 8, kWidth) &&
                            box.y1() == std::min((bottom + 256 - extent.low.y) >> 8, kHeight);
        EXPECT_TRUE(bounds) << box.spatial_index;
        EXPECT_EQ(box.small(), std::max(right - left, bottom - top) <= kSmallSide * 256);
        const bool clockwise =
            (v[1].x - v[0].x) * (v[2].y - v[0].y) > (v[1].y - v[0].y) * (v[2].x - v[0].x);
        EXPECT_EQ(box.back_facing(), keep == Facing::any && clockwise != mirrored);
    }
    return ids;
}

TEST(Cull, KeepsOfTinyTrianglesThoseThatCoverASampleAndNoOther) {
    Random random(31);
    int wrong = 0, covering = 0, tested = 0;
    for (int round = 0; round < 200; ++round) {
        const int samples = 1 << round % 5, most = 1 + round % 3;
        const RandomSoup all =
            soup(random, 500 + round % 17, most); // the last register is not full
        const auto left = visible(all, samples, Facing::any);
        for (std::size_t i = 0; i < all.triangles.size(); ++i) {
            const auto pattern = sample_pattern(samples);
            const bool covers = covers_a_sample(all.triangles[i], pattern);
            const bool stays = left.contains(static_cast<std::uint32_t>(i));
            wrong += stays != covers ? 1 : 0;
            covering += covers ? 1 : 0;
            ++tested;
        }
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(covering, tested / 10);
    EXPECT_LT(covering, tested * 9 / 10);
    RecordProperty("triangles", tested);
}

TEST(Cull, LosesNoTriangleThatCoversASample) {
    Random random(32);
    int lost = 0;
    for (int round = 0; round < 60; ++round) {
        const int samples = 1 << round % 5;
        const RandomSoup all = soup(random, 400, 3 + round % 40);
        const auto left = visible(all, samples, Facing::any);
        for (std::size_t i = 0; i < all.triangles.size(); ++i)
            lost += covers_a_sample(all.triangles[i], sample_pattern(samples)) &&
                            !left.contains(static_cast<std::uint32_t>(i))
                        ? 1
                        : 0;
    }
    EXPECT_EQ(lost, 0);
}

// Whatever else is in the same register, of whatever size: also where triangles stick out of the
// picture.
TEST(Cull, KeepsFrontsAndBacksApart) {
    Random random(33);
    for (int round = 0; round < 20; ++round) {
        const RandomSoup all = soup(random, 5000, 3);
        const auto wanted = visible(all, 4, Facing::any);
        scanout::test::on_every_target([&](const std::string&) {
            const auto any = visible(all, 4, Facing::any), front = visible(all, 4, Facing::front),
                       back = visible(all, 4, Facing::back);
            EXPECT_EQ(any, wanted);
            EXPECT_EQ(visible(all, 4, Facing::any, true, true), any);
            std::set<std::uint32_t> both = front;
            both.insert(back.begin(), back.end());
            EXPECT_EQ(both, any);
            EXPECT_EQ(front.size() + back.size(), any.size());
            EXPECT_GT(front.size(), 500U);
            EXPECT_GT(back.size(), 500U);
        });
    }
}

// Those with a vertex off the screen are named apart from the others, wherever in the list they
// are, but for those that are gone without clipping.
TEST(Cull, NamesWhatIsCut) {
    Random random(35);
    for (const int count : {1, 15, 16, 17, 31, 255, 256, 257, 1000}) {
        RandomSoup all = soup(random, count, 40);
        std::vector<std::uint32_t> wanted;
        std::set<std::uint32_t> off;
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
            const auto hide = [&](std::uint32_t k, std::uint32_t flags) {
                all.vertices[i * 3 + k % 3] = {ScreenVertex::kOffScreen,
                                               static_cast<std::int32_t>(flags), 0};
                off.insert(1000 + i);
            };
            const auto k = static_cast<std::uint32_t>(random.whole(0, 2));
            switch (random.whole(0, 6)) {
            case 0: // one, near the eye
                hide(k, kOutsideNear);
                wanted.push_back(1000 + i);
                break;
            case 1: // all, on either side
                hide(k, kOutsideLeft);
                hide(k + 1, kOutsideRight);
                hide(k + 2, kOutsideLeft);
                wanted.push_back(1000 + i);
                break;
            case 2: // all, on one side
                for (std::uint32_t n = 0; n < 3; ++n)
                    hide(n, kOutsideTop);
                break;
            case 3:
                hide(k, kNotFinite);
                break;
            default:
                break;
            }
        }
        scanout::test::on_every_target([&](const std::string&) {
            CullResult found;
            cull_triangles({kWidth, kHeight, Facing::any, false, extent_of(sample_pattern(1)), {}},
                           all.vertices, all.index, 1000, found);
            found.to_clip.resize(found.to_clip_count);
            EXPECT_EQ(found.to_clip, wanted) << count;
            for (std::size_t i = 0; i < found.visible_count; ++i)
                EXPECT_FALSE(off.contains(found.visible[i].spatial_index)) << count;
        });
    }
}

// Areas of pixels count also where no sample lies.
TEST(Cull, WithoutSamplesKeepsWhateverTouchesAPixel) {
    Random random(34);
    const RandomSoup all = soup(random, 5000, 1);
    EXPECT_GT(visible(all, 1, Facing::any, false).size(), visible(all, 1, Facing::any).size());
}

} // namespace
} // namespace scanout::raster::test
