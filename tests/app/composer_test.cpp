#include "app/picture/composer.h"
#include "app/view/pointer.h"
#include "port/headless.h"
#include "support/random.h"

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

constexpr int kWidth = 64, kHeight = 48;

void nothing(image::Image&) {}

// A display that is given damage alone must show the frame: the law of all damage.
TEST(Composer, ADisplayThatCopiesOnlyTheDamageShowsTheFrame) {
    test::Random random(7);
    Composer composer(kWidth, kHeight);
    auto display = port::HeadlessDisplay::create(kWidth, kHeight, image::PixelFormat{});
    ASSERT_TRUE(display);
    image::Image picture(kWidth, kHeight, {10, 20, 30, 255});
    std::size_t partial = 0;
    for (int i = 0; i < 500; ++i) {
        switch (random.whole(0, 3)) {
        case 0:
            for (int n = random.whole(0, 3); n > 0; --n)
                picture.at(random.whole(0, kWidth - 1), random.whole(0, kHeight - 1)) = {
                    static_cast<std::uint8_t>(random.whole(0, 255)), 0, 0, 255};
            composer.set_picture(picture, nothing);
            break;
        case 1:
            composer.set_picture(picture, [&](image::Image& overlay) {
                overlay.at(random.whole(0, kWidth - 1), 5) = {255, 255, 255, 255};
            });
            break;
        case 2:
            composer.set_pointer(
                PixelPlace{random.whole(-20, kWidth + 20), random.whole(-20, kHeight + 20)});
            break;
        default:
            composer.set_pointer(std::nullopt);
        }
        if (random.whole(0, 2) == 0) continue; // damage piles up
        const std::vector<image::Rect> damage = composer.take_damage();
        for (const image::Rect& area : damage)
            partial += area.width() < kWidth || area.height() < kHeight;
        ASSERT_TRUE(display->present(composer.frame(), damage));
        ASSERT_EQ(display->shown(), composer.frame()) << "after change " << i;
    }
    EXPECT_GT(partial, 100U) << "damage is less than the whole frame";
}

TEST(Composer, TheSamePictureIsNoDamage) {
    Composer composer(kWidth, kHeight);
    const image::Image picture(kWidth, kHeight, {1, 2, 3, 255});
    composer.set_picture(picture, nothing);
    composer.take_damage();
    composer.set_picture(picture, nothing);
    EXPECT_TRUE(composer.take_damage().empty());
}

TEST(Composer, ThePointerLeavesNothingBehind) {
    Composer composer(kWidth, kHeight);
    image::Image picture(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            picture.at(x, y) = {static_cast<std::uint8_t>(x * 4), static_cast<std::uint8_t>(y * 5),
                                9, 255};
    composer.set_picture(picture, nothing);
    for (int i = -30; i < 45; ++i)
        composer.set_pointer(PixelPlace{i, i});
    EXPECT_NE(composer.frame(), picture) << "a corner of it is still on the picture";
    composer.set_pointer(std::nullopt);
    EXPECT_EQ(composer.frame(), picture);
}

TEST(Composer, DifferenceAreaIsTheSmallestRectangle) {
    image::Image before(kWidth, kHeight), after(kWidth, kHeight);
    EXPECT_TRUE(difference_area(before, after).empty());
    after.at(10, 7).r = 1;
    after.at(20, 5).g = 1;
    EXPECT_EQ(difference_area(before, after), (image::Rect{10, 5, 21, 8}));
    after.at(0, 0).b = after.at(kWidth - 1, kHeight - 1).b = 3;
    EXPECT_EQ(difference_area(before, after), (image::Rect{0, 0, kWidth, kHeight}));
}

TEST(Composer, ADisplayHasNothingBehindTransparentPixels) {
    Composer composer(kWidth, kHeight);
    composer.set_picture(image::Image(kWidth, kHeight, {5, 6, 7, 0}), nothing);
    EXPECT_EQ(composer.frame().at(3, 3), (image::Rgba8{5, 6, 7, 255}));
}

} // namespace
} // namespace scanout::app
