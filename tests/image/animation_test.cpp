// Animated PNGs, taken apart by the specification's own words; video frames against BT.601 in
// double.
#include "image/animation.h"
#include "pictures.h"

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <zlib.h>

namespace scanout::image {
namespace {

struct Chunk {
    std::string type, data;
};

std::uint32_t u32(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value = value << 8 | static_cast<std::uint8_t>(bytes[at + i]);
    return value;
}

std::vector<Chunk> chunks_of(const Bytes& file) {
    const std::string bytes(file.begin(), file.end());
    EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
    std::vector<Chunk> chunks;
    for (std::size_t at = 8; at < bytes.size();) {
        const std::size_t size = u32(bytes, at);
        const std::string checked = bytes.substr(at + 4, size + 4);
        EXPECT_EQ(u32(bytes, at + 8 + size),
                  ::crc32(0, reinterpret_cast<const Bytef*>(checked.data()),
                          static_cast<uInt>(checked.size())));
        chunks.push_back({checked.substr(0, 4), checked.substr(4)});
        at += size + 12;
    }
    return chunks;
}

// The still PNG of a header and compressed rows.
Image still(const std::string& header, const std::string& rows) {
    std::string file = "\x89PNG\r\n\x1a\n";
    const auto add = [&](const std::string& type, const std::string& data) {
        const auto number = [&](std::size_t value) {
            for (int shift = 24; shift >= 0; shift -= 8)
                file += static_cast<char>(value >> shift & 0xff);
        };
        number(data.size());
        const std::string checked = type + data;
        file += checked;
        number(::crc32(0, reinterpret_cast<const Bytef*>(checked.data()),
                       static_cast<uInt>(checked.size())));
    };
    add("IHDR", header);
    add("IDAT", rows);
    add("IEND", "");
    const auto image =
        decode({reinterpret_cast<const std::uint8_t*>(file.data()), file.size()}, "frame");
    EXPECT_TRUE(image) << image.error().what;
    return image ? *image : Image();
}

TEST(AnimatedPng, HoldsEachPictureAsItIsAndSaysHowLongItIsShown) {
    const std::vector<Image> pictures = {test::random_picture(9, 5, 1, false),
                                         test::random_picture(9, 5, 2, false), Image(9, 5)};
    AnimatedPng animation(24);
    for (const Image& picture : pictures)
        ASSERT_TRUE(animation.add(picture));
    const std::vector<Chunk> chunks = chunks_of(animation.file());
    ASSERT_EQ(chunks[0].type, "IHDR");
    ASSERT_EQ(chunks[1].type, "acTL");
    EXPECT_EQ(u32(chunks[1].data, 0), 3U);
    EXPECT_EQ(u32(chunks[1].data, 4), 0U) << "for ever";
    EXPECT_EQ(chunks.back().type, "IEND");

    std::vector<std::string> rows;
    std::uint32_t sequence = 0;
    for (std::size_t i = 2; i + 1 < chunks.size(); ++i) {
        const auto& [type, data] = chunks[i];
        if (type == "IDAT") {
            ASSERT_EQ(rows.size(), 1U) << "the first picture is what other programs show";
            rows.back() += data;
            continue;
        }
        EXPECT_EQ(u32(data, 0), sequence++) << type;
        if (type == "fdAT") {
            ASSERT_GT(rows.size(), 1U);
            rows.back() += data.substr(4);
            continue;
        }
        ASSERT_EQ(type, "fcTL");
        EXPECT_EQ(u32(data, 4), 9U);
        EXPECT_EQ(u32(data, 8), 5U);
        EXPECT_EQ(data.substr(12, 8), std::string(8, '\0')) << "at the left and top";
        EXPECT_EQ(u32(data, 20), 1U << 16 | 24U) << "1/24 second";
        EXPECT_EQ(data.substr(24), std::string(2, '\0'));
        rows.emplace_back();
    }
    ASSERT_EQ(rows.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(still(chunks[0].data, rows[i]), pictures[i]) << i;
    const auto shown = decode(animation.file(), "animation");
    ASSERT_TRUE(shown);
    EXPECT_EQ(*shown, pictures[0]);
}

TEST(AnimatedPng, RefusesAPictureWithoutPixels) {
    AnimatedPng animation(24);
    EXPECT_FALSE(animation.add(Image()));
}

TEST(Y4m, FramesAreBt601RoundedToTheNearestCode) {
    EXPECT_EQ(y4m_header(64, 48, 30), "YUV4MPEG2 W64 H48 F30:1 Ip A1:1 C444 XCOLORRANGE=LIMITED\n");
    Image picture = test::random_picture(64, 64, 7, true);
    picture.at(0, 0) = {255, 255, 255, 255};
    picture.at(1, 0) = {0, 0, 0, 255};
    picture.at(2, 0) = {0, 0, 255, 255};
    picture.at(3, 0) = {255, 0, 0, 255};
    const Bytes frame = y4m_frame(picture);
    const std::size_t plane = 64 * 64;
    ASSERT_EQ(frame.size(), 6 + 3 * plane);
    ASSERT_EQ(std::memcmp(frame.data(), "FRAME\n", 6), 0);
    for (std::size_t i = 0; i < plane; ++i) {
        const Rgba8 p = picture.pixels()[i];
        const double r = p.r / 255.0, g = p.g / 255.0, b = p.b / 255.0;
        const double y = 0.299 * r + 0.587 * g + 0.114 * b;
        const double exact[] = {16 + 219 * y, 128 + 224 * (b - y) / 1.772,
                                128 + 224 * (r - y) / 1.402};
        for (std::size_t c = 0; c < 3; ++c)
            ASSERT_LE(std::abs(frame[6 + c * plane + i] - exact[c]), 0.5 + 1e-9) << i << ' ' << c;
    }
    EXPECT_EQ(frame[6], 235);
    EXPECT_EQ(frame[7], 16);
    EXPECT_EQ(frame[6 + plane + 2], 240);
    EXPECT_EQ(frame[6 + 2 * plane + 3], 240);
}

} // namespace
} // namespace scanout::image
