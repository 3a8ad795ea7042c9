#include "image/pixel_format.h"

#include "base/check.h"
#include "image/dither.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace scanout::image {

// Named as in the kernel's drm_fourcc.h: the channels from the highest bit of the little-endian
// word to the lowest. x is unused.
constexpr std::array kFormats{
    NamedPixelFormat{"xrgb8888", {32, {16, 8}, {8, 8}, {0, 8}, {24, 0}}},
    NamedPixelFormat{"xbgr8888", {32, {0, 8}, {8, 8}, {16, 8}, {24, 0}}},
    NamedPixelFormat{"rgbx8888", {32, {24, 8}, {16, 8}, {8, 8}, {0, 0}}},
    NamedPixelFormat{"bgrx8888", {32, {8, 8}, {16, 8}, {24, 8}, {0, 0}}},
    NamedPixelFormat{"argb8888", {32, {16, 8}, {8, 8}, {0, 8}, {24, 8}}},
    NamedPixelFormat{"abgr8888", {32, {0, 8}, {8, 8}, {16, 8}, {24, 8}}},
    NamedPixelFormat{"rgba8888", {32, {24, 8}, {16, 8}, {8, 8}, {0, 8}}},
    NamedPixelFormat{"bgra8888", {32, {8, 8}, {16, 8}, {24, 8}, {0, 8}}},
    NamedPixelFormat{"rgb888", {24, {16, 8}, {8, 8}, {0, 8}, {0, 0}}},
    NamedPixelFormat{"bgr888", {24, {0, 8}, {8, 8}, {16, 8}, {0, 0}}},
    NamedPixelFormat{"rgb565", {16, {11, 5}, {5, 6}, {0, 5}, {0, 0}}},
    NamedPixelFormat{"bgr565", {16, {0, 5}, {5, 6}, {11, 5}, {0, 0}}},
    NamedPixelFormat{"xrgb1555", {16, {10, 5}, {5, 5}, {0, 5}, {15, 0}}},
    NamedPixelFormat{"xbgr1555", {16, {0, 5}, {5, 5}, {10, 5}, {15, 0}}},
    NamedPixelFormat{"xrgb4444", {16, {8, 4}, {4, 4}, {0, 4}, {12, 0}}},
};

std::span<const NamedPixelFormat> pixel_formats() {
    return kFormats;
}

Result<PixelFormat> pixel_format(std::string_view name) {
    std::string names;
    for (const NamedPixelFormat& format : kFormats) {
        if (format.name == name) return format.format;
        names += names.empty() ? "" : " ";
        names += format.name;
    }
    return fail(Exit::usage, "unknown pixel format '{}': use one of {}", name, names);
}

// Channels without bits are equal, whatever their offset.
static bool same_channel(const Channel& a, const Channel& b) {
    return a == b || (a.bits == 0 && b.bits == 0);
}

std::string name_of(const PixelFormat& format) {
    for (const NamedPixelFormat& named : kFormats) {
        const PixelFormat& other = named.format;
        if (other.bits_per_pixel == format.bits_per_pixel && same_channel(other.red, format.red) &&
            same_channel(other.green, format.green) && same_channel(other.blue, format.blue) &&
            same_channel(other.alpha, format.alpha))
            return std::string(named.name);
    }
    std::string text = fmt::format("{} bits", format.bits_per_pixel);
    const auto add = [&](const char* channel, const Channel& c) {
        if (c.bits != 0) text += fmt::format(", {} {} at {}", channel, c.bits, c.offset);
    };
    add("red", format.red);
    add("green", format.green);
    add("blue", format.blue);
    add("alpha", format.alpha);
    return text;
}

static std::uint32_t mask_of(const Channel& c) {
    return c.bits == 0 ? 0 : ((1u << c.bits) - 1u) << c.offset;
}

constexpr int kMinBits = 4; // of a colour

Result<void> check(const PixelFormat& format) {
    const int bpp = format.bits_per_pixel;
    if (bpp != 16 && bpp != 24 && bpp != 32)
        return fail(Exit::no_display,
                    "pixel format of {}: only 16, 24 and 32 bits a pixel are supported",
                    name_of(format));
    std::uint32_t taken = 0;
    for (const Channel* c : {&format.red, &format.green, &format.blue, &format.alpha}) {
        const bool absent_alpha = c == &format.alpha && c->bits == 0;
        if (absent_alpha) continue;
        const int lowest = c == &format.alpha ? 1 : kMinBits;
        if (c->bits < lowest || c->bits > 8 || c->offset < 0 || c->offset > bpp - c->bits)
            return fail(
                Exit::no_display,
                "pixel format of {}: red, green and blue must have 4 to 8 bits inside the pixel",
                name_of(format));
        if ((taken & mask_of(*c)) != 0)
            return fail(Exit::no_display, "pixel format of {}: its channels overlap",
                        name_of(format));
        taken |= mask_of(*c);
    }
    return {};
}

// Repeats the upper digits below: 4 to 8 bits become 8, all ones become 255.
static constexpr unsigned widened(unsigned level, int bits) {
    return level << (8 - bits) | level >> (2 * bits - 8);
}

