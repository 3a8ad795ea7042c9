// A frame's identity: XXH64, seed 0, of width and height (u32, little endian) and the RGBA8 rows.
#pragma once

#include "image/image.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace scanout::image {

std::uint64_t frame_hash(const Image& image);
std::string hash_text(std::uint64_t hash); // 16 hexadecimal digits

// XXH64, seed 0, of bytes that come in parts.
class Hasher {
public:
    Hasher();
    ~Hasher();
    Hasher(const Hasher&) = delete;
    Hasher& operator=(const Hasher&) = delete;
    void add(std::span<const std::byte> bytes);
    std::uint64_t hash() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace scanout::image
