#pragma once

#include <cstdint>

namespace scanout::io {

// The number in four bytes, the lowest first.
inline std::uint32_t little_endian(const char* bytes) {
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i)
        value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
}

} // namespace scanout::io
