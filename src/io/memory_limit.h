// The memory limit of loading: checked in advance where the file's header is enough, and watched
// while the file is read.
#pragma once

#include "base/result.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace scanout::io {

class MemoryLimit {
public:
    // `bytes` 0: the machine's available memory.
    explicit MemoryLimit(std::uint64_t bytes);

    // Only STL can be checked: an OBJ file may hold megabytes of comments or zeros that take no
    // memory.
    Result<> admit_stl(std::string_view head, std::uint64_t size, const std::string& path) const;

    // Returns false once too much memory is taken. Building the mesh takes as much again as its
    // source arrays; but before that, the unread rest of the file leaves memory.
    bool holds(std::uint64_t left_of_file);

    bool was_exceeded() const { return exceeded_; }
    std::uint64_t bytes() const { return limit_; }
    std::uint64_t megabytes() const { return limit_ / 1'000'000; }

private:
    std::uint64_t before_, limit_;
    bool exceeded_ = false;
};

} // namespace scanout::io
