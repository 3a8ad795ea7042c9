// Whether bench_peers sees that a side draws less, of pictures that are made up.
#include "bench/peers/compare.h"
#include "bench/peers/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanout::bench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr image::Rgba8 kBack{0, 50, 55, 255}, kModel{180, 160, 140, 255};
constexpr int kWidth = 192, kHeight = 108;
constexpr image::Rect kWhole{76, 34, 116, 74}; // a block in the middle: 8 % of the picture

image::Image block(const image::Rect& area) {
    image::Image picture(kWidth, kHeight, kBack);
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x)
            picture.at(x, y) = kModel;
    return picture;
}

std::vector<std::string> missed(const Difference& difference) {
    Duel d;
    d.theirs.cpu = d.theirs.wall = {40};
    d.ours.cpu = d.ours.wall = {4};
    d.difference = difference;
    Report r;
    r.duels.emplace_back(Load{"block", "block", Shading::depth, 1, 0, 0}, d);
    return judge(r).missed;
}

TEST(Compare, ATwentiethLeftOutIsSeenOnEitherSideThoughAMeanIsBlindToIt) {
    image::Rect less = kWhole;
    less.x1 -= kWhole.width() / 20;
    for (const PicturePair& pair :
         {PicturePair{block(kWhole), block(less)}, {block(less), block(kWhole)}}) {
        const Difference d = difference(pair, kBack);
        EXPECT_LT(d.flip, kMaxFlip);
        EXPECT_DOUBLE_EQ(d.one_sided, 0.05);
        EXPECT_THAT(missed(d), ElementsAre(HasSubstr("one side alone covers 5.00 %")));
    }
}

TEST(Compare, WhatIsDrawnElsewhereDoesNotMakeUpForIt) {
    image::Rect moved = kWhole;
    moved.x0 += 1;
    moved.x1 += 1;
    EXPECT_DOUBLE_EQ(difference({block(kWhole), block(moved)}, kBack).one_sided, 2.0 / 41);
}

TEST(Compare, APixelInAThousandOnAnEdgeIsNotLess) {
    image::Image edge = block(kWhole);
    edge.at(kWhole.x0, kWhole.y0) = kBack; // of 1600
    EXPECT_THAT(missed(difference({block(kWhole), std::move(edge)}, kBack)), IsEmpty());
}

TEST(Compare, OtherLightIsSeenByFlipAlone) {
    image::Image dark(kWidth, kHeight, {18, 15, 13, 255});
    const Difference d =
        difference({image::Image(kWidth, kHeight, kModel), std::move(dark)}, kBack);
    EXPECT_EQ(d.one_sided, 0);
    EXPECT_THAT(missed(d), ElementsAre(HasSubstr("FLIP")));
}

TEST(Compare, PicturesOfNothingCompareNothing) {
    const image::Image none(kWidth, kHeight, kBack);
    const Difference d = difference({none, none}, kBack);
    EXPECT_EQ(d.one_sided, 1);
    EXPECT_THAT(missed(d), ElementsAre(HasSubstr("one side alone")));
}

TEST(Compare, TheWorseOfTwoViewsCounts) {
    const Difference worst = worse({0.01, 0.3}, {0.02, 0.1});
    EXPECT_EQ(worst.flip, 0.02);
    EXPECT_EQ(worst.one_sided, 0.3);
}

} // namespace
} // namespace scanout::bench
