#include "port/copy.h"
#include "port/headless.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::port {
namespace {

image::Image picture(int width, int height, std::uint32_t seed) {
    image::Image image(width, height);
    for (image::Rgba8& pixel : image.pixels()) {
        seed = seed * 1664525 + 1013904223;
        pixel = {static_cast<std::uint8_t>(seed >> 24), static_cast<std::uint8_t>(seed >> 16),
                 static_cast<std::uint8_t>(seed >> 8), 255};
    }
    return image;
}

RC_GTEST_PROP(HeadlessDisplay, shows_the_frame_as_a_display_of_its_format_would, ()) {
    const auto formats = image::pixel_formats();
    const auto& format = formats[*rc::gen::inRange<std::size_t>(0, formats.size())].format;
    const int width = *rc::gen::inRange(1, 20), height = *rc::gen::inRange(1, 20);
    auto display = HeadlessDisplay::create(width, height, format);
    RC_ASSERT(display.has_value());
    const image::Image frame = picture(width, height, *rc::gen::arbitrary<std::uint32_t>());
    RC_ASSERT(display->present(frame, {}).has_value());
    RC_ASSERT(display->shown() == image::as_displayed(format, frame));
    RC_ASSERT(display->frames() == 1U);
}

TEST(HeadlessDisplay, TakesDamagedPixelsOnlyAfterTheFirstFrame) {
    auto display = HeadlessDisplay::create(9, 7, {});
    ASSERT_TRUE(display);
    const image::Image one = picture(9, 7, 1), two = picture(9, 7, 2);
    ASSERT_TRUE(display->present(one, {}));
    const image::Rect damage{2, 3, 5, 4};
    ASSERT_TRUE(display->present(two, {&damage, 1}));
    for (int y = 0; y < 7; ++y)
        for (int x = 0; x < 9; ++x)
            EXPECT_EQ(display->shown().at(x, y), (x >= 2 && x < 5 && y == 3 ? two : one).at(x, y));
}

// Formats that are dithered by place, too.
RC_GTEST_PROP(CopyDamage, damage_gives_the_same_bytes_as_the_whole_frame, ()) {
    const auto formats = image::pixel_formats();
    const auto& format = formats[*rc::gen::inRange<std::size_t>(0, formats.size())].format;
    const int width = *rc::gen::inRange(1, 30), height = *rc::gen::inRange(1, 30);
    const image::Image frame = picture(width, height, *rc::gen::arbitrary<std::uint32_t>());
    const int x = *rc::gen::inRange(0, width + 1), y = *rc::gen::inRange(0, height + 1);
    const image::Rect whole[] = {{0, 0, width, height}};
    const image::Rect parts[] = {
        {0, 0, x, y}, {x, 0, width, y}, {0, y, x, height}, {x, y, width, height}};
    const std::size_t pitch =
        static_cast<std::size_t>(width) * static_cast<std::size_t>(format.bytes_per_pixel());
    std::vector<std::uint8_t> by_whole(pitch * static_cast<std::size_t>(height), 0xEE);
    std::vector<std::uint8_t> by_parts = by_whole;
    copy_damage(format, frame, whole, by_whole.data(), pitch);
    copy_damage(format, frame, parts, by_parts.data(), pitch);
    RC_ASSERT(by_parts == by_whole);
}

TEST(HeadlessDisplay, RefusesSizesAndFormatsThatNoDisplayHas) {
    for (const auto& [width, height] :
         {std::pair{0, 5}, {5, 0}, {-1, 5}, {16385, 5}, {5, 1 << 30}}) {
        const auto display = HeadlessDisplay::create(width, height, {});
        ASSERT_FALSE(display);
        EXPECT_EQ(display.error().exit, Exit::usage);
    }
    EXPECT_FALSE(HeadlessDisplay::create(4, 4, {.bits_per_pixel = 8}));
}

TEST(CopyDamage, CutsDamageToTheFrameAndWritesNoByteBesideIt) {
    const image::Image frame = picture(5, 4, 1);
    const image::PixelFormat format;
    constexpr std::size_t kPitch = 27;
    std::vector<std::uint8_t> memory(kPitch * 6, 0xEE);
    std::vector<std::uint8_t> expected = memory;
    std::uint8_t* const first = memory.data() + kPitch;
    for (int y = 0; y < 4; ++y)
        image::encode_row(format, frame.row(y), 0, y,
                          expected.data() + kPitch * static_cast<std::size_t>(y + 1));
    const image::Rect rects[] = {{-5, -9, 100, 50}, {3, 3, 3, 9}, {7, 0, 9, 2}, {4, 2, 1, 3}};
    copy_damage(format, frame, rects, first, kPitch);
    EXPECT_EQ(memory, expected);
}

// It goes there in pieces, each with the dither of its place.
TEST(CopyDamage, WritesRowsOfAnyWidth) {
    const image::PixelFormat format = *image::pixel_format("rgb565");
    for (const int width : {1023, 1024, 1025, 2049, 4101}) {
        const image::Image frame = picture(width, 2, 1);
        const std::size_t pitch = static_cast<std::size_t>(width) * 2;
        std::vector<std::uint8_t> memory(pitch * 2, 0xEE), expected = memory;
        for (int y = 0; y < 2; ++y)
            image::encode_row(format, frame.row(y), 0, y,
                              expected.data() + pitch * static_cast<std::size_t>(y));
        const image::Rect rects[] = {{0, 0, width, 2}, {3, 1, width - 2, 2}};
        copy_damage(format, frame, rects, memory.data(), pitch);
        EXPECT_EQ(memory, expected) << width;
    }
}

} // namespace
} // namespace scanout::port
