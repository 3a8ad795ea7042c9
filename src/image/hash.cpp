#include "image/hash.h"

#include <array>

#define XXH_STATIC_LINKING_ONLY // the state stands in ours
#include <xxhash.h>

namespace scanout::image {

struct Hasher::State {
    XXH64_state_t xxh;
};

Hasher::Hasher() : state_(std::make_unique<State>()) {
    XXH64_reset(&state_->xxh, 0);
}
Hasher::~Hasher() = default;

void Hasher::add(std::span<const std::byte> bytes) {
    if (!bytes.empty()) XXH64_update(&state_->xxh, bytes.data(), bytes.size());
}

std::uint64_t Hasher::hash() const {
    return XXH64_digest(&state_->xxh);
}

std::uint64_t frame_hash(const Image& image) {
    std::array<std::uint8_t, 8> size{};
    for (std::size_t i = 0; i < 4; ++i) {
        size[i] = static_cast<std::uint8_t>(static_cast<std::uint32_t>(image.width()) >> (8 * i));
        size[4 + i] =
            static_cast<std::uint8_t>(static_cast<std::uint32_t>(image.height()) >> (8 * i));
    }
    Hasher hasher;
    hasher.add(std::as_bytes(std::span(size)));
    hasher.add(std::as_bytes(image.pixels())); // rows without padding, r, g, b, a
    return hasher.hash();
}

std::string hash_text(std::uint64_t hash) {
    std::string text(16, '0');
    for (std::size_t i = 0; i < 16; ++i)
        text[15 - i] = "0123456789abcdef"[(hash >> (4 * i)) & 15];
    return text;
}

} // namespace scanout::image
