#include "base/memory.h"

#include <cstdio>
#include <cstring>

namespace scanout {

static std::uint64_t status_kib(const char* key) {
    std::FILE* file = std::fopen("/proc/self/status", "re");
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
    return status_kib("VmRSS:") * 1024;
}
std::uint64_t peak_resident_bytes() {
    return status_kib("VmHWM:") * 1024;
}

} // namespace scanout
