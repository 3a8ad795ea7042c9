// Picture files. Encoders give the whole file in memory (base/write_file.h writes it). Decoders
// check the size in the header before they allocate; they never trust a byte of the file.
#pragma once

#include "base/result.h"
#include "image/image.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace scanout::image {

using Bytes = std::vector<std::uint8_t>;

// if_needed: RGB when every alpha is 255, else RGBA.
enum class PngAlpha : std::uint8_t { if_needed, always };

// PNG, 8 bits. Same bytes for the same picture. An empty picture has no PNG (Exit::internal).
// description: UTF-8 text stored in the file (PNG 3, 11.3.3); empty: none.
Result<Bytes> encode_png(const Image& image, const std::string& description = {},
                         PngAlpha alpha = PngAlpha::if_needed);
// The description stored in a PNG; "" where it has none. Exit::unreadable for what is no PNG.
Result<std::string> png_description(std::span<const std::uint8_t> file, const std::string& name);
Bytes encode_ppm(const Image& image); // P6: alpha is dropped
Bytes encode_pam(const Image& image); // P7, RGB_ALPHA

// Limits on the pixels and the sides of decoded pictures, against decompression bombs.
struct DecodeLimits {
    int max_side = 16384;
    std::int64_t max_pixels = std::int64_t{1} << 26;
};

// PNG (libpng), JPEG (libjpeg-turbo), BMP and TGA (stb_image), PPM and PAM (8 bits), told apart by
// content; `name` is used in messages and, for TGA, which has no magic number, by its extension.
// Greyscale, palette and 16-bit files become RGBA8; gamma and colour profiles are not applied,
// codes count as sRGB. A file that ends before its last pixel is refused. Errors: Exit::unreadable,
// "name: reason".
Result<Image> decode(std::span<const std::uint8_t> file, const std::string& name,
                     const DecodeLimits& limits = {});
Result<Image> load(const std::string& path, const DecodeLimits& limits = {});

} // namespace scanout::image
