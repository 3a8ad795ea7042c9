#include "image/codec.h"
#include "image/pixel_format.h"
#include "pictures.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::image {
namespace {

using namespace test;

PixelFormat named(std::string_view name) {
    const auto format = pixel_format(name);
    EXPECT_TRUE(format) << name;
    return format.value_or(PixelFormat{});
}

Bytes encoded(const PixelFormat& format, Rgba8 pixel) {
    Bytes out(static_cast<std::size_t>(format.bytes_per_pixel()));
    encode_row(format, std::span(&pixel, 1), out.data());
    return out;
}

// Any layout that check() allows: channels of random widths, in random order, with random gaps.
PixelFormat any_format() {
    PixelFormat format{.bits_per_pixel = *rc::gen::element(16, 24, 32),
                       .red = {},
                       .green = {},
                       .blue = {},
                       .alpha = {}};
    std::vector<Channel*> order{&format.red, &format.green, &format.blue};
    std::shuffle(order.begin(), order.end(), std::mt19937(*rc::gen::arbitrary<std::uint32_t>()));
    int at = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const int others = 4 * (2 - static_cast<int>(i));
        const int space = format.bits_per_pixel - at - others;
        order[i]->bits = *rc::gen::inRange(4, std::min(8, space) + 1);
        order[i]->offset = at + *rc::gen::inRange(0, space - order[i]->bits + 1);
        at = order[i]->offset + order[i]->bits;
    }
    return format;
}

// The definition, in words: round to the nearest of 2^bits levels, place, add up, low byte first.
std::uint64_t placed(std::uint8_t code, const Channel& c) {
    const auto level = static_cast<std::uint64_t>(std::lround(code / 255.0 * ((1 << c.bits) - 1)));
    return level * (std::uint64_t{1} << c.offset);
}

RC_GTEST_PROP(PixelFormats, EveryLayoutIsWrittenByTheDefinition, ()) {
    const PixelFormat format = any_format();
    RC_ASSERT(check(format).has_value());
    const Image picture =
        random_picture(*rc::gen::inRange(1, 50), 1, *rc::gen::arbitrary<std::uint32_t>(), false);
    const auto bytes = static_cast<std::size_t>(format.bytes_per_pixel());
    const auto count = static_cast<std::size_t>(picture.width());
    Bytes out(count * bytes + 1, 0xa5);
    encode_row(format, picture.row(0), out.data());
    for (std::size_t x = 0; x < count; ++x) {
        const Rgba8 p = picture.pixels()[x];
        const std::uint64_t word =
            placed(p.r, format.red) + placed(p.g, format.green) + placed(p.b, format.blue);
        for (std::size_t i = 0; i < bytes; ++i)
            RC_ASSERT(out[x * bytes + i] == (word >> (8 * i) & 255));
    }
    RC_ASSERT(out.back() == 0xa5); // and not a byte more
}

RC_GTEST_PROP(PixelFormats, WhatADisplayShowsIsWhatItShowsOfThat, ()) {
    const PixelFormat format = any_format();
    const Image shown = as_displayed(format, any_picture(false));
    RC_ASSERT(as_displayed(format, shown) == shown);
}

RC_GTEST_PROP(PixelFormats, ShownCodesAreWithinHalfALevelAndKeepTheEnds, ()) {
    const PixelFormat format = any_format();
    const auto code = *rc::gen::arbitrary<std::uint8_t>();
    const Image shown = as_displayed(format, Image(1, 1, {code, code, code, 7}));
    const auto near = [&](std::uint8_t got, const Channel& c) {
        const double step = 255.0 / ((1 << c.bits) - 1);
        // Repeating digits is within one code of the exact value of the level.
        return std::abs(got - code) <= step / 2 + 1 && ((code != 0 && code != 255) || got == code);
    };
    RC_ASSERT(near(shown.at(0, 0).r, format.red) && near(shown.at(0, 0).g, format.green) &&
              near(shown.at(0, 0).b, format.blue));
    RC_ASSERT(shown.at(0, 0).a == 255);
}

RC_GTEST_PROP(PixelFormats, EightBitsAChannelLoseNothing, ()) {
    Image picture = any_picture(true);
    for (const NamedPixelFormat& format : pixel_formats())
        if (format.format.bits_per_pixel > 16)
            RC_ASSERT(as_displayed(format.format, picture) == picture);
}

