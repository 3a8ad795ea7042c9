#include "base/memory.h"

#include <cstdio>
#include <cstring>

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

void release_pages(void* begin, std::size_t bytes) {
    static const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
    const auto first = (reinterpret_cast<std::uintptr_t>(begin) + page - 1) / page * page;
    const auto last = (reinterpret_cast<std::uintptr_t>(begin) + bytes) / page * page;
    if (first >= last) return;
    std::byte* pages =
        static_cast<std::byte*>(begin) + (first - reinterpret_cast<std::uintptr_t>(begin));
    ::madvise(pages, last - first, MADV_DONTNEED);
}

void release_freed() {
    ::malloc_trim(0);
}

} // namespace scanout
