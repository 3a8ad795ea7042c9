// A regular file mapped for reading. Devices, pipes and folders are refused, so that no reader can
// be made to read for ever.
#pragma once

#include "base/result.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace scanout {

class Mapping {
public:
    // Errors name the path (Exit::unreadable). An empty file maps to an empty view.
    static Result<Mapping> open(const std::string& path);

    Mapping() = default;
    Mapping(Mapping&& other) noexcept;
    Mapping& operator=(Mapping&& other) noexcept;
    Mapping(const Mapping&) = delete;
    Mapping& operator=(const Mapping&) = delete;
    ~Mapping();

    std::string_view text() const { return {data_, size_}; }
    std::size_t size() const { return size_; }

    // Tells the kernel that bytes [0, end) will not be read again, so that they leave the resident
    // set.
    void drop_before(std::size_t end);

private:
    Mapping(const char* data, std::size_t size) : data_(data), size_(size) {}
    const char* data_ = nullptr;
    std::size_t size_ = 0;
    std::size_t dropped_ = 0;
};

} // namespace scanout
