// Pictures and files for the tests of src/image, made without the code under test.
#pragma once

#include "image/codec.h"

#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>

#include <rapidcheck.h>
#include <zlib.h>

namespace scanout::image::test {

inline Image random_picture(int width, int height, std::uint32_t seed, bool opaque) {
    std::mt19937 random(seed);
    Image image(width, height);
    for (Rgba8& p : image.pixels()) {
        const auto bits = static_cast<std::uint32_t>(random());
        p = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8),
             static_cast<std::uint8_t>(bits >> 16),
             opaque ? std::uint8_t{255} : static_cast<std::uint8_t>(bits >> 24)};
    }
    return image;
}

// Sizes from 1x1 on, odd ones included, as RapidCheck shrinks them.
inline Image any_picture(bool opaque) {
    return random_picture(*rc::gen::inRange(1, 40), *rc::gen::inRange(1, 40),
                          *rc::gen::arbitrary<std::uint32_t>(), opaque);
}

inline std::string data_path(const std::string& name) {
    return std::string(SCANOUT_SOURCE_DIR) + "/tests/image/data/" + name;
}

inline Bytes file_bytes(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// A file under construction, byte by byte.
struct Maker {
    Bytes bytes;
    Maker& text(std::string_view s) {
        bytes.insert(bytes.end(), s.begin(), s.end());
        return *this;
    }
    Maker& u8(std::initializer_list<int> values) {
        for (const int v : values)
            bytes.push_back(static_cast<std::uint8_t>(v));
        return *this;
    }
    Maker& u16(std::uint32_t v) {
        return u8({static_cast<int>(v & 255), static_cast<int>(v >> 8 & 255)});
    }
    Maker& u32(std::uint32_t v) { return u16(v & 0xffff).u16(v >> 16); }
    Maker& big32(std::uint32_t v) {
        return u8({static_cast<int>(v >> 24), static_cast<int>(v >> 16 & 255),
                   static_cast<int>(v >> 8 & 255), static_cast<int>(v & 255)});
    }
};

struct Chunk {
    std::string name;
    Bytes data;
};

inline Bytes deflated(const Bytes& data) {
    uLongf size = compressBound(static_cast<uLong>(data.size()));
    Bytes out(size);
    compress2(out.data(), &size, data.data(), static_cast<uLong>(data.size()), 9);
    out.resize(size);
    return out;
}

// A PNG of unfiltered rows (each row begins with its filter byte 0), with chunks before IDAT.
inline Bytes png_file(std::uint32_t width, std::uint32_t height, int depth, int colour_type,
                      const Bytes& rows, std::vector<Chunk> before = {}) {
    Maker header;
    header.big32(width).big32(height).u8({depth, colour_type, 0, 0, 0});
    std::vector<Chunk> chunks{{"IHDR", header.bytes}};
    chunks.insert(chunks.end(), before.begin(), before.end());
    chunks.push_back({"IDAT", deflated(rows)});
    chunks.push_back({"IEND", {}});
    Maker file;
    file.text("\x89PNG\r\n\x1a\n");
    for (const Chunk& c : chunks) {
        file.big32(static_cast<std::uint32_t>(c.data.size()));
        Maker body;
        body.text(c.name);
        body.bytes.insert(body.bytes.end(), c.data.begin(), c.data.end());
        file.bytes.insert(file.bytes.end(), body.bytes.begin(), body.bytes.end());
        file.big32(static_cast<std::uint32_t>(
            crc32(0, body.bytes.data(), static_cast<uInt>(body.bytes.size()))));
    }
    return file.bytes;
}

// A BMP header of 40 bytes; the palette, masks and rows are the caller's.
inline Maker bmp_start(std::int32_t width, std::int32_t height, int bits, std::uint32_t compression,
                       std::uint32_t pixels_at) {
    Maker file;
    file.text("BM").u32(0).u32(0).u32(pixels_at).u32(40);
    file.u32(static_cast<std::uint32_t>(width)).u32(static_cast<std::uint32_t>(height));
    file.u16(1).u16(static_cast<std::uint32_t>(bits)).u32(compression);
    for (int i = 0; i < 5; ++i)
        file.u32(0);
    return file;
}

inline Maker tga_start(int type, int width, int height, int bits, int descriptor) {
    Maker file;
    file.u8({0, 0, type, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    file.u16(static_cast<std::uint32_t>(width))
        .u16(static_cast<std::uint32_t>(height))
        .u8({bits, descriptor});
    return file;
}

} // namespace scanout::image::test
