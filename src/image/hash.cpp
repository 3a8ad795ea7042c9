#include "image/hash.h"

#include "base/check.h"

#include <array>
#include <memory>

#include <xxhash.h>

namespace scanout::image {

std::uint64_t frame_hash(const Image& image) {
    std::array<std::uint8_t, 8> size{};
    for (std::size_t i = 0; i < 4; ++i) {
        size[i] = static_cast<std::uint8_t>(static_cast<std::uint32_t>(image.width()) >> (8 * i));
        size[4 + i] =
            static_cast<std::uint8_t>(static_cast<std::uint32_t>(image.height()) >> (8 * i));
    }
    const std::unique_ptr<XXH64_state_t, XXH_errorcode (*)(XXH64_state_t*)> state(
        XXH64_createState(), XXH64_freeState);
    CHECK(state != nullptr);
    XXH64_reset(state.get(), 0);
    XXH64_update(state.get(), size.data(), size.size());
    // The rows stand one after the other without padding, as r, g, b, a bytes: one update hashes
    // all.
    if (!image.empty())
        XXH64_update(state.get(), image.pixels().data(), image.pixels().size_bytes());
    return XXH64_digest(state.get());
}

std::string hash_text(std::uint64_t hash) {
    std::string text(16, '0');
    for (std::size_t i = 0; i < 16; ++i)
        text[15 - i] = "0123456789abcdef"[(hash >> (4 * i)) & 15];
    return text;
}

} // namespace scanout::image
