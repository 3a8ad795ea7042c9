// Pictures as terminals take them; what is chosen. The decoders stand in emulator.py.
#include "platform/tty/blocks.h"
#include "platform/tty/choose.h"
#include "platform/tty/kitty.h"
#include "platform/tty/sixel.h"
#include "platform/tty/sixel_within.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::tty {
namespace {

using image::Image;

TEST(Sixel, IsOneSequenceOfTheStandard) {
    Image image(4, 7, {255, 0, 0, 255});
    image.at(2, 6) = {0, 0, 255, 255};
    EXPECT_EQ(sixel_picture(image, 256), "\x1bP0;1q\"1;1;4;7#0;2;0;0;100#1;2;100;0;0"
                                         "#1!4~-#0??@$#1@@?@\x1b\\");
}

TEST(Sixel, IsWithinItsBytesByFewerColoursAndThenInSquares) {
    Image noise(500, 300);
    unsigned random = 1;
    for (image::Rgba8& p : noise.pixels()) {
        const auto next = [&] {
            return static_cast<std::uint8_t>((random = random * 1664525 + 1013904223) >> 24);
        };
        p = {next(), next(), next(), 255};
    }
    const std::string whole = sixel_within(noise, 256, std::string::npos);
    EXPECT_EQ(whole, sixel_picture(noise, 256));
    EXPECT_EQ(sixel_within(noise, 256, sixel_picture(noise, 16).size()), sixel_picture(noise, 16));
    ASSERT_GT(sixel_picture(noise, 4).size(), 50'000U);
    for (const std::size_t bytes : {50'000U, 5'000U, 2'000U}) {
        const std::string few = sixel_within(noise, 256, bytes);
        EXPECT_LE(few.size(), bytes);
        EXPECT_TRUE(few.starts_with("\x1bP0;1q\"1;1;500;300#")) << "of the same size";
        EXPECT_GT(few.size(), bytes / 8) << "and no smaller than it takes";
    }
}

RC_GTEST_PROP(Palette, few_colours_are_all_kept, ()) {
    const int colours = *rc::gen::inRange(1, 200);
    Image image(20, 10);
    for (std::size_t i = 0; i < image.pixels().size(); ++i) {
        const int colour = static_cast<int>(i) % colours; // of 200 bins
        image.pixels()[i] = {static_cast<std::uint8_t>(colour % 8 * 32),
                             static_cast<std::uint8_t>(colour / 8 % 8 * 32),
                             static_cast<std::uint8_t>(colour / 64 * 32), 255};
    }
    const Palette palette = palette_of(image, 256);
    RC_ASSERT(palette.colours.size() == static_cast<std::size_t>(colours));
    for (const image::Rgba8 p : image.pixels()) {
        const Palette::Percent shown = palette.colours[palette[p]];
        RC_ASSERT(std::abs(shown.r * 255 / 100 - p.r) <= 2);
        RC_ASSERT(std::abs(shown.g * 255 / 100 - p.g) <= 2);
        RC_ASSERT(std::abs(shown.b * 255 / 100 - p.b) <= 2);
    }
}

RC_GTEST_PROP(Palette, never_has_more_colours_than_asked_for, ()) {
    const auto codes =
        *rc::gen::container<std::vector<std::uint8_t>>(300, rc::gen::arbitrary<std::uint8_t>());
    Image image(10, 10);
    for (std::size_t i = 0; i < 100; ++i)
        image.pixels()[i] = {codes[3 * i], codes[3 * i + 1], codes[3 * i + 2], 255};
    const int most = *rc::gen::inRange(2, 64);
    RC_ASSERT(palette_of(image, most).colours.size() <= static_cast<std::size_t>(most));
}

TEST(Blocks, TheNearestOfTheCubeAndTheGreys) {
    EXPECT_EQ(nearest_of_256({0, 0, 0}), 16);
    EXPECT_EQ(nearest_of_256({255, 255, 255}), 231);
    EXPECT_EQ(nearest_of_256({8, 8, 8}), 232);
    EXPECT_EQ(nearest_of_256({238, 238, 238}), 255);
    EXPECT_EQ(nearest_of_256({95, 135, 175}), 16 + 36 + 12 + 3);
    for (int code = 0; code < 256; ++code) {
        const auto grey = static_cast<std::uint8_t>(code);
        const int n = nearest_of_256({grey, grey, grey});
        int best = 1000;
        for (int i = 0; i < 24; ++i)
            best = std::min(best, std::abs(8 + 10 * i - code));
        for (const int level : {0, 95, 135, 175, 215, 255})
            best = std::min(best, std::abs(level - code));
        const int level =
            n >= 232
                ? 8 + 10 * (n - 232)
                : std::array{0, 95, 135, 175, 215, 255}[static_cast<std::size_t>((n - 16) % 6)];
        EXPECT_EQ(std::abs(level - code), best) << code;
    }
}

TEST(Blocks, LettersStandInTheirCellsAndControlNothing) {
    Cells cells = cells_of(Image(8 * kCellPixelsAcross, 3 * kCellPixelsDown, {10, 20, 30, 255}));
    const std::vector<port::TextLine> lines{{7, 14, 15, "a\u00e4\x1b\x9b", {1, 2, 3, 255}},
                                            {-70, 0, 15, "cut at the left", {1, 2, 3, 255}},
                                            {0, 900, 15, "below", {}}};
    put_text(cells, lines);
    EXPECT_EQ(cells.at(1, 1), (Cell{"a", {1, 2, 3}, {10, 20, 30}}));
    EXPECT_EQ(cells.at(2, 1).glyph, "\u00e4");
    EXPECT_EQ(cells.at(3, 1).glyph, "?") << "no control character reaches the terminal";
    EXPECT_EQ(cells.at(4, 1).glyph, "?");
    EXPECT_EQ(cells.at(1, 0).glyph, "l") << "the twelfth";
    EXPECT_TRUE(cells.at(0, 2).glyph.empty());
}

TEST(Blocks, OnlyWhatDiffersIsWritten) {
    const Image image(4 * kCellPixelsAcross, 2 * kCellPixelsDown, {10, 20, 30, 255});
    const Cells before = cells_of(image);
    Cells after = before;
    EXPECT_EQ(written(after, before, true), "");
    after.at(2, 1).front = {200, 0, 0};
    EXPECT_EQ(written(after, before, true),
              "\x1b[2;3H\x1b[48;2;10;20;30m\x1b[38;2;200;0;0m\u2580\x1b[m");
    EXPECT_EQ(written(before, {}, true), "\x1b[1;1H\x1b[48;2;10;20;30m    \x1b[2;1H    \x1b[m");
}

constexpr WindowSize kWindow{80, 24, 0, 0};
const Facts kCell{.answers = true, .cell_width = 10, .cell_height = 20};

Facts with(Facts facts, bool kitty, bool sixel) {
    facts.kitty = kitty;
    facts.sixel = sixel;
    return facts;
}

TEST(Choose, TheBestThatTheTerminalSaidItHas) {
    EXPECT_EQ(choose(with(kCell, true, true), kWindow, Protocol::automatic, false)->protocol,
              Protocol::kitty);
    const Choice sixel = *choose(with(kCell, false, true), kWindow, Protocol::automatic, false);
    EXPECT_EQ(sixel.protocol, Protocol::sixel);
    EXPECT_EQ(sixel.width, 800);
    EXPECT_EQ(sixel.height, 456) << "23 rows of 20, cut to six";
    const Choice blocks = *choose(kCell, kWindow, Protocol::automatic, false);
    EXPECT_EQ(blocks.protocol, Protocol::blocks);
    EXPECT_NE(blocks.why, "");
    EXPECT_EQ(blocks.width, 560);
    EXPECT_EQ(blocks.height, 336);
    EXPECT_EQ(choose(kCell, kWindow, Protocol::blocks, false)->why, "") << "it was asked for";
}

TEST(Choose, ACellOfUnknownSizeIsNeverGuessed) {
    const Facts unknown = with({.answers = true}, true, true);
    EXPECT_EQ(choose(unknown, kWindow, Protocol::automatic, false)->protocol, Protocol::blocks);
    EXPECT_EQ(choose(unknown, {80, 24, 800, 480}, Protocol::automatic, false)->width, 800);
    EXPECT_EQ(choose(unknown, kWindow, Protocol::sixel, false).error().exit, Exit::no_display);
    EXPECT_EQ(choose(unknown, kWindow, Protocol::kitty, false).error().exit, Exit::no_display);
}

TEST(Choose, AWindowOfOneCellHasAPictureNevertheless) {
    for (const Protocol asked : {Protocol::kitty, Protocol::sixel, Protocol::blocks}) {
        const Choice choice = *choose(kCell, {1, 1, 0, 0}, asked, false);
        EXPECT_GT(choice.width, 0);
        EXPECT_GT(choice.height, 0);
    }
    EXPECT_GT(
        choose({.cell_width = 1, .cell_height = 1}, {1, 1, 0, 0}, Protocol::sixel, false)->height,
        0);
}

TEST(Choose, AWindowWithoutCellsIsRefused) {
    for (const WindowSize& window :
         {WindowSize{}, WindowSize{0, 24, 0, 0}, WindowSize{80, 0, 0, 0}})
        EXPECT_EQ(choose({.answers = true}, window, Protocol::automatic, false).error().exit,
                  Exit::no_display);
}

TEST(Choose, APictureHasAtMost16MillionPixelsAndKeepsItsShape) {
    const auto pixels = [](const Choice& c) { return std::int64_t{c.width} * c.height; };
    const WindowSize window{900, 300, 0, 0}; // 9000x6000 pixels
    for (const Protocol asked : {Protocol::kitty, Protocol::sixel}) {
        const Choice choice = *choose(with(kCell, true, true), window, asked, false);
        EXPECT_LE(pixels(choice), kMostPixels);
        EXPECT_GE(pixels(choice), kMostPixels * 98 / 100);
        EXPECT_NEAR(choice.width, choice.height * 1.5, 25);
    }
    const Choice kitty = *choose(with(kCell, true, true), window, Protocol::kitty, false);
    EXPECT_TRUE(kitty.scaled && kitty.columns == 900 && kitty.rows == 300) << "the whole window";
    EXPECT_NE(kitty_picture(Image(2, 2), 7, 900, 300).find(",c=900,r=300,"), std::string::npos);
    EXPECT_EQ(kitty_picture(Image(2, 2), 7).find(",c="), std::string::npos);
    EXPECT_FALSE(choose(with(kCell, true, true), kWindow, Protocol::kitty, false)->scaled);
    constexpr int kMost = 65535;
    const Facts large{.answers = true, .kitty = true, .cell_width = 1000, .cell_height = 1000};
    for (const WindowSize& extreme : {WindowSize{kMost, kMost, 0, 0}, WindowSize{kMost, 1, 0, 0},
                                      WindowSize{1, kMost, 0, 0}, WindowSize{9999, 9999, 0, 0}})
        for (const Protocol asked : {Protocol::kitty, Protocol::sixel, Protocol::blocks}) {
            const Choice choice = *choose(large, extreme, asked, false);
            EXPECT_GE(pixels(choice), 1);
            EXPECT_LE(pixels(choice), kMostPixels);
        }
}

TEST(Choose, ARefusedPictureIsFollowedByTheNextBestAndItIsSaidWhy) {
    for (const Protocol asked : {Protocol::automatic, Protocol::kitty}) {
        Facts facts = with(kCell, true, true);
        facts.refusal = "ENOMEM:no";
        const Choice sixel = *choose(facts, kWindow, asked, false);
        EXPECT_EQ(sixel.protocol, Protocol::sixel);
        EXPECT_NE(sixel.why.find("ENOMEM:no"), std::string::npos);
        facts.sixel = false;
        const Choice blocks = *choose(facts, kWindow, asked, false);
        EXPECT_EQ(blocks.protocol, Protocol::blocks);
        EXPECT_NE(blocks.why.find("ENOMEM:no"), std::string::npos);
    }
}

} // namespace
} // namespace scanout::tty
