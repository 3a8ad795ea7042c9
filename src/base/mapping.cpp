#include "base/mapping.h"

#include "base/fd.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

namespace scanout {

Result<Mapping> Mapping::open(const std::string& path) {
    // O_NONBLOCK: a pipe without a writer must not freeze us before fstat can refuse it.
    TRY(const Fd fd, Fd::open(path, O_RDONLY | O_NONBLOCK));
    struct stat info {};
    if (::fstat(fd.get(), &info) != 0)
        return fail(Exit::unreadable, "{}: {}", path, std::strerror(errno));
    if (S_ISDIR(info.st_mode)) return fail(Exit::unreadable, "{}: is a folder, not a file", path);
    if (!S_ISREG(info.st_mode))
        return fail(Exit::unreadable,
                    "{}: is not a regular file (copy its contents to a file first)", path);
    const auto size = static_cast<std::size_t>(info.st_size);
    if (size == 0) return Mapping();
    void* data = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, fd.get(), 0);
    if (data == MAP_FAILED)
        return fail(Exit::unreadable, "{}: cannot be mapped: {}", path, std::strerror(errno));
    ::madvise(data, size, MADV_SEQUENTIAL);
    return Mapping(static_cast<const char*>(data), size);
}

Mapping::Mapping(Mapping&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)),
      dropped_(std::exchange(other.dropped_, 0)) {}

Mapping& Mapping::operator=(Mapping&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(dropped_, other.dropped_);
    return *this;
}

Mapping::~Mapping() {
    if (data_ != nullptr) ::munmap(const_cast<char*>(data_), size_);
}

void Mapping::drop_before(std::size_t end) {
    constexpr std::size_t kPage = 4096;
    end = end / kPage * kPage;
    if (end <= dropped_) return;
    ::madvise(const_cast<char*>(data_) + dropped_, end - dropped_, MADV_DONTNEED);
    dropped_ = end;
}

} // namespace scanout