// code -> its position among the levels of a channel, in 64ths of the step between the two levels
// whose widened codes enclose it.
using Levels = std::array<std::uint16_t, 256>;

static constexpr Levels levels_of(int bits) {
    Levels levels{};
    for (unsigned code = 0; code < 256; ++code) {
        unsigned below = code >> (8 - bits); // its widened code begins with the same digits
        if (widened(below, bits) > code) --below;
        const unsigned step = widened(below + 1, bits) - widened(below, bits);
        const unsigned above = (code - widened(below, bits)) * 64;
        levels[code] = static_cast<std::uint16_t>(below * 64 + (above + step / 2) / step);
    }
    return levels;
}

constexpr std::array<Levels, 5> kLevels{levels_of(4), levels_of(5), levels_of(6), levels_of(7),
                                        levels_of(8)};

// One channel on its way into a pixel.
struct Packer {
    explicit Packer(const Channel& c)
        : levels(kLevels[static_cast<std::size_t>(c.bits - kMinBits)]),
          shift(static_cast<unsigned>(c.offset)) {}
    std::uint32_t operator()(std::uint8_t code, std::uint32_t threshold) const {
        return (levels[code] + threshold) / kDitherSteps << shift;
    }
    const Levels& levels;
    unsigned shift;
};

template <int kBytes>
static void pack_row(const PixelFormat& format, std::span<const Rgba8> row, int x0, int y,
                     std::uint8_t* out) {
    const Packer red(format.red), green(format.green), blue(format.blue);
    const std::uint32_t alpha = mask_of(format.alpha);
    auto x = static_cast<unsigned>(x0);
    for (const Rgba8& pixel : row) {
        const std::uint32_t threshold = dither_threshold(x++, static_cast<unsigned>(y));
        const std::uint32_t word =
            red(pixel.r, threshold) | green(pixel.g, threshold) | blue(pixel.b, threshold) | alpha;
        for (int i = 0; i < kBytes; ++i)
            out[i] = static_cast<std::uint8_t>(word >> (8 * i));
        out += kBytes;
    }
}

// xrgb8888, which nearly every display has: swap red and blue, clear the top byte.
static void pack_xrgb8888(std::span<const Rgba8> row, std::uint8_t* out) {
    static_assert(std::endian::native == std::endian::little);
    for (const Rgba8& pixel : row) {
        std::uint32_t word;
        std::memcpy(&word, &pixel, sizeof word);
        word = (word & 0xffu) << 16 | (word & 0xff00u) | (word >> 16 & 0xffu);
        std::memcpy(out, &word, sizeof word);
        out += sizeof word;
    }
}

void encode_row(const PixelFormat& format, std::span<const Rgba8> row, int x0, int y,
                std::uint8_t* out) {
    constexpr PixelFormat kXrgb8888{};
    if (format == kXrgb8888) return pack_xrgb8888(row, out);
    switch (format.bits_per_pixel) {
    case 16:
        return pack_row<2>(format, row, x0, y, out);
    case 24:
        return pack_row<3>(format, row, x0, y, out);
    case 32:
        return pack_row<4>(format, row, x0, y, out);
    default:
        CHECK(false);
    }
}

static std::uint8_t widen(std::uint32_t word, const Channel& c) {
    return static_cast<std::uint8_t>(widened(word >> c.offset & ((1u << c.bits) - 1u), c.bits));
}

void decode_row(const PixelFormat& format, const std::uint8_t* in, std::span<Rgba8> row) {
    const int bytes = format.bytes_per_pixel();
    for (Rgba8& pixel : row) {
        std::uint32_t word = 0;
        for (int i = 0; i < bytes; ++i)
            word |= std::uint32_t{in[i]} << (8 * i);
        in += bytes;
        pixel = {widen(word, format.red), widen(word, format.green), widen(word, format.blue), 255};
    }
}

Image as_displayed(const PixelFormat& format, const Image& image) {
    Image out(image.width(), image.height());
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(image.width()) *
                                    static_cast<std::size_t>(format.bytes_per_pixel()));
    for (int y = 0; y < image.height(); ++y) {
        encode_row(format, image.row(y), 0, y, bytes.data());
        decode_row(format, bytes.data(), out.row(y));
    }
    return out;
}

Image without_dither(const PixelFormat& format, const Image& image) {
    const auto table = [](const Channel& c) {
        std::array<std::uint8_t, 256> nearest{};
        const Packer level(Channel{0, c.bits});
        for (std::size_t code = 0; code < nearest.size(); ++code)
            nearest[code] = static_cast<std::uint8_t>(
                widened(level(static_cast<std::uint8_t>(code), kDitherSteps / 2 - 1), c.bits));
        return nearest;
    };
    const auto red = table(format.red), green = table(format.green), blue = table(format.blue);
    Image out = image;
    for (Rgba8& pixel : out.pixels())
        pixel = {red[pixel.r], green[pixel.g], blue[pixel.b], pixel.a};
    return out;
}

int min_bits(const PixelFormat& format) {
    return std::min({format.red.bits, format.green.bits, format.blue.bits});
}

} // namespace scanout::image
