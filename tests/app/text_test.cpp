#include "app/overlay/text.h"

#include <climits>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::app {
namespace {

using image::Image;
using image::Rect;
using image::Rgba8;

constexpr Rgba8 kPaper{10, 20, 30, 255}, kInk{250, 240, 230, 255};
constexpr const char* kBox = "\x01"; // a control character: in no font

std::string any_text() {
    const auto bytes =
        *rc::gen::container<std::vector<std::uint8_t>>(rc::gen::arbitrary<std::uint8_t>());
    return {bytes.begin(), bytes.end()};
}
const Font& any_font() {
    return **rc::gen::element(&font_regular, &font_bold, &font_large);
}

// One line in a picture that just holds it, # for ink.
std::string art(std::string_view text, const Font& font = font_regular) {
    Image image(std::max(text_width(text, 1, font), 1), font.height, kPaper);
    draw_text(image, 0, 0, text, kInk, 1, font);
    std::string out;
    for (int y = 0; y < image.height(); ++y) {
        for (const Rgba8& p : image.row(y))
            out += p == kInk ? '#' : '.';
        out += '\n';
    }
    return out;
}

RC_GTEST_PROP(Text, TouchesNoPixelOutsideTheRectangleItReturns, ()) {
    Image image(60, 40, kPaper);
    const int x = *rc::gen::inRange(-200, 80), y = *rc::gen::inRange(-80, 60),
              scale = *rc::gen::inRange(1, 5);
    const Font& font = any_font();
    const std::string text = any_text();
    const Rect touched = draw_text(image, x, y, text, kInk, scale, font);
    for (int py = 0; py < image.height(); ++py)
        for (int px = 0; px < image.width(); ++px) {
            const bool inside =
                px >= touched.x0 && px < touched.x1 && py >= touched.y0 && py < touched.y1;
            RC_ASSERT(image.at(px, py) == kPaper || (inside && image.at(px, py) == kInk));
        }
    if (touched.empty()) return;
    RC_ASSERT(touched.x0 == std::max(x, 0) && touched.y0 == std::max(y, 0));
    RC_ASSERT(touched.x1 == std::min(x + text_width(text, scale, font), image.width()));
    RC_ASSERT(touched.y1 == std::min(y + font.height * scale, image.height()));
}

RC_GTEST_PROP(Text, IsTheSamePixelsWhereverItStands, ()) {
    const std::string text = any_text();
    const Font& font = any_font();
    const int x = *rc::gen::inRange(-300, 90), y = *rc::gen::inRange(-40, 40);
    Image wide(500, 120, kPaper), here(90, 40, kPaper);
    draw_text(wide, 300 + x, 40 + y, text, kInk, 1, font);
    draw_text(here, x, y, text, kInk, 1, font);
    for (int py = 0; py < here.height(); ++py)
        for (int px = 0; px < here.width(); ++px)
            RC_ASSERT(here.at(px, py) == wide.at(300 + px, 40 + py));
}

RC_GTEST_PROP(Text, ScaleRepeatsEveryPixel, ()) {
    const std::string text = any_text();
    const int scale = *rc::gen::inRange(2, 5), x = *rc::gen::inRange(-20, 20),
              y = *rc::gen::inRange(-20, 20);
    Image small(40, 30, kPaper), large(40 * scale, 30 * scale, kPaper);
    draw_text(small, x, y, text, kInk);
    draw_text(large, x * scale, y * scale, text, kInk, scale);
    for (int py = 0; py < large.height(); ++py)
        for (int px = 0; px < large.width(); ++px)
            RC_ASSERT(large.at(px, py) == small.at(px / scale, py / scale));
}

RC_GTEST_PROP(Text, ALineIsItsPartsSideBySide, ()) {
    const std::string left = *rc::gen::container<std::string>(rc::gen::inRange<char>(' ', '~'));
    const std::string right = any_text();
    Image whole(300, 20, kPaper), parts(300, 20, kPaper);
    draw_text(whole, 3, 2, left + right, kInk);
    draw_text(parts, 3, 2, left, kInk);
    draw_text(parts, 3 + text_width(left), 2, right, kInk);
    RC_ASSERT(whole == parts);
    RC_ASSERT(text_width(left + right) == text_width(left) + text_width(right));
}

TEST(Text, EveryPrintableCharacterHasAFaceOfItsOwn) {
    for (const Font* font : {&font_regular, &font_bold, &font_large}) {
        std::set<std::string> faces{art(kBox, *font)};
        for (char c = ' '; c <= '~'; ++c)
            faces.insert(art(std::string(1, c), *font));
        EXPECT_EQ(faces.size(), 96u) << font->width << "x" << font->height;
    }
}

TEST(Text, TheSymbolsOfTheOverlayAreThere) {
    for (const Font* font : {&font_regular, &font_bold, &font_large})
        for (const char* symbol :
             {"°", "×", "·", "•", "±", "µ", "é", "ß", "–", "…", "←", "↑", "→", "↓", "─"})
            EXPECT_NE(art(symbol, *font), art(kBox, *font)) << symbol;
    for (const Font* font : {&font_regular, &font_large})
        for (const char* symbol : {"■", "□", "▲", "▼", "∞"})
            EXPECT_NE(art(symbol, *font), art(kBox, *font)) << symbol;
}

TEST(Text, GlyphsStandInTheOrderOfTheirCodes) {
    for (const Font* font : {&font_regular, &font_bold, &font_large})
        for (std::size_t i = 1; i < font->glyphs.size(); ++i)
            EXPECT_LT(font->glyphs[i - 1].code, font->glyphs[i].code);
}

TEST(Text, LooksAsInTheFont) {
    EXPECT_EQ(art("Ag→"), "...........................\n"
                          "...........................\n"
                          "....#......................\n"
                          "...#.#.....................\n"
                          "..#...#...............#....\n"
                          ".#.....#...####.#......#...\n"
                          ".#.....#..#....#........#..\n"
                          ".#.....#..#....#...#######.\n"
                          ".#######..#....#........#..\n"
                          ".#.....#...####........#...\n"
                          ".#.....#..#...........#....\n"
                          ".#.....#...#####...........\n"
                          "..........#.....#..........\n"
                          "..........#.....#..........\n"
                          "...........#####...........\n");
}

TEST(Text, ASpaceLeavesNoInkAndABoxIsAnOutline) {
    EXPECT_EQ(art(" ").find('#'), std::string::npos);
    const std::string box = art(kBox);
    EXPECT_EQ(std::count(box.begin(), box.end(), '#'), 2 * 7 + 2 * 11);
}

TEST(Text, BrokenUtf8IsABoxAByteAndWholeCharactersAreOneCell) {
    const auto boxes = [](int count) {
        std::string text;
        for (int i = 0; i < count; ++i)
            text += kBox;
        return art(text);
    };
    EXPECT_EQ(text_width("aé→"), 3 * kGlyphWidth);
    EXPECT_EQ(art("\xff\xfe"), boxes(2));
    EXPECT_EQ(art("\xc3"), boxes(1));             // cut
    EXPECT_EQ(art("\xe2\x86"), boxes(2));         // cut
    EXPECT_EQ(art("\xc0\xa0"), boxes(2));         // a space, too long
    EXPECT_EQ(art("\xe0\x80\xa0"), boxes(3));     // the same
    EXPECT_EQ(art("\xed\xa0\x80"), boxes(3));     // half a surrogate pair
    EXPECT_EQ(art("\xf4\x90\x80\x80"), boxes(4)); // past the last code point
    EXPECT_EQ(art("\x80"), boxes(1));             // a tail without a head
    EXPECT_EQ(art("\xf0\x9f\x90\x84"), boxes(1)); // a cow: whole, but in no bitmap font
    EXPECT_EQ(art("\n\t"), boxes(2));
    EXPECT_EQ(art("\xc3"
                  "a"),
              art(std::string(kBox) + "a"));
}

TEST(Text, TheEndsOfTheIntegersAreSafe) {
    Image image(20, 20, kPaper);
    for (const int x : {INT_MIN, -1, INT_MAX})
        for (const int y : {INT_MIN, INT_MAX}) {
            EXPECT_TRUE(draw_text(image, x, y, "far away", kInk, INT_MAX / 2).empty() ||
                        (x != INT_MAX && y == INT_MIN));
            EXPECT_TRUE(draw_panel(image, {x, y, x, y}, kInk).empty());
        }
    EXPECT_EQ(draw_panel(image, {INT_MIN, INT_MIN, INT_MAX, INT_MAX}, {0, 0, 0, 0}),
              (Rect{0, 0, 20, 20}));
    EXPECT_TRUE(draw_panel(image, {5, 5, 3, 9}, kInk).empty());
}

RC_GTEST_PROP(Panel, IsTheRoundedMeanInsideAndNothingOutside, ()) {
    Image image(12, 9);
    std::uint8_t code = 0;
    for (Rgba8& p : image.pixels())
        p = {code++, code++, code++, code++};
    const Image before = image;
    const Rgba8 colour{*rc::gen::arbitrary<std::uint8_t>(), 128, 3,
                       *rc::gen::arbitrary<std::uint8_t>()};
    const Rect area{*rc::gen::inRange(-5, 15), *rc::gen::inRange(-5, 15), *rc::gen::inRange(-5, 15),
                    *rc::gen::inRange(-5, 15)};
    const Rect inside = draw_panel(image, area, colour);
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const Rgba8 was = before.at(x, y), is = image.at(x, y);
            const bool in = x >= area.x0 && x < area.x1 && y >= area.y0 && y < area.y1;
            RC_ASSERT(in == (x >= inside.x0 && x < inside.x1 && y >= inside.y0 && y < inside.y1));
            const double weight = colour.a / 255.0;
            const auto near = [&](int got, int under, int over) {
                return in ? std::abs(got - (under + (over - under) * weight)) <= 0.5 + 1e-9
                          : got == under;
            };
            RC_ASSERT(near(is.r, was.r, colour.r) && near(is.g, was.g, colour.g) &&
                      near(is.b, was.b, colour.b));
            RC_ASSERT(is.a == was.a);
        }
}

} // namespace
} // namespace scanout::app
