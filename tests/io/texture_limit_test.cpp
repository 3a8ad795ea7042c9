// Sizes that a texture's header claims: forged headers with nothing behind them, in every format.
// Only a header that is believed too large is answered with the limit; one within it is answered
// with the pixels that are missing.
#include "base/memory.h"
#include "folder.h"
#include "io/materials.h"

#include <array>

#include <gtest/gtest.h>

namespace scanout::io {
namespace {

using test::all_lines;
using test::Folder;
using test::warned;

struct Header {
    std::string bytes;
    Header& text(std::string_view part) {
        bytes += part;
        return *this;
    }
    Header& big(std::uint32_t value, int count) {
        while (count-- > 0)
            bytes += static_cast<char>(value >> (8 * count) & 0xff);
        return *this;
    }
    Header& little(std::uint32_t value, int count) {
        for (int i = 0; i < count; ++i)
            bytes += static_cast<char>(value >> (8 * i) & 0xff);
        return *this;
    }
};

// PNG specification, annex D.
std::uint32_t crc32(std::string_view bytes) {
    std::uint32_t crc = 0xffffffff;
    for (const char c : bytes) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc & 1) != 0 ? crc >> 1 ^ 0xedb88320 : crc >> 1;
    }
    return ~crc;
}

std::string png(std::uint32_t width, std::uint32_t height) {
    const std::string chunk =
        Header().text("IHDR").big(width, 4).big(height, 4).big(8, 1).big(6, 1).big(0, 3).bytes;
    const std::string data = Header().big(100, 4).text("IDAT").bytes; // and then the file ends
    return Header().text("\x89PNG\r\n\x1a\n").big(13, 4).text(chunk).big(crc32(chunk), 4).bytes +
           data;
}

std::string jpeg(std::uint32_t width, std::uint32_t height) {
    Header h;
    h.big(0xffd8, 2).big(0xffc0, 2).big(17, 2).big(8, 1).big(height, 2).big(width, 2).big(3, 1);
    for (std::uint32_t component = 1; component <= 3; ++component)
        h.big(component, 1).big(0x11, 1).big(0, 1);
    h.big(0xffda, 2).big(12, 2).big(3, 1);
    for (std::uint32_t component = 1; component <= 3; ++component)
        h.big(component, 1).big(0, 1);
    return h.big(0x003f00, 3).bytes;
}

std::string bmp(std::uint32_t width, std::uint32_t height) {
    Header h;
    h.text("BM").little(0, 4).little(0, 4).little(54, 4);
    h.little(40, 4).little(width, 4).little(height, 4).little(1, 2).little(24, 2);
    return h.little(0, 4).little(0, 4).little(0, 4).little(0, 4).little(0, 4).little(0, 4).bytes;
}

std::string tga(std::uint32_t width, std::uint32_t height) {
    Header h;
    h.little(0, 2).little(2, 1).little(0, 4).little(0, 4).little(0, 1);
    return h.little(width, 2).little(height, 2).little(24, 1).little(0, 1).bytes;
}

struct Format {
    const char* name;
    std::string (*header)(std::uint32_t width, std::uint32_t height);
};
constexpr std::array kFormats{Format{"t.png", png}, Format{"t.jpg", jpeg}, Format{"t.bmp", bmp},
                              Format{"t.tga", tga}};

constexpr std::uint64_t kDefault = kTextureBytes;

// What is said of a texture that is named beside others in one library.
struct LoadedWithin {
    Materials materials;
    Warnings warnings;
};
LoadedWithin load(const Folder& folder, const std::vector<std::string>& textures,
                  std::uint64_t texture_bytes = kDefault) {
    std::string mtl, obj = "v 0 0 0\nmtllib m.mtl\n";
    for (std::size_t i = 0; i < textures.size(); ++i) {
        mtl += fmt::format("newmtl m{}\nmap_Kd {}\n", i, textures[i]);
        obj += fmt::format("usemtl m{}\n", i);
    }
    folder.write("m.mtl", mtl);
    LoadedWithin l;
    const auto file = read_obj(obj, folder.path("m.obj"), l.warnings);
    EXPECT_TRUE(file);
    const std::string path = folder.path("m.obj");
    l.warnings = {};
    l.materials = load_materials(*file, path, l.warnings, {.texture_bytes = texture_bytes});
    return l;
}

