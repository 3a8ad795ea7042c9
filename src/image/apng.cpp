#include "base/check.h"
#include "image/animation.h"

#include <cstring>
#include <span>
#include <string_view>

#include <zlib.h>

namespace scanout::image {
namespace {

constexpr std::size_t kSignature = 8; // bytes

std::uint32_t big_u32(std::span<const std::uint8_t> bytes) {
    return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 |
           std::uint32_t{bytes[2]} << 8 | bytes[3];
}

void append_big_u16(Bytes& out, std::uint32_t value) {
    out.insert(out.end(),
               {static_cast<std::uint8_t>(value >> 8), static_cast<std::uint8_t>(value)});
}

void append_big_u32(Bytes& out, std::uint32_t value) {
    append_big_u16(out, value >> 16);
    append_big_u16(out, value);
}

void append_chunk(Bytes& out, std::string_view type, const Bytes& data) {
    append_big_u32(out, static_cast<std::uint32_t>(data.size()));
    const std::size_t checked = out.size(); // the type and the data
    out.insert(out.end(), type.begin(), type.end());
    out.insert(out.end(), data.begin(), data.end());
    append_big_u32(
        out, static_cast<std::uint32_t>(::crc32_z(0, out.data() + checked, out.size() - checked)));
}

struct Chunk {
    std::string_view type;
    std::span<const std::uint8_t> whole, data;
};

// The first chunk of a PNG of our own; `rest` goes on behind it.
Chunk take_chunk(std::span<const std::uint8_t>& rest) {
    const std::size_t size = big_u32(rest);
    const Chunk chunk{{reinterpret_cast<const char*>(rest.data() + 4), 4},
                      rest.first(size + 12),
                      rest.subspan(8, size)};
    rest = rest.subspan(size + 12);
    return chunk;
}

} // namespace

Result<void> AnimatedPng::add(const Image& picture) {
    TRY(const Bytes png, encode_png(picture, {}, PngAlpha::always));
    std::span<const std::uint8_t> rest = std::span(png).subspan(kSignature);
    const Chunk first = take_chunk(rest); // IHDR
    if (header_.empty()) {
        header_.assign(png.begin(), png.begin() + static_cast<std::ptrdiff_t>(kSignature));
        header_.insert(header_.end(), first.whole.begin(), first.whole.end());
    }
    CHECK(std::equal(first.whole.begin(), first.whole.end(), header_.begin() + kSignature,
                     header_.end())); // the same size
    add_frame_control(picture);
    while (!rest.empty()) {
        const Chunk chunk = take_chunk(rest);
        if (chunk.type != "IDAT") continue;
        if (frames_ == 0) {
            chunks_.insert(chunks_.end(), chunk.whole.begin(), chunk.whole.end());
            continue;
        }
        Bytes data;
        data.reserve(chunk.data.size() + 4);
        append_big_u32(data, sequence_++);
        data.insert(data.end(), chunk.data.begin(), chunk.data.end());
        append_chunk(chunks_, "fdAT", data);
    }
    ++frames_;
    return {};
}

void AnimatedPng::add_frame_control(const Image& picture) {
    Bytes control;
    append_big_u32(control, sequence_++);
    append_big_u32(control, static_cast<std::uint32_t>(picture.width()));
    append_big_u32(control, static_cast<std::uint32_t>(picture.height()));
    append_big_u32(control, 0); // from the left
    append_big_u32(control, 0); // from the top
    append_big_u16(control, 1); // shown for 1 / frames_per_second seconds
    append_big_u16(control, static_cast<std::uint32_t>(frames_per_second_));
    control.insert(control.end(), {0, 0}); // stays when it is over, replaces what was there
    append_chunk(chunks_, "fcTL", control);
}

Bytes AnimatedPng::file() const {
    CHECK(frames_ > 0);
    Bytes out = header_;
    Bytes control;
    append_big_u32(control, frames_);
    append_big_u32(control, 0); // repeats for ever
    append_chunk(out, "acTL", control);
    out.insert(out.end(), chunks_.begin(), chunks_.end());
    append_chunk(out, "IEND", {});
    return out;
}

} // namespace scanout::image
