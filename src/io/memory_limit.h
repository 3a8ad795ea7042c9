// What loading may take of the machine's memory, told in advance where the file's header is enough,
// and watched while it is read.
#pragma once

#include "base/result.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace scanout::io {

class MemoryLimit {
public:
    // `bytes` 0: what the machine has available.
    explicit MemoryLimit(std::uint64_t bytes);

    // An OBJ file says nothing in advance: megabytes of comments or zeros take no memory at all.
    Result<> admit_stl(std::string_view head, std::uint64_t size, const std::string& path) const;

    // False from the moment on when too much is taken. The mesh takes as much again as the arrays
    // that it is built of, while what is left of the file leaves memory before.
    bool holds(std::uint64_t left_of_file);

    bool was_exceeded() const { return exceeded_; }
    std::uint64_t bytes() const { return limit_; }
    std::uint64_t megabytes() const { return limit_ / 1'000'000; }

private:
    std::uint64_t before_, limit_;
    bool exceeded_ = false;
};

} // namespace scanout::io
