#include "base/mapping.h"

#include "base/available_memory.h"
#include "base/fd.h"
#include "base/memory.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace scanout {
namespace {

constexpr std::uint64_t kMegabyte = 1'000'000;

tl::unexpected<Error> unreadable(const std::string& path, int error) {
    return fail(Exit::unreadable, "{}: {}", path, std::strerror(error));
}

tl::unexpected<Error> changed(const std::string& path) {
    return fail(Exit::unreadable, "{}: changed while it was read; load it again", path);
}

Result<> read_whole(int fd, off_t begin, off_t end, char* data, const std::string& path) {
    for (ssize_t n = 0; begin < end; begin += n) {
        n = ::pread(fd, data + begin, static_cast<std::size_t>(end - begin), begin);
        if (n < 0) return unreadable(path, errno);
        if (n == 0) return changed(path);
    }
    return {};
}

// Reads the parts that the file stores; pages over its holes stay untouched.
Result<> read_stored(int fd, off_t size, char* data, const std::string& path) {
    for (off_t at = 0; at < size;) {
        off_t begin = ::lseek(fd, at, SEEK_DATA);
        if (begin < 0 && errno == ENXIO) break;
        if (begin < 0) begin = at; // the file system does not know
        const off_t hole = ::lseek(fd, begin, SEEK_HOLE);
        at = hole > begin ? std::min(hole, size) : size;
        TRY_VOID(read_whole(fd, begin, at, data, path));
    }
    return {};
}

Result<struct stat> regular_file(int fd, const std::string& path) {
    struct stat info {};
    if (::fstat(fd, &info) != 0) return unreadable(path, errno);
    if (S_ISDIR(info.st_mode)) return fail(Exit::unreadable, "{}: is a folder, not a file", path);
    if (!S_ISREG(info.st_mode))
        return fail(Exit::unreadable,
                    "{}: is not a regular file (copy its contents to a file first)", path);
    return info;
}

bool same_version(const struct stat& a, const struct stat& b) {
    return a.st_size == b.st_size && a.st_mtim.tv_sec == b.st_mtim.tv_sec &&
           a.st_mtim.tv_nsec == b.st_mtim.tv_nsec;
}

} // namespace

Result<Mapping> Mapping::open(const std::string& path, const Admit& admit) {
    // O_NONBLOCK: a pipe without a writer must not freeze us before fstat can refuse it.
    TRY(const Fd fd, Fd::open(path, O_RDONLY | O_NONBLOCK));
    TRY(const struct stat info, regular_file(fd.get(), path));
    const auto size = static_cast<std::size_t>(info.st_size);
    if (size == 0) return Mapping();
    if (admit) {
        std::array<char, 4096> head{};
        const ssize_t n = ::pread(fd.get(), head.data(), head.size(), 0);
        if (n < 0) return unreadable(path, errno);
        TRY_VOID(admit({head.data(), static_cast<std::size_t>(n)}, size));
    }
    const std::uint64_t stored =
        std::min<std::uint64_t>(size, static_cast<std::uint64_t>(info.st_blocks) * 512);
    const std::uint64_t available = available_bytes();
    const auto too_large = [&] {
        return fail(Exit::unreadable,
                    "{}: is a file of {} MB, and {} MB of memory are available: close other "
                    "programs, or cut the file into parts",
                    path, size / kMegabyte, available / kMegabyte);
    };
    if (stored > available) return too_large();
    void* data = ::mmap(nullptr, size, PROT_READ | PROT_WRITE,
                        MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (data == MAP_FAILED) return too_large();
    Mapping mapping(static_cast<char*>(data), size);
    TRY_VOID(read_stored(fd.get(), info.st_size, mapping.data_, path));
    TRY(const struct stat after, regular_file(fd.get(), path));
    if (!same_version(info, after)) return changed(path);
    ::mprotect(data, size, PROT_READ);
    return mapping;
}

Result<Mapping> Mapping::fill(const Source& source, std::uint64_t max_bytes,
                              const std::string& path) {
    constexpr std::size_t kFirst = std::size_t{1} << 20;
    Mapping mapping;
    for (std::size_t used = 0;;) {
        if (used == mapping.size_) {
            const std::size_t size = used == 0 ? kFirst : 2 * used;
            void* data = used == 0 ? ::mmap(nullptr, size, PROT_READ | PROT_WRITE,
                                            MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0)
                                   : ::mremap(mapping.data_, used, size, MREMAP_MAYMOVE);
            if (data == MAP_FAILED)
                return fail(Exit::unreadable, "{}: is too large for this machine's memory", path);
            mapping.data_ = static_cast<char*>(data);
            mapping.size_ = size;
        }
        TRY(const std::size_t more, source(mapping.data_ + used, mapping.size_ - used));
        if (more == 0) {
            mapping.shrink(used);
            return mapping;
        }
        used += more;
        if (used > max_bytes)
            return fail(Exit::unreadable,
                        "{}: holds more than the {} MB that it may take: cut the model into parts",
                        path, max_bytes / kMegabyte);
    }
}

Result<Mapping> Mapping::read_all(int fd, std::uint64_t max_bytes, const std::string& path) {
    const auto source = [&](char* data, std::size_t room) -> Result<std::size_t> {
        for (;;) {
            const ssize_t n = ::read(fd, data, room);
            if (n >= 0) return static_cast<std::size_t>(n);
            if (errno != EINTR) return unreadable(path, errno);
        }
    };
    return fill(source, max_bytes, path);
}

// Unmaps the memory beyond `size` bytes.
void Mapping::shrink(std::size_t size) {
    const std::size_t page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    const std::size_t kept = (size + page - 1) / page * page;
    if (kept < size_) ::munmap(data_ + kept, size_ - kept);
    if (kept == 0) data_ = nullptr;
    size_ = size;
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
    if (data_ != nullptr) ::munmap(data_, size_);
}

void Mapping::drop_before(std::size_t end) {
    constexpr std::size_t kMegabytes = std::size_t{1} << 20; // so that every page is whole
    end = std::min(end, size_) / kMegabytes * kMegabytes;
    if (end <= dropped_) return;
    release_pages(data_ + dropped_, end - dropped_);
    dropped_ = end;
}

} // namespace scanout