TEST(PixelFormats, AreByteExactOnExamplesWorkedByHand) {
    const Rgba8 p{0x12, 0x80, 0xf0, 0x34};
    EXPECT_EQ(encoded(named("xrgb8888"), p), (Bytes{0xf0, 0x80, 0x12, 0x00}));
    EXPECT_EQ(encoded(named("xbgr8888"), p), (Bytes{0x12, 0x80, 0xf0, 0x00}));
    EXPECT_EQ(encoded(named("rgbx8888"), p), (Bytes{0x00, 0xf0, 0x80, 0x12}));
    EXPECT_EQ(encoded(named("bgrx8888"), p), (Bytes{0x00, 0x12, 0x80, 0xf0}));
    EXPECT_EQ(encoded(named("argb8888"), p), (Bytes{0xf0, 0x80, 0x12, 0xff}));
    EXPECT_EQ(encoded(named("rgba8888"), p), (Bytes{0xff, 0xf0, 0x80, 0x12}));
    EXPECT_EQ(encoded(named("rgb888"), p), (Bytes{0xf0, 0x80, 0x12}));
    EXPECT_EQ(encoded(named("bgr888"), p), (Bytes{0x12, 0x80, 0xf0}));
    // 0x12 * 31 / 255 = 2.19, 0x80 * 63 / 255 = 31.6, 0x80 * 31 / 255 = 15.56, 0xf0 * 31 / 255
    // = 29.2
    EXPECT_EQ(encoded(named("rgb565"), p), (Bytes{0x1d, 0x14}));   // 00010 100000 11101
    EXPECT_EQ(encoded(named("bgr565"), p), (Bytes{0x02, 0xec}));   // 11101 100000 00010
    EXPECT_EQ(encoded(named("xrgb1555"), p), (Bytes{0x1d, 0x0a})); // 0 00010 10000 11101
    EXPECT_EQ(encoded(named("xbgr1555"), p), (Bytes{0x02, 0x76})); // 0 11101 10000 00010
    EXPECT_EQ(encoded(named("xrgb4444"), p), (Bytes{0x8e, 0x01})); // 0000 0001 1000 1110
    // Green 6 above blue 4 above red 5 with a gap of one bit below, alpha of one bit on top: odd,
    // and real.
    const PixelFormat odd{
        .bits_per_pixel = 24, .red = {1, 5}, .green = {12, 6}, .blue = {7, 4}, .alpha = {23, 1}};
    ASSERT_TRUE(check(odd));
    EXPECT_EQ(encoded(odd, p), (Bytes{0x04, 0x07, 0x82})); // 1 00000 100000 0 1110 00010 0
}

TEST(PixelFormats, ChannelsAreWidenedByRepeatingTheirUpperDigits) {
    const auto shown = [](std::string_view name, Bytes bytes) {
        Rgba8 pixel;
        decode_row(named(name), bytes.data(), std::span(&pixel, 1));
        return pixel;
    };
    // 10110 -> 10110101, 010011 -> 01001101, 00001 -> 00001000
    EXPECT_EQ(shown("rgb565", {0x61, 0xb2}), (Rgba8{0xb5, 0x4d, 0x08, 255}));
    EXPECT_EQ(shown("xrgb4444", {0x5a, 0xf3}), (Rgba8{0x33, 0x55, 0xaa, 255}));
    EXPECT_EQ(shown("xrgb8888", {1, 2, 3, 4}), (Rgba8{3, 2, 1, 255}));
    EXPECT_EQ(shown("bgr888", {1, 2, 3}), (Rgba8{1, 2, 3, 255}));
}

TEST(PixelFormats, NamesLeadThereAndBack) {
    std::set<std::string_view> names;
    for (const NamedPixelFormat& format : pixel_formats()) {
        EXPECT_TRUE(check(format.format)) << format.name;
        EXPECT_EQ(named(format.name), format.format);
        EXPECT_EQ(name_of(format.format), format.name);
        names.insert(format.name);
    }
    EXPECT_EQ(names.size(), pixel_formats().size());
    EXPECT_EQ(name_of({.bits_per_pixel = 32, .alpha = {0, 0}}), "xrgb8888");
    EXPECT_EQ(name_of({16, {10, 6}, {4, 6}, {0, 4}, {}}),
              "16 bits, red 6 at 10, green 6 at 4, blue 4 at 0");
}

TEST(PixelFormats, AnUnknownNameIsAnsweredWithTheList) {
    const auto format = pixel_format("rgb332");
    ASSERT_FALSE(format);
    EXPECT_EQ(format.error().exit, Exit::usage);
    EXPECT_EQ(format.error().what.find("unknown pixel format 'rgb332': use one of xrgb8888 "), 0u);
}

TEST(PixelFormats, LayoutsThatCannotBeWrittenAreRefused) {
    const PixelFormat good{};
    ASSERT_TRUE(check(good));
    const auto with = [&](auto change) {
        PixelFormat format = good;
        change(format);
        return check(format).has_value();
    };
    EXPECT_FALSE(with([](PixelFormat& f) { f.bits_per_pixel = 8; }));
    EXPECT_FALSE(with([](PixelFormat& f) { f.bits_per_pixel = 16; })); // red would stand above it
    EXPECT_FALSE(with([](PixelFormat& f) { f.red = {20, 10}; }));
    EXPECT_FALSE(with([](PixelFormat& f) { f.red.bits = 0; }));
    EXPECT_FALSE(with([](PixelFormat& f) { f.green.bits = 3; }));
    EXPECT_FALSE(with([](PixelFormat& f) { f.blue.offset = 1; })); // overlaps green
    EXPECT_FALSE(with([](PixelFormat& f) { f.blue.offset = -1; }));
    EXPECT_FALSE(with([](PixelFormat& f) { f.alpha = {2000000000, 8}; }));
    EXPECT_TRUE(with([](PixelFormat& f) { f.alpha = {31, 1}; }));
}

} // namespace
} // namespace scanout::image
