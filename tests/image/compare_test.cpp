#include "image/compare.h"
#include "pictures.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::image {
namespace {

using namespace test;

RC_GTEST_PROP(Compare, APictureEqualsItself, ()) {
    const Image picture = any_picture(false);
    const Difference d = compare(picture, picture);
    RC_ASSERT(d.same_size && d.max_difference == 0 && d.differing_pixels == 0 &&
              d.over_tolerance == 0);
    const Image black(picture.width(), picture.height(), {0, 0, 0, 255});
    RC_ASSERT(difference_image(picture, picture) == black);
}

RC_GTEST_PROP(Compare, IsSymmetric, ()) {
    const Image a = any_picture(false);
    const Image b =
        random_picture(a.width(), a.height(), *rc::gen::arbitrary<std::uint32_t>(), false);
    const int allowed = *rc::gen::inRange(0, 256);
    const Difference ab = compare(a, b, allowed), ba = compare(b, a, allowed);
    RC_ASSERT(ab.max_difference == ba.max_difference);
    RC_ASSERT(ab.differing_pixels == ba.differing_pixels && ab.over_tolerance == ba.over_tolerance);
    RC_ASSERT(difference_image(a, b, 3) == difference_image(b, a, 3));
}

RC_GTEST_PROP(Compare, CountsExactlyThePixelsThatWereChanged, ()) {
    const Image a(31, 17, {100, 100, 100, 100});
    Image b = a;
    const int count = *rc::gen::inRange(0, 31 * 17), delta = *rc::gen::inRange(1, 100);
    for (int i = 0; i < count; ++i) {
        Rgba8& p = b.pixels()[static_cast<std::size_t>(i)];
        std::uint8_t* channels[] = {&p.r, &p.g, &p.b, &p.a};
        *channels[i % 4] = static_cast<std::uint8_t>(i % 2 == 0 ? 100 + delta : 100 - delta);
    }
    const Difference d = compare(a, b, delta - 1);
    RC_ASSERT(d.differing_pixels == count && d.over_tolerance == count);
    RC_ASSERT(d.max_difference == (count > 0 ? delta : 0));
    RC_ASSERT(compare(a, b, delta).over_tolerance == 0);
}

TEST(Compare, DifferentSizesAreSaidAndNothingElseIs) {
    const Difference d = compare(Image(3, 2), Image(2, 3, {0, 0, 0, 0}));
    EXPECT_FALSE(d.same_size);
    EXPECT_EQ(d.differing_pixels, 0);
}

TEST(Compare, TheDifferencePictureIsAmplifiedAndClamped) {
    const Image a(1, 1, {10, 20, 30, 255}), b(1, 1, {12, 19, 130, 255});
    EXPECT_EQ(difference_image(a, b, 16).at(0, 0), (Rgba8{32, 16, 255, 255}));
    EXPECT_EQ(difference_image(a, b, 1).at(0, 0), (Rgba8{2, 1, 100, 255}));
}

TEST(Compare, ADifferenceOfAlphaAloneIsSeen) {
    const Image a(1, 1, {10, 20, 30, 255}), b(1, 1, {10, 20, 30, 250});
    EXPECT_EQ(difference_image(a, b, 10).at(0, 0), (Rgba8{50, 50, 50, 255}));
}

TEST(Compare, WhatOnlyOneOfThemHasIsWhite) {
    const Image a(2, 1), b(1, 3);
    const Image d = difference_image(a, b);
    ASSERT_EQ(d.width(), 2);
    ASSERT_EQ(d.height(), 3);
    EXPECT_EQ(d.at(0, 0), (Rgba8{0, 0, 0, 255}));
    for (const auto& [x, y] : {std::pair{1, 0}, {0, 1}, {1, 2}})
        EXPECT_EQ(d.at(x, y), (Rgba8{255, 255, 255, 255}));
}

} // namespace
} // namespace scanout::image
