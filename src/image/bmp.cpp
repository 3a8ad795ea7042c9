// BMP: 1, 4, 8, 16, 24 and 32 bits, uncompressed or with bit fields, headers of 12 to 124 bytes
// (Microsoft, "Bitmap Header Types"). Checked here, decoded by stb_image.
#include "image/decoders.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>

namespace scanout::image {

namespace {

constexpr std::size_t kFileHeader = 14;
constexpr std::size_t kV4Header = 108;
enum Compression : std::uint32_t { kPlain = 0, kBitFields = 3, kAlphaBitFields = 6 };

struct Bmp {
    std::size_t header = 0; // bytes, without the file header
    std::size_t pixels = 0; // where the pixel rows begin
    std::int64_t width = 0, height = 0;
    bool top_down = false;
    int bits = 0;
    std::uint32_t compression = 0;
    std::array<std::uint32_t, 4> masks{}; // red, green, blue, alpha; for bit fields only

    std::size_t row_bytes() const { return static_cast<std::size_t>((width * bits + 7) / 8); }
    std::size_t stride() const { return (row_bytes() + 3) / 4 * 4; }
};

Result<Bmp> read_header(const Source& file) {
    const auto& bytes = file.bytes;
    if (bytes.size() < kFileHeader + 12)
        return fail(Exit::unreadable, "{}: the file ends early", file.name);
    Bmp bmp;
    bmp.pixels = u32_at(bytes, 10);
    bmp.header = u32_at(bytes, 14);
    constexpr std::array<std::size_t, 7> kKnown{12, 40, 52, 56, 64, 108, 124};
    if (std::find(kKnown.begin(), kKnown.end(), bmp.header) == kKnown.end())
        return fail(Exit::unreadable, "{}: a BMP header of {} bytes is not supported", file.name,
                    bmp.header);
    if (bytes.size() < kFileHeader + bmp.header)
        return fail(Exit::unreadable, "{}: the file ends early", file.name);
    if (bmp.header == 12) {
        bmp.width = u16_at(bytes, 18);
        bmp.height = u16_at(bytes, 20);
        bmp.bits = static_cast<int>(u16_at(bytes, 24));
        return bmp;
    }
    bmp.width = static_cast<std::int32_t>(u32_at(bytes, 18));
    bmp.height = static_cast<std::int32_t>(u32_at(bytes, 22));
    bmp.top_down = bmp.height < 0;
    if (bmp.top_down) bmp.height = -bmp.height;
    bmp.bits = static_cast<int>(u16_at(bytes, 28));
    bmp.compression = u32_at(bytes, 30);
    return bmp;
}

// The masks follow a header of 40 bytes, or are in a longer one: at the same offset.
Result<void> read_masks(const Source& file, Bmp& bmp) {
    constexpr std::size_t kAt = kFileHeader + 40;
    const bool has_alpha = bmp.compression == kAlphaBitFields || bmp.header >= 56;
    const std::size_t count = has_alpha ? 4 : 3;
    if (bmp.header == 64 || file.bytes.size() < kAt + 4 * count)
        return fail(Exit::unreadable, "{}: its bit fields are missing", file.name);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t mask = u32_at(file.bytes, kAt + 4 * i);
        bmp.masks[i] = mask;
        if (mask == 0 && i < 3)
            return fail(Exit::unreadable, "{}: its bit fields leave out a colour", file.name);
        const int digits = std::popcount(mask);
        if (digits > 8)
            return fail(Exit::unreadable, "{}: bit fields of more than 8 bits are not supported",
                        file.name);
        if (mask != 0 && digits != 32 - std::countl_zero(mask) - std::countr_zero(mask))
            return fail(Exit::unreadable, "{}: a bit field with gaps is not supported", file.name);
    }
    return {};
}

Result<void> check_layout(const Source& file, const Bmp& bmp) {
    const bool bit_fields = bmp.compression == kBitFields || bmp.compression == kAlphaBitFields;
    const bool deep = bmp.bits == 16 || bmp.bits == 32;
    if (bmp.bits != 1 && bmp.bits != 4 && bmp.bits != 8 && bmp.bits != 24 && !deep)
        return fail(Exit::unreadable, "{}: a BMP of {} bits a pixel is not supported", file.name,
                    bmp.bits);
    if (bmp.compression != kPlain && !(bit_fields && deep))
        return fail(Exit::unreadable,
                    "{}: BMP compression {} is not supported: save it uncompressed", file.name,
                    bmp.compression);
    const std::size_t size = file.bytes.size();
    if (bmp.pixels < kFileHeader + bmp.header || bmp.pixels > size)
        return fail(Exit::unreadable,
                    "{}: its pixels would begin at byte {} of {}: the file is damaged", file.name,
                    bmp.pixels, size);
    // Writers may leave out the padding of the last row.
    const std::size_t needed =
        bmp.stride() * static_cast<std::size_t>(bmp.height - 1) + bmp.row_bytes();
    if (size - bmp.pixels < needed)
        return fail(Exit::unreadable, "{}: ends early: {} bytes of pixels are there, {} are needed",
                    file.name, size - bmp.pixels, needed);
    return {};
}

void append_u32(Bytes& out, std::uint32_t value) {
    for (int i = 0; i < 4; ++i)
        out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

// The palette with 256 entries of four bytes: an index past the file's palette finds black.
Result<void> append_palette(const Source& file, const Bmp& bmp, Bytes& out) {
    const std::size_t entry = bmp.header == 12 ? 3 : 4;
    const std::size_t begin = kFileHeader + bmp.header;
    const std::size_t count = std::min<std::size_t>((bmp.pixels - begin) / entry, 256);
    if (count == 0) return fail(Exit::unreadable, "{}: has no palette", file.name);
    const std::size_t end = out.size() + std::size_t{256} * 4;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t* colour = file.bytes.data() + begin + i * entry;
        out.insert(out.end(), {colour[0], colour[1], colour[2], 0});
    }
    out.resize(end);
    return {};
}

void append_header(const Bmp& bmp, Bytes& out) {
    const std::size_t palette = bmp.bits <= 8 ? std::size_t{256} * 4 : 0;
    out = {'B', 'M'};
    append_u32(out, 0); // file size and reserved fields: stb_image does not read them
    append_u32(out, 0);
    append_u32(out, static_cast<std::uint32_t>(kFileHeader + kV4Header + palette));
    append_u32(out, kV4Header);
    append_u32(out, static_cast<std::uint32_t>(bmp.width));
    append_u32(out, static_cast<std::uint32_t>(bmp.top_down ? -bmp.height : bmp.height));
    append_u32(out, 1u | static_cast<std::uint32_t>(bmp.bits) << 16); // one plane
    append_u32(out, bmp.compression == kPlain ? kPlain : kBitFields);
    out.resize(kFileHeader + 40);
    for (const std::uint32_t mask : bmp.masks)
        append_u32(out, mask);
    out.resize(kFileHeader + kV4Header);
}

} // namespace

Result<Image> decode_bmp(const Source& file) {
    TRY(Bmp bmp, read_header(file));
    TRY_VOID(check_size(file, bmp.width, bmp.height));
    TRY_VOID(check_layout(file, bmp));
    if (bmp.compression != kPlain) TRY_VOID(read_masks(file, bmp));
    Bytes plain;
    const std::size_t pixel_bytes = bmp.stride() * static_cast<std::size_t>(bmp.height);
    plain.reserve(kFileHeader + kV4Header + std::size_t{256} * 4 + pixel_bytes);
    append_header(bmp, plain);
    if (bmp.bits <= 8) TRY_VOID(append_palette(file, bmp, plain));
    const std::size_t begin = plain.size();
    const auto rows =
        file.bytes.subspan(bmp.pixels, std::min(pixel_bytes, file.bytes.size() - bmp.pixels));
    plain.insert(plain.end(), rows.begin(), rows.end());
    plain.resize(begin + pixel_bytes);
    return decode_by_stb(plain, file.name);
}

} // namespace scanout::image
