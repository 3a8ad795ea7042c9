#include "base/memory.h"

#include <cstddef>
#include <cstdio>
#include <cstring>
#include <new>
#include <span>

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

namespace scanout {

static std::uint64_t kib_in(const char* path, const char* key) {
    std::FILE* file = std::fopen(path, "re");
    if (file == nullptr) return 0;
    char line[256];
    unsigned long long value = 0;
    const std::size_t length = std::strlen(key);
    while (std::fgets(line, sizeof line, file) != nullptr)
        if (std::strncmp(line, key, length) == 0 && std::sscanf(line + length, "%llu", &value) == 1)
            break;
    std::fclose(file);
    return value;
}

std::uint64_t resident_bytes() {
    return kib_in("/proc/self/status", "VmRSS:") * 1024;
}
std::uint64_t peak_resident_bytes() {
    return kib_in("/proc/self/status", "VmHWM:") * 1024;
}

// The whole pages of this size within these bytes; none: empty.
static std::span<std::byte> pages_in(void* begin, std::size_t bytes, std::uintptr_t page) {
    const auto start = reinterpret_cast<std::uintptr_t>(begin);
    const std::uintptr_t first = (start + page - 1) / page * page,
                         last = (start + bytes) / page * page;
    if (first >= last) return {};
    return {static_cast<std::byte*>(begin) + (first - start), last - first};
}

void release_pages(void* begin, std::size_t bytes) {
    static const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
    const std::span<std::byte> pages = pages_in(begin, bytes, page);
    if (!pages.empty()) ::madvise(pages.data(), pages.size(), MADV_DONTNEED);
}

static constexpr std::size_t kLargePage = 1 << 21; // of x86, and of AArch64 with 4 KiB pages

void use_large_pages(void* begin, std::size_t bytes) {
    constexpr int kCollapse = 25; // MADV_COLLAPSE, since Linux 6.1: collapses existing pages
    const std::span<std::byte> pages = pages_in(begin, bytes, kLargePage);
    if (pages.empty()) return;
    ::madvise(pages.data(), pages.size(), MADV_HUGEPAGE);
    ::madvise(pages.data(), pages.size(), kCollapse);
}

void* allocate_large_pages(std::size_t bytes) {
    if (bytes < kLargePage / 2) return ::operator new(bytes);
    const std::size_t pages = (bytes + kLargePage - 1) / kLargePage * kLargePage;
    void* const begin = ::operator new (pages, std::align_val_t{kLargePage});
    const std::size_t filled = (bytes + kLargePage / 2) / kLargePage * kLargePage;
    ::madvise(begin, filled, MADV_HUGEPAGE);
    return begin;
}

void free_large_pages(void* begin, std::size_t bytes) {
    if (bytes < kLargePage / 2)
        ::operator delete(begin);
    else
        ::operator delete (begin, std::align_val_t{kLargePage});
}

void release_freed() {
    ::malloc_trim(0);
}

} // namespace scanout
