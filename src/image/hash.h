// A frame's identity: XXH64, seed 0, of width and height (u32, little endian) and the RGBA8 rows.
#pragma once

#include "image/image.h"

#include <cstdint>
#include <string>

namespace scanout::image {

std::uint64_t frame_hash(const Image& image);
std::string hash_text(std::uint64_t hash); // 16 hexadecimal digits

} // namespace scanout::image
