// The memory that a glTF file may take while it is read: whatever is unpacked, decoded or built is
// charged to one account before it is made, however few bytes of the file ask for it.
#pragma once

#include "base/result.h"

#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace scanout::io::gltf {

class Budget {
public:
    Budget(std::uint64_t bytes, const std::string& path) : left_(bytes), path_(path) {}

    // An error (Exit::unreadable) where it is more than is left; then nothing is charged.
    Result<> take(std::uint64_t bytes, std::string_view what) {
        if (!try_take(bytes))
            return fail(Exit::unreadable, "{}: {} takes {} bytes of memory, and {} may be taken",
                        path_, what, bytes, left_);
        return {};
    }
    bool try_take(std::uint64_t bytes) {
        if (bytes > left_) return false;
        left_ -= bytes;
        return true;
    }
    void give_back(std::uint64_t bytes) { left_ += bytes; }
    std::uint64_t left() const { return left_; }

private:
    std::uint64_t left_;
    const std::string& path_;
};

} // namespace scanout::io::gltf
