#include "image/codec.h"
#include "image/pixel_format.h"
#include "pictures.h"

#include <algorithm>
#include <bitset>
#include <cstdlib>
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

Bytes encoded(const PixelFormat& format, Rgba8 pixel, int x, int y) {
    Bytes out(static_cast<std::size_t>(format.bytes_per_pixel()));
    encode_row(format, std::span(&pixel, 1), x, y, out.data());
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

// Bayer's matrix, written out.
constexpr int kBayer[8][8] = {{0, 32, 8, 40, 2, 34, 10, 42},  {48, 16, 56, 24, 50, 18, 58, 26},
                              {12, 44, 4, 36, 14, 46, 6, 38}, {60, 28, 52, 20, 62, 30, 54, 22},
                              {3, 35, 11, 43, 1, 33, 9, 41},  {51, 19, 59, 27, 49, 17, 57, 25},
                              {15, 47, 7, 39, 13, 45, 5, 37}, {63, 31, 55, 23, 61, 29, 53, 21}};

// The 8-bit codes that a channel can show, by level: the digits repeated, cut to eight.
std::vector<int> shown_codes(int bits) {
    std::vector<int> codes;
    for (int level = 0; level < 1 << bits; ++level) {
        std::string digits =
            std::bitset<8>(static_cast<unsigned>(level)).to_string().substr(8 - bits);
        codes.push_back(std::stoi((digits + digits).substr(0, 8), nullptr, 2));
    }
    return codes;
}

// The definition, in words: of the two levels around the code the upper one where the way to it is
// at least the place's threshold, (matrix + 1/2) / 64; placed in the word, low byte first.
std::uint64_t placed(std::uint8_t code, const Channel& c, int x, int y) {
    const std::vector<int> codes = shown_codes(c.bits);
    const auto above = std::upper_bound(codes.begin(), codes.end(), code);
    auto level = static_cast<std::uint64_t>(above - codes.begin() - 1);
    if (above != codes.end() &&
        (code - above[-1]) / double(above[0] - above[-1]) >= (kBayer[y % 8][x % 8] + 0.5) / 64)
        ++level;
    return level * (std::uint64_t{1} << c.offset);
}

RC_GTEST_PROP(PixelFormats, EveryLayoutIsWrittenByTheDefinition, ()) {
    const PixelFormat format = any_format();
    RC_ASSERT(check(format).has_value());
    const Image picture =
        random_picture(*rc::gen::inRange(1, 50), 1, *rc::gen::arbitrary<std::uint32_t>(), false);
    const auto bytes = static_cast<std::size_t>(format.bytes_per_pixel());
    const int x0 = *rc::gen::inRange(0, 5000), y = *rc::gen::inRange(0, 5000);
    Bytes out(static_cast<std::size_t>(picture.width()) * bytes + 1, 0xa5);
    encode_row(format, picture.row(0), x0, y, out.data());
    for (int i = 0; i < picture.width(); ++i) {
        const Rgba8 p = picture.at(i, 0);
        const int x = x0 + i;
        const std::uint64_t word = placed(p.r, format.red, x, y) + placed(p.g, format.green, x, y) +
                                   placed(p.b, format.blue, x, y);
        for (std::size_t byte = 0; byte < bytes; ++byte)
            RC_ASSERT(out[static_cast<std::size_t>(i) * bytes + byte] ==
                      (word >> (8 * byte) & 255));
    }
    RC_ASSERT(out.back() == 0xa5); // and not a byte more
}

RC_GTEST_PROP(PixelFormats, APartOfARowIsWrittenAsInTheWholeRow, ()) {
    const PixelFormat format = any_format();
    const Image picture = any_picture(true);
    const int y = *rc::gen::inRange(0, picture.height());
    const int x0 = *rc::gen::inRange(0, picture.width());
    const int x1 = *rc::gen::inRange(x0 + 1, picture.width() + 1);
    const auto bytes = static_cast<std::size_t>(format.bytes_per_pixel());
    const auto first = static_cast<std::size_t>(x0), count = static_cast<std::size_t>(x1 - x0);
    Bytes whole(static_cast<std::size_t>(picture.width()) * bytes);
    encode_row(format, picture.row(y), 0, y, whole.data());
    Bytes parts = whole;
    std::fill_n(parts.begin() + static_cast<std::ptrdiff_t>(first * bytes), count * bytes, 0xa5);
    encode_row(format, picture.row(y).subspan(first, count), x0, y, parts.data() + first * bytes);
    RC_ASSERT(parts == whole);
}

// A grey channel of this width three times: the widths that no listed format has are tested too.
PixelFormat of_width(int bits) {
    return {.bits_per_pixel = 32, .red = {0, bits}, .green = {8, bits}, .blue = {16, bits}};
}

TEST(PixelFormats, EachShownCodeIsLessThanAStepAwayAndExactWhereItCanBeShown) {
    for (int bits = 4; bits <= 8; ++bits) {
        const std::vector<int> codes = shown_codes(bits);
        for (int code = 0; code < 256; ++code) {
            const auto c = static_cast<std::uint8_t>(code);
            const Image shown = as_displayed(of_width(bits), Image(8, 8, {c, c, c, 255}));
            const auto above = std::upper_bound(codes.begin(), codes.end(), code);
            for (const Rgba8& pixel : shown.pixels()) {
                ASSERT_EQ(pixel, (Rgba8{pixel.r, pixel.r, pixel.r, 255})); // grey stays grey
                if (above[-1] == code)
                    ASSERT_EQ(pixel.r, code) << bits << " bits";
                else
                    ASSERT_TRUE(pixel.r == above[-1] || pixel.r == above[0])
                        << bits << " bits: " << code << " is shown as " << int{pixel.r};
            }
        }
    }
}

TEST(PixelFormats, TheMeanOfASquareIsTheColourWithinASixtyFourthOfAStep) {
    for (int bits = 4; bits <= 8; ++bits) {
        const std::vector<int> codes = shown_codes(bits);
        for (int code = 0; code < 256; ++code) {
            const auto c = static_cast<std::uint8_t>(code);
            // Two squares by two: whichever of them is looked at.
            const Image shown = as_displayed(of_width(bits), Image(16, 16, {c, c, c, 255}));
            const auto above = std::upper_bound(codes.begin(), codes.end() - 1, code);
            const int step = above[0] - above[-1];
            for (int square = 0; square < 4; ++square) {
                int sum = 0;
                for (int y = 0; y < 8; ++y)
                    for (int x = 0; x < 8; ++x)
                        sum += shown.at(square % 2 * 8 + x, square / 2 * 8 + y).g;
                ASSERT_LE(std::abs(sum - 64 * code), step) << bits << " bits, code " << code;
            }
        }
    }
}

TEST(PixelFormats, WithoutDitherTheNearestShownCodeIsTaken) {
    for (int bits = 4; bits <= 8; ++bits) {
        const std::vector<int> codes = shown_codes(bits);
        EXPECT_EQ(min_bits(of_width(bits)), bits);
        for (int code = 0; code < 256; ++code) {
            const auto c = static_cast<std::uint8_t>(code);
            const Image plain = without_dither(of_width(bits), Image(8, 8, {c, c, c, 255}));
            int nearest = codes[0];
            for (const int shown : codes)
                if (std::abs(shown - code) < std::abs(nearest - code)) nearest = shown;
            const auto n = static_cast<std::uint8_t>(nearest);
            ASSERT_EQ(plain, Image(8, 8, {n, n, n, 255})) << bits << " bits, code " << code;
            ASSERT_EQ(as_displayed(of_width(bits), plain), plain) << "a display keeps it";
        }
    }
}

RC_GTEST_PROP(PixelFormats, WhatADisplayShowsIsWhatItShowsOfThat, ()) {
    const PixelFormat format = any_format();
    const Image shown = as_displayed(format, any_picture(false));
    RC_ASSERT(as_displayed(format, shown) == shown);
}

RC_GTEST_PROP(PixelFormats, EightBitsAChannelLoseNothing, ()) {
    Image picture = any_picture(true);
    for (const NamedPixelFormat& format : pixel_formats())
        if (format.format.bits_per_pixel > 16)
            RC_ASSERT(as_displayed(format.format, picture) == picture);
}

TEST(PixelFormats, AreByteExactOnExamplesWorkedByHand) {
    const Rgba8 p{0x12, 0x80, 0xf0, 0x34};
    // At (1, 0) of every square the upper level begins at 32.5 / 64 of the way.
    const auto there = [&](const PixelFormat& format) { return encoded(format, p, 1, 0); };
    EXPECT_EQ(there(named("xrgb8888")), (Bytes{0xf0, 0x80, 0x12, 0x00}));
    EXPECT_EQ(there(named("xbgr8888")), (Bytes{0x12, 0x80, 0xf0, 0x00}));
    EXPECT_EQ(there(named("rgbx8888")), (Bytes{0x00, 0xf0, 0x80, 0x12}));
    EXPECT_EQ(there(named("bgrx8888")), (Bytes{0x00, 0x12, 0x80, 0xf0}));
    EXPECT_EQ(there(named("argb8888")), (Bytes{0xf0, 0x80, 0x12, 0xff}));
    EXPECT_EQ(there(named("rgba8888")), (Bytes{0xff, 0xf0, 0x80, 0x12}));
    EXPECT_EQ(there(named("rgb888")), (Bytes{0xf0, 0x80, 0x12}));
    EXPECT_EQ(there(named("bgr888")), (Bytes{0x12, 0x80, 0xf0}));
    // 5 bits: 0x12 is 2/8 of the way from 2 to 3, 0x80 is 5/9 of the way from 15 to 16, 0xf0 is 1/8
    // of the way from 29 to 30; 6 bits: 0x80 is 3/5 of the way from 31 to 32; 4 bits: 1/17 from 1
    // to 2, 9/17 from 7 to 8, 2/17 from 14 to 15.
    EXPECT_EQ(there(named("rgb565")), (Bytes{0x1d, 0x14}));   // 00010 100000 11101
    EXPECT_EQ(there(named("bgr565")), (Bytes{0x02, 0xec}));   // 11101 100000 00010
    EXPECT_EQ(there(named("xrgb1555")), (Bytes{0x1d, 0x0a})); // 0 00010 10000 11101
    EXPECT_EQ(there(named("xbgr1555")), (Bytes{0x02, 0x76})); // 0 11101 10000 00010
    EXPECT_EQ(there(named("xrgb4444")), (Bytes{0x8e, 0x01})); // 0000 0001 1000 1110
    // At (0, 0) all those go up, as 0.5 / 64 of the way is enough.
    EXPECT_EQ(encoded(named("rgb565"), p, 0, 0), (Bytes{0x1e, 0x1c})); // 00011 100000 11110
    EXPECT_EQ(encoded(named("rgb565"), p, 8, 16), (Bytes{0x1e, 0x1c}));
    // Green 6 above blue 4 above red 5 with a gap of one bit below, alpha of one bit on top: odd,
    // and real.
    const PixelFormat odd{
        .bits_per_pixel = 24, .red = {1, 5}, .green = {12, 6}, .blue = {7, 4}, .alpha = {23, 1}};
    ASSERT_TRUE(check(odd));
    EXPECT_EQ(there(odd), (Bytes{0x04, 0x07, 0x82})); // 1 00000 100000 0 1110 00010 0
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
