// A file's bytes, read into memory pages of their own. open() refuses devices, pipes and folders,
// so that no reader can be made to read for ever. The file itself is not mapped: a file that is cut
// short while it is parsed would end the program with SIGBUS.
#pragma once

#include "base/result.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace scanout {

class Mapping {
public:
    // Called before a file is read, with its first bytes (at most 4096) and its size; an error
    // refuses the file.
    using Admit = std::function<Result<>(std::string_view head, std::uint64_t size)>;

    // Errors name the path (Exit::unreadable); a file that changes while it is read is an error,
    // too. An empty file gives an empty view. Holes of a sparse file are zeros that take no memory.
    static Result<Mapping> open(const std::string& path, const Admit& admit = nullptr);

    // Writes at most `room` bytes to `data` and returns how many; 0 at the end.
    using Source = std::function<Result<std::size_t>(char* data, std::size_t room)>;

    // Reads all bytes of a source. More than `max_bytes` are an error that names `path`.
    static Result<Mapping> fill(const Source& source, std::uint64_t max_bytes,
                                const std::string& path);

    // Reads all bytes of a file descriptor, which may be a pipe.
    static Result<Mapping> read_all(int fd, std::uint64_t max_bytes, const std::string& path);

    Mapping() = default;
    Mapping(Mapping&& other) noexcept;
    Mapping& operator=(Mapping&& other) noexcept;
    Mapping(const Mapping&) = delete;
    Mapping& operator=(const Mapping&) = delete;
    ~Mapping();

    std::string_view text() const { return {data_, size_}; }
    std::size_t size() const { return size_; }

    // Gives the memory of bytes [0, end) back, up to a whole page: they must not be read again.
    void drop_before(std::size_t end);

private:
    Mapping(char* data, std::size_t size) : data_(data), size_(size) {}
    void shrink(std::size_t size);
    char* data_ = nullptr;
    std::size_t size_ = 0;
    std::size_t dropped_ = 0;
};

} // namespace scanout
