// Every kind of file that a texture comes in, written by hand or by Netpbm and libjpeg's cjpeg
// (tests/image/data/README.md), against the pixels it was made from.
#include "image/compare.h"
#include "image/decoders.h"
#include "pictures.h"

#include <cstdio>
#include <memory>

#include <gtest/gtest.h>
#include <jpeglib.h>

namespace scanout::image {
namespace {

using namespace test;

Image must_decode(const Bytes& file, const std::string& name) {
    auto picture = decode(file, name);
    EXPECT_TRUE(picture) << picture.error().what;
    return picture ? std::move(*picture) : Image();
}

Image data_picture(const std::string& name) {
    return must_decode(file_bytes(data_path(name)), name);
}

TEST(Formats, FilesOfOtherProgramsGiveThePixelsTheyWereMadeFrom) {
    for (const char* name :
         {"colours_24.bmp", "colours_24_os2.bmp", "colours_4.bmp", "colours_4_os2.bmp",
          "colours_8.bmp", "colours_8_os2.bmp", "colours_interlaced.png", "colours_rgb.png",
          "colours_map.tga", "colours_map_rle.tga", "colours_rgb.tga", "colours_rgb_rle.tga"})
        EXPECT_EQ(data_picture(name), data_picture("colours.ppm")) << name;
    for (const char* name : {"grey.png", "grey.tga", "grey_rle.tga"})
        EXPECT_EQ(data_picture(name), data_picture("grey.ppm")) << name;
    EXPECT_EQ(data_picture("two_1.bmp"), data_picture("two.ppm"));
}

TEST(Formats, JpegIsWithinItsQualityOfThePicture) {
    EXPECT_LE(compare(data_picture("smooth.jpg"), data_picture("smooth.ppm")).max_difference, 12);
    const Difference grey = compare(data_picture("grey.jpg"), data_picture("grey.ppm"));
    EXPECT_TRUE(grey.same_size);
    EXPECT_LE(grey.max_difference, 8);
}

TEST(Formats, ProgressiveAndBaselineJpegAreTheSamePicture) {
    EXPECT_EQ(data_picture("smooth_progressive.jpg"), data_picture("smooth.jpg"));
}

// ---- PNG

TEST(Formats, PngGreyOfOneTwoAndFourBitsIsSpreadOverAllCodes) {
    const Image one = must_decode(png_file(3, 1, 1, 0, {0, 0b10100000}), "1");
    EXPECT_EQ(one.at(0, 0), (Rgba8{255, 255, 255, 255}));
    EXPECT_EQ(one.at(1, 0), (Rgba8{0, 0, 0, 255}));
    const Image two = must_decode(png_file(4, 1, 2, 0, {0, 0b00011011}), "2");
    for (int x = 0; x < 4; ++x)
        EXPECT_EQ(two.at(x, 0).g, 85 * x);
    const Image four = must_decode(png_file(2, 1, 4, 0, {0, 0x3c}), "4");
    EXPECT_EQ(four.at(0, 0).b, 0x33);
    EXPECT_EQ(four.at(1, 0).b, 0xcc);
}

TEST(Formats, PngPaletteWithTransparencyBecomesRgba) {
    const Bytes palette{10, 20, 30, 40, 50, 60}, alpha{77};
    const Image picture =
        must_decode(png_file(2, 1, 8, 3, {0, 0, 1}, {{"PLTE", palette}, {"tRNS", alpha}}), "p");
    EXPECT_EQ(picture.at(0, 0), (Rgba8{10, 20, 30, 77}));
    EXPECT_EQ(picture.at(1, 0), (Rgba8{40, 50, 60, 255}));
}

TEST(Formats, PngColourKeyBecomesAlpha) {
    const Image picture = must_decode(
        png_file(2, 1, 8, 2, {0, 1, 2, 3, 4, 5, 6}, {{"tRNS", {0, 4, 0, 5, 0, 6}}}), "k");
    EXPECT_EQ(picture.at(0, 0), (Rgba8{1, 2, 3, 255}));
    EXPECT_EQ(picture.at(1, 0), (Rgba8{4, 5, 6, 0}));
}

TEST(Formats, PngOfSixteenBitsIsRoundedToEight) {
    // 0x80ff / 257 = 128.49..., 0x0081 / 257 = 0.50...
    const Image rgba = must_decode(
        png_file(1, 1, 16, 6, {0, 0x80, 0xff, 0x00, 0x81, 0xff, 0xff, 0x12, 0x12}), "16");
    EXPECT_EQ(rgba.at(0, 0), (Rgba8{0x80, 0x01, 0xff, 0x12}));
    const Image grey = must_decode(png_file(1, 1, 16, 4, {0, 0x40, 0x40, 0xff, 0xff}), "g16");
    EXPECT_EQ(grey.at(0, 0), (Rgba8{0x40, 0x40, 0x40, 255}));
}

TEST(Formats, PngGammaAndTextChangeNoPixel) {
    const Bytes row{0, 9, 8, 7}, gamma{0, 1, 0, 0}, text{'a', 0, 'b'};
    EXPECT_EQ(must_decode(png_file(1, 1, 8, 2, row, {{"gAMA", gamma}, {"tEXt", text}}), "g"),
              must_decode(png_file(1, 1, 8, 2, row), "plain"));
}

// ---- BMP

TEST(Formats, BmpRowsRunUpOrDownAsTheSignOfTheHeightSays) {
    for (const int height : {2, -2}) {
        Maker file = bmp_start(1, height, 24, 0, 54);
        file.u8({3, 2, 1, 0, 6, 5, 4, 0});
        const Image picture = must_decode(file.bytes, "b");
        EXPECT_EQ(picture.at(0, height > 0 ? 1 : 0), (Rgba8{1, 2, 3, 255}));
        EXPECT_EQ(picture.at(0, height > 0 ? 0 : 1), (Rgba8{4, 5, 6, 255}));
    }
}

TEST(Formats, BmpBitFieldsPlaceTheChannels) {
    Maker file = bmp_start(2, 1, 16, 3, 66);
    file.u32(0xf800).u32(0x07e0).u32(0x001f).u16(0xf800).u16(0x07e0);
    const Image rgb565 = must_decode(file.bytes, "565");
    EXPECT_EQ(rgb565.at(0, 0), (Rgba8{255, 0, 0, 255}));
    EXPECT_EQ(rgb565.at(1, 0), (Rgba8{0, 255, 0, 255}));
    Maker swapped = bmp_start(1, 1, 32, 3, 66);
    swapped.u32(0x000000ff).u32(0x0000ff00).u32(0x00ff0000).u32(0x00030201);
    EXPECT_EQ(must_decode(swapped.bytes, "rgbx").at(0, 0), (Rgba8{1, 2, 3, 255}));
}

TEST(Formats, BmpBitFieldsThatCannotBeReadAreRefused) {
    const auto message = [](std::uint32_t red, std::uint32_t green, std::uint32_t blue) {
        Maker file = bmp_start(1, 1, 32, 3, 66);
        file.u32(red).u32(green).u32(blue).u32(0);
        const auto picture = decode(file.bytes, "x.bmp");
        return picture ? std::string("decoded") : picture.error().what;
    };
    EXPECT_EQ(message(0x3ff00000, 0xffc00, 0x3ff),
              "x.bmp: bit fields of more than 8 bits are not supported");
    EXPECT_EQ(message(0xa0000000, 0xff00, 0xff), "x.bmp: a bit field with gaps is not supported");
    EXPECT_EQ(message(0xff0000, 0, 0xff), "x.bmp: its bit fields leave out a colour");
}

TEST(Formats, BmpOfThirtyTwoBitsHasAlphaUnlessAllOfItIsZero) {
    Maker opaque = bmp_start(2, 1, 32, 0, 54);
    opaque.u8({3, 2, 1, 0, 6, 5, 4, 0});
    EXPECT_EQ(must_decode(opaque.bytes, "o").at(1, 0), (Rgba8{4, 5, 6, 255}));
    Maker alpha = bmp_start(2, 1, 32, 0, 54);
    alpha.u8({3, 2, 1, 0, 6, 5, 4, 9});
    EXPECT_EQ(must_decode(alpha.bytes, "a").at(0, 0), (Rgba8{1, 2, 3, 0}));
    EXPECT_EQ(must_decode(alpha.bytes, "a").at(1, 0), (Rgba8{4, 5, 6, 9}));
}

TEST(Formats, BmpOfSixteenBitsWithoutFieldsIs1555) {
    Maker file = bmp_start(1, 1, 16, 0, 54);
    file.u16(31u << 10 | 1u << 5);
    EXPECT_EQ(must_decode(file.bytes, "1555").at(0, 0), (Rgba8{255, 8, 0, 255}));
}

TEST(Formats, BmpPixelsMayStandBehindAGapAndLackTheLastPadding) {
    Maker file = bmp_start(1, 1, 24, 0, 60);
    file.u8({0, 0, 0, 0, 0, 0, 3, 2, 1});
    EXPECT_EQ(must_decode(file.bytes, "gap").at(0, 0), (Rgba8{1, 2, 3, 255}));
}

TEST(Formats, BmpIndexPastThePaletteIsBlackEveryTime) {
    Maker file = bmp_start(4, 1, 8, 0, 58);
    file.u8({30, 20, 10, 0}).u8({0, 1, 200, 255});
    for (int i = 0; i < 3; ++i) {
        const Image picture = must_decode(file.bytes, "short palette");
        EXPECT_EQ(picture.at(0, 0), (Rgba8{10, 20, 30, 255}));
        for (int x = 1; x < 4; ++x)
            EXPECT_EQ(picture.at(x, 0), (Rgba8{0, 0, 0, 255}));
    }
}

// ---- TGA

TEST(Formats, TgaOriginMayBeAnyCorner) {
    for (const int descriptor : {0x00, 0x10, 0x20, 0x30}) {
        Maker file = tga_start(2, 2, 2, 24, descriptor);
        file.u8({1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4});
        const Image picture = must_decode(file.bytes, "x.TGA");
        const int first_x = (descriptor & 0x10) != 0 ? 1 : 0,
                  first_y = (descriptor & 0x20) != 0 ? 0 : 1;
        EXPECT_EQ(picture.at(first_x, first_y).r, 1) << descriptor;
        EXPECT_EQ(picture.at(1 - first_x, first_y).r, 2) << descriptor;
        EXPECT_EQ(picture.at(1 - first_x, 1 - first_y).r, 4) << descriptor;
    }
}

TEST(Formats, TgaAlphaIsKeptUnlessAllOfItIsZero) {
    Maker alpha = tga_start(2, 2, 1, 32, 0x28);
    alpha.u8({3, 2, 1, 0, 6, 5, 4, 200});
    EXPECT_EQ(must_decode(alpha.bytes, "x.tga").at(0, 0), (Rgba8{1, 2, 3, 0}));
    EXPECT_EQ(must_decode(alpha.bytes, "x.tga").at(1, 0), (Rgba8{4, 5, 6, 200}));
    Maker unused = tga_start(2, 1, 1, 32, 0x20);
    unused.u8({3, 2, 1, 0});
    EXPECT_EQ(must_decode(unused.bytes, "x.tga").at(0, 0), (Rgba8{1, 2, 3, 255}));
}

TEST(Formats, TgaOfFifteenAndSixteenBitsIs555) {
    for (const int bits : {15, 16}) {
        Maker file = tga_start(2, 1, 1, bits, 0x20);
        file.u16(31u << 10 | 31u);
        EXPECT_EQ(must_decode(file.bytes, "x.tga").at(0, 0), (Rgba8{255, 0, 255, 255})) << bits;
    }
}

TEST(Formats, TgaColourMapMayBeginAboveZeroAndBeUnused) {
    Maker mapped;
    mapped.u8({2, 1, 1}).u16(5).u16(2).u8({24, 0, 0, 0, 0}).u16(2).u16(1).u8({8, 0x20});
    mapped.text("id").u8({3, 2, 1, 6, 5, 4}).u8({5, 6});
    EXPECT_EQ(must_decode(mapped.bytes, "x.tga").at(0, 0), (Rgba8{1, 2, 3, 255}));
    EXPECT_EQ(must_decode(mapped.bytes, "x.tga").at(1, 0), (Rgba8{4, 5, 6, 255}));
    Maker unused;
    unused.u8({0, 1, 2}).u16(0).u16(1).u8({24, 0, 0, 0, 0}).u16(1).u16(1).u8({24, 0x20});
    unused.u8({9, 9, 9}).u8({3, 2, 1});
    EXPECT_EQ(must_decode(unused.bytes, "x.tga").at(0, 0), (Rgba8{1, 2, 3, 255}));
}

TEST(Formats, TgaRunsMayCrossRows) {
    Maker file = tga_start(10, 2, 2, 24, 0x20);
    file.u8({0x82, 3, 2, 1}).u8({0x00, 6, 5, 4}); // three of one colour, then one as it is
    const Image picture = must_decode(file.bytes, "x.tga");
    EXPECT_EQ(picture.at(0, 1), (Rgba8{1, 2, 3, 255}));
    EXPECT_EQ(picture.at(1, 1), (Rgba8{4, 5, 6, 255}));
}

// ---- JPEG

// One colour of four inks, as a JPEG whose Adobe marker says that they are stored inverted.
Bytes cmyk_jpeg(const std::array<JSAMPLE, 4>& stored) {
    jpeg_compress_struct info{};
    jpeg_error_mgr errors{};
    info.err = jpeg_std_error(&errors);
    jpeg_create_compress(&info);
    unsigned char* out = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&info, &out, &size);
    info.image_width = info.image_height = 8;
    info.input_components = 4;
    info.in_color_space = JCS_CMYK;
    jpeg_set_defaults(&info);
    jpeg_set_quality(&info, 100, TRUE);
    jpeg_start_compress(&info, TRUE);
    std::array<JSAMPLE, 32> row{};
    for (std::size_t i = 0; i < row.size(); ++i)
        row[i] = stored[i % 4];
    JSAMPROW rows = row.data();
    while (info.next_scanline < info.image_height)
        jpeg_write_scanlines(&info, &rows, 1);
    jpeg_finish_compress(&info);
    jpeg_destroy_compress(&info);
    Bytes file(out, out + size);
    std::free(out);
    return file;
}

TEST(Formats, CmykJpegMultipliesItsInksWithBlack) {
    const Image picture = must_decode(cmyk_jpeg({200, 100, 50, 128}), "cmyk");
    const Rgba8 pixel = picture.at(3, 3); // 200 * 128 / 255 and so on
    EXPECT_NEAR(pixel.r, 100, 2);
    EXPECT_NEAR(pixel.g, 50, 2);
    EXPECT_NEAR(pixel.b, 25, 2);
    EXPECT_EQ(pixel.a, 255);
}

} // namespace
} // namespace scanout::image
