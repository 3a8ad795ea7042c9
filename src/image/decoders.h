// The decoders behind decode(), one a file format. Each is handed a file that begins as its format
// does, checks the size in the header before it allocates, and answers "name: reason" on trouble.
#pragma once

#include "image/codec.h"

#include <cstdint>
#include <span>
#include <string>

namespace scanout::image {

struct Source {
    std::span<const std::uint8_t> bytes;
    const std::string& name;
    const DecodeLimits& limits;
};

Result<Image> decode_png(const Source& file);
Result<Image> decode_jpeg(const Source& file);
Result<Image> decode_bmp(const Source& file);
Result<Image> decode_tga(const Source& file);
Result<Image> decode_netpbm(const Source& file); // P6 and P7

// Refuses empty pictures and those over the limits.
Result<void> check_size(const Source& file, std::int64_t width, std::int64_t height);

// Runs stb_image on a file that bmp.cpp or tga.cpp wrote from checked fields (reason: stb.cpp).
Result<Image> decode_by_stb(const Bytes& checked_file, const std::string& name);

// The file's bytes as little-endian numbers; the caller has checked that they are there.
inline std::uint32_t u16_at(std::span<const std::uint8_t> bytes, std::size_t at) {
    return bytes[at] | std::uint32_t{bytes[at + 1]} << 8;
}
inline std::uint32_t u32_at(std::span<const std::uint8_t> bytes, std::size_t at) {
    return u16_at(bytes, at) | u16_at(bytes, at + 2) << 16;
}

} // namespace scanout::image