bool is_over_the_limit(const Folder& folder, const Format& format, std::uint32_t width,
                       std::uint32_t height, std::uint64_t texture_bytes = kDefault) {
    folder.write(format.name, format.header(width, height));
    [[maybe_unused]] const std::uint64_t before = peak_resident_bytes();
    const LoadedWithin l = load(folder, {format.name}, texture_bytes);
    EXPECT_TRUE(l.materials.textures.empty()) << format.name;
    EXPECT_EQ(l.warnings.lines().size(), 1u) << all_lines(l.warnings);
    const bool over = warned(
        l.warnings, {format.name, fmt::format("{}x{} pixels are over the limit", width, height)});
#ifndef SCANOUT_SANITIZED
    if (over) {
        EXPECT_LT(peak_resident_bytes(), before + 4'000'000) << format.name;
    }
#endif
    return over;
}

TEST(TextureLimit, OneTextureMayHaveTwoToThe26PixelsAndNotOneRowMore) {
    const Folder folder;
    for (const Format& format : kFormats) {
        EXPECT_TRUE(is_over_the_limit(folder, format, 8192, 8193)) << format.name;
        EXPECT_TRUE(is_over_the_limit(folder, format, 16384, 16384)) << format.name;
        EXPECT_TRUE(is_over_the_limit(folder, format, 16385, 1)) << format.name;
        EXPECT_TRUE(is_over_the_limit(folder, format, 1, 16385)) << format.name;
        EXPECT_TRUE(is_over_the_limit(folder, format, 65500, 65500)) << format.name;
        EXPECT_FALSE(is_over_the_limit(folder, format, 16, 16384)) << format.name;
    }
    for (const Format& format : {kFormats[0], kFormats[2]}) // sizes of four bytes
        EXPECT_TRUE(is_over_the_limit(folder, format, 0x7fffffff, 0x7fffffff)) << format.name;
}

TEST(TextureLimit, AllTexturesTogetherMayTakeSoManyBytesAndNotOnePixelMore) {
    const Folder folder;
    constexpr std::uint64_t kNeeded = std::uint64_t{4} * 50 * 40;
    for (const Format& format : kFormats) {
        EXPECT_TRUE(is_over_the_limit(folder, format, 50, 40, kNeeded - 1)) << format.name;
        EXPECT_FALSE(is_over_the_limit(folder, format, 50, 40, kNeeded)) << format.name;
    }
}

TEST(TextureLimit, WhatIsDecodedCountsAndWhatIsRefusedDoesNot) {
    const Folder folder;
    folder.write_picture("first.png", 100, 100, {1, 2, 3, 255});
    folder.write_picture("last.png", 20, 20, {4, 5, 6, 255});
    for (const Format& format : kFormats) {
        folder.write(format.name, format.header(30, 30));
        const LoadedWithin l =
            load(folder, {"first.png", format.name, "last.png"}, 100 * 100 * 4 + 20 * 20 * 4);
        EXPECT_EQ(l.materials.textures.size(), 2u) << format.name;
        EXPECT_TRUE(
            warned(l.warnings, {format.name, "30x30 pixels are over the limit", "400 in all"}))
            << all_lines(l.warnings);
        EXPECT_EQ(
            load(folder, {"first.png", "last.png", format.name}, 100 * 100 * 4 + 20 * 20 * 4 - 1)
                .materials.textures.size(),
            1u);
    }
}

} // namespace
} // namespace scanout::io
