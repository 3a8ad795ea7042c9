// TGA: colour-mapped, true-colour and grey, plain and run-length encoded (Truevision TGA File
// Format Specification 2.0). Checked here, decoded by stb_image.
#include "image/decoders.h"

#include <algorithm>

namespace scanout::image {

namespace {

constexpr std::size_t kHeader = 18;
constexpr std::uint32_t kRightToLeft = 0x10, kTopDown = 0x20, kInterleaved = 0xc0;

struct Tga {
    std::uint32_t kind = 0; // 1 colour-mapped, 2 true-colour, 3 grey
    bool run_length = false;
    std::uint32_t map_first = 0, map_length = 0, map_bits = 0;
    std::size_t map = 0;    // where the colour map begins
    std::size_t pixels = 0; // where the pixels begin
    std::uint32_t width = 0, height = 0, bits = 0;
    std::uint32_t descriptor = 0;

    std::size_t map_entry() const { return (map_bits + 7) / 8; }
    std::size_t pixel_bytes() const { return (bits + 7) / 8; }
    std::size_t pixel_count() const { return std::size_t{width} * height; }
};

Result<Tga> read_header(const Source& file) {
    const auto& bytes = file.bytes;
    if (bytes.size() < kHeader) return fail(Exit::unreadable, "{}: the file ends early", file.name);
    Tga tga;
    const std::uint32_t map_type = bytes[1], image_type = bytes[2];
    tga.kind = image_type & 7;
    tga.run_length = image_type >= 8;
    tga.map_first = u16_at(bytes, 3);
    tga.map_length = map_type == 1 ? u16_at(bytes, 5) : 0;
    tga.map_bits = bytes[7];
    tga.width = u16_at(bytes, 12);
    tga.height = u16_at(bytes, 14);
    tga.bits = bytes[16];
    tga.descriptor = bytes[17];
    tga.map = kHeader + bytes[0];
    tga.pixels = tga.map + tga.map_length * tga.map_entry();
    if (map_type > 1 || image_type > 11 || tga.kind < 1 || tga.kind > 3 ||
        (tga.kind == 1 && tga.map_length == 0))
        return fail(Exit::unreadable, "{}: is not a TGA picture (type {}, colour map {})",
                    file.name, image_type, map_type);
    return tga;
}

Result<void> check_layout(const Source& file, const Tga& tga) {
    const auto is_colour = [](std::uint32_t bits) {
        return bits == 15 || bits == 16 || bits == 24 || bits == 32;
    };
    const bool mapped = tga.kind == 1;
    const bool supported = mapped          ? tga.bits == 8 || tga.bits == 16
                           : tga.kind == 2 ? is_colour(tga.bits)
                                           : tga.bits == 8 || tga.bits == 16;
    if (!supported || (mapped && !is_colour(tga.map_bits)) || (tga.descriptor & kInterleaved) != 0)
        return fail(Exit::unreadable,
                    "{}: a TGA of {} bits a pixel and {} a colour-map entry is not supported",
                    file.name, tga.bits, tga.map_bits);
    if (mapped && tga.map_first + tga.map_length > 0xffff)
        return fail(Exit::unreadable, "{}: its colour map has {} entries: the file is damaged",
                    file.name, tga.map_first + tga.map_length);
    return {};
}

// The number of bytes of the pixels; more than the file has if it ends early.
std::size_t pixel_data_bytes(const Source& file, const Tga& tga) {
    if (!tga.run_length) return tga.pixel_count() * tga.pixel_bytes();
    std::size_t at = tga.pixels;
    for (std::size_t pixels = 0; pixels < tga.pixel_count();) {
        if (at >= file.bytes.size()) return file.bytes.size() + 1;
        const std::size_t run = (file.bytes[at] & 127u) + 1u;
        const bool repeated = file.bytes[at] >= 128;
        at += 1 + (repeated ? 1 : std::min(run, tga.pixel_count() - pixels)) * tga.pixel_bytes();
        pixels += run;
    }
    return at - tga.pixels;
}

void append_u16(Bytes& out, std::uint32_t value) {
    out.push_back(static_cast<std::uint8_t>(value));
    out.push_back(static_cast<std::uint8_t>(value >> 8));
}

// Writes a header without identification; its colour map has the file's entries and begins at 0.
void append_header(const Source& file, const Tga& tga, Bytes& out) {
    const bool mapped = tga.kind == 1;
    const std::uint32_t entries = mapped ? tga.map_first + tga.map_length : 0;
    out = {0, mapped, static_cast<std::uint8_t>(tga.kind + (tga.run_length ? 8u : 0u))};
    append_u16(out, 0);
    append_u16(out, entries);
    out.push_back(static_cast<std::uint8_t>(mapped ? tga.map_bits : 0));
    append_u16(out, 0);
    append_u16(out, 0);
    append_u16(out, tga.width);
    append_u16(out, tga.height);
    out.push_back(static_cast<std::uint8_t>(tga.bits));
    out.push_back(static_cast<std::uint8_t>(tga.descriptor & kTopDown));
    if (!mapped) return;
    out.resize(out.size() + tga.map_first * tga.map_entry());
    const auto map = file.bytes.subspan(tga.map, tga.map_length * tga.map_entry());
    out.insert(out.end(), map.begin(), map.end());
}

void finish(const Tga& tga, Image& image) {
    if ((tga.descriptor & kRightToLeft) != 0)
        for (int y = 0; y < image.height(); ++y)
            std::reverse(image.row(y).begin(), image.row(y).end());
    // Writers that treat the fourth byte as unused fill it with 0: such a picture would be
    // invisible.
    const auto clear = [](const Rgba8& pixel) { return pixel.a == 0; };
    if (std::all_of(image.pixels().begin(), image.pixels().end(), clear))
        for (Rgba8& pixel : image.pixels())
            pixel.a = 255;
}

} // namespace

Result<Image> decode_tga(const Source& file) {
    TRY(const Tga tga, read_header(file));
    TRY_VOID(check_size(file, tga.width, tga.height));
    TRY_VOID(check_layout(file, tga));
    const std::size_t size = file.bytes.size();
    const std::size_t needed = tga.pixels <= size ? pixel_data_bytes(file, tga) : size;
    if (tga.pixels > size || needed > size - tga.pixels)
        return fail(Exit::unreadable, "{}: ends early: it holds fewer than its {}x{} pixels",
                    file.name, tga.width, tga.height);
    Bytes plain;
    append_header(file, tga, plain);
    const auto pixels = file.bytes.subspan(tga.pixels, needed);
    plain.insert(plain.end(), pixels.begin(), pixels.end());
    TRY(Image image, decode_by_stb(plain, file.name));
    finish(tga, image);
    return image;
}

} // namespace scanout::image
