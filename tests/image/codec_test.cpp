#include "image/codec.h"
#include "pictures.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::image {
namespace {

using namespace test;

RC_GTEST_PROP(Codec, PngGivesBackEveryPicture, ()) {
    const Image picture = any_picture(*rc::gen::arbitrary<bool>());
    const auto file = encode_png(picture);
    RC_ASSERT(file.has_value());
    const auto back = decode(*file, "x.png");
    RC_ASSERT(back.has_value());
    RC_ASSERT(*back == picture);
}

RC_GTEST_PROP(Codec, PamGivesBackEveryPicture, ()) {
    const Image picture = any_picture(*rc::gen::arbitrary<bool>());
    const auto back = decode(encode_pam(picture), "x.pam");
    RC_ASSERT(back.has_value());
    RC_ASSERT(*back == picture);
}

RC_GTEST_PROP(Codec, PpmGivesBackEveryPictureWithoutItsAlpha, ()) {
    Image picture = any_picture(*rc::gen::arbitrary<bool>());
    const auto back = decode(encode_ppm(picture), "x.ppm");
    RC_ASSERT(back.has_value());
    for (Rgba8& p : picture.pixels())
        p.a = 255;
    RC_ASSERT(*back == picture);
}

RC_GTEST_PROP(Codec, TheSamePictureGivesTheSameBytes, ()) {
    const Image picture = any_picture(false);
    RC_ASSERT(*encode_png(picture) == *encode_png(Image(picture)));
}

TEST(Codec, APngHasAlphaOnlyIfSomePixelIsNotOpaque) {
    constexpr std::size_t kColourType = 25;
    Image picture = random_picture(5, 3, 1, true);
    EXPECT_EQ(encode_png(picture)->at(kColourType), 2); // RGB
    picture.at(4, 2).a = 254;
    EXPECT_EQ(encode_png(picture)->at(kColourType), 6); // RGBA
}

TEST(Codec, PpmAndPamAreByteExact) {
    Image picture(2, 1);
    picture.at(0, 0) = {1, 2, 3, 4};
    picture.at(1, 0) = {250, 251, 252, 253};
    Maker ppm, pam;
    ppm.text("P6\n2 1\n255\n").u8({1, 2, 3, 250, 251, 252});
    pam.text("P7\nWIDTH 2\nHEIGHT 1\nDEPTH 4\nMAXVAL 255\nTUPLTYPE RGB_ALPHA\nENDHDR\n");
    pam.u8({1, 2, 3, 4, 250, 251, 252, 253});
    EXPECT_EQ(encode_ppm(picture), ppm.bytes);
    EXPECT_EQ(encode_pam(picture), pam.bytes);
}

TEST(Codec, NetpbmHeadersMayHaveCommentsAndAnyWhiteSpace) {
    Maker ppm;
    ppm.text("P6 # made by hand\n#\n\t2\r\n1 # height\n 255\n").u8({1, 2, 3, 10, 20, 30});
    const auto picture = decode(ppm.bytes, "x.ppm");
    ASSERT_TRUE(picture) << picture.error().what;
    EXPECT_EQ(picture->at(0, 0), (Rgba8{1, 2, 3, 255}));
    EXPECT_EQ(picture->at(1, 0), (Rgba8{10, 20, 30, 255}));
}

TEST(Codec, PamSamplesAreGreyGreyAlphaRgbOrRgba) {
    const auto pam = [](int depth, std::initializer_list<int> samples) {
        Maker file;
        file.text("P7\nWIDTH 1\nHEIGHT 1\nDEPTH " + std::to_string(depth) +
                  "\nMAXVAL 255\nTUPLTYPE any words\nENDHDR\n");
        const auto picture = decode(file.u8(samples).bytes, "x.pam");
        return picture ? picture->at(0, 0) : Rgba8{};
    };
    EXPECT_EQ(pam(1, {7}), (Rgba8{7, 7, 7, 255}));
    EXPECT_EQ(pam(2, {7, 8}), (Rgba8{7, 7, 7, 8}));
    EXPECT_EQ(pam(3, {7, 8, 9}), (Rgba8{7, 8, 9, 255}));
    EXPECT_EQ(pam(4, {7, 8, 9, 10}), (Rgba8{7, 8, 9, 10}));
}

TEST(Codec, APictureWithoutPixelsHasNoPng) {
    EXPECT_FALSE(encode_png(Image()));
}

TEST(Codec, LimitsHoldForEveryFormatBothWays) {
    const DecodeLimits side{.max_side = 12}, area{.max_pixels = 90};
    const DecodeLimits enough{.max_side = 13, .max_pixels = 91};
    for (const char* name :
         {"colours.ppm", "colours_rgb.png", "colours_24.bmp", "colours_rgb.tga"}) {
        const Bytes file = file_bytes(data_path(name)); // 13 x 7
        EXPECT_TRUE(decode(file, name, enough)) << name;
        for (const DecodeLimits& limits : {side, area}) {
            const auto refused = decode(file, name, limits);
            ASSERT_FALSE(refused) << name;
            EXPECT_EQ(refused.error().exit, Exit::unreadable);
            EXPECT_EQ(
                refused.error().what.find(std::string(name) + ": 13x7 pixels are over the limit"),
                0u)
                << refused.error().what;
        }
    }
    const auto jpeg =
        decode(file_bytes(data_path("smooth.jpg")), "smooth.jpg", DecodeLimits{.max_side = 23});
    ASSERT_FALSE(jpeg);
    EXPECT_NE(jpeg.error().what.find("24x18 pixels are over"), std::string::npos)
        << jpeg.error().what;
}

TEST(Codec, ATallPictureIsOverTheLimitLikeAWideOne) {
    for (const std::string_view header : {"P6 1 16385 255\n", "P6 16385 1 255\n"}) {
        const auto refused = decode(Maker().text(header).bytes, "x.ppm");
        ASSERT_FALSE(refused);
        EXPECT_NE(refused.error().what.find("over the limit"), std::string::npos)
            << refused.error().what;
    }
}

TEST(Codec, TroubleNamesTheFileAndTheReason) {
    const auto message = [](std::string_view text, const char* name) {
        const auto picture =
            decode({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, name);
        return picture ? std::string("decoded") : picture.error().what;
    };
    EXPECT_EQ(message("", "a.png"), "a.png: the file is empty");
    EXPECT_EQ(message("<html>", "a.png"),
              "a.png: is not a picture that scanout reads (PNG, JPEG, BMP, TGA, PPM, PAM)");
    EXPECT_EQ(message("\x89PNG\r\n", "a.png"), "a.png: the file ends early");
    EXPECT_EQ(message("P6 2 x 255\n", "a.ppm"),
              "a.ppm: its header says 2x-1 pixels: the file is damaged");
    EXPECT_EQ(message("P6 2 1 65535\n", "a.ppm").find("a.ppm: only 8 bits a sample"), 0u);
    EXPECT_EQ(message("P6 2 1 255\nabcde", "a.ppm"),
              "a.ppm: ends early: 5 bytes of pixels are there, 6 are needed");
    EXPECT_EQ(message("P7\nWIDTH 2\n", "a.pam"), "a.pam: its PAM header has no end");
}

TEST(Codec, LoadReadsFilesAndNamesThoseThatItCannot) {
    const auto picture = load(data_path("colours.ppm"));
    ASSERT_TRUE(picture) << picture.error().what;
    EXPECT_EQ(picture->width(), 13);
    const auto absent = load(data_path("absent.png"));
    ASSERT_FALSE(absent);
    EXPECT_NE(absent.error().what.find("absent.png"), std::string::npos);
    EXPECT_FALSE(load(data_path("")));
}

} // namespace
} // namespace scanout::image
