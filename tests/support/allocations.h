// Every way to malloc of this process is counted, oneTBB's as well. Not with sanitizers, which have
// a malloc of their own. It defines what it counts: for one file of a program.
#pragma once

#ifndef SCANOUT_SANITIZED

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstring>

#include <dlfcn.h>

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
}

namespace scanout::test {

inline std::atomic<std::size_t> allocations = 0; // so far

} // namespace scanout::test

extern "C" {
void* malloc(std::size_t size) {
    ++scanout::test::allocations;
    return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
    ++scanout::test::allocations;
    return __libc_calloc(number, size);
}
void* realloc(void* block, std::size_t size) {
    ++scanout::test::allocations;
    return __libc_realloc(block, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
    ++scanout::test::allocations;
    return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
    ++scanout::test::allocations;
    return __libc_memalign(alignment, size);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
    ++scanout::test::allocations;
    *block = __libc_memalign(alignment, size);
    return *block == nullptr ? ENOMEM : 0;
}
}

// Without its own allocator oneTBB takes its memory from malloc, as we do.
extern "C" void* dlopen(const char* name, int mode) {
    using Function = void* (*)(const char*, int);
    if (name != nullptr && std::strstr(name, "tbbmalloc") != nullptr) return nullptr;
    return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, "dlopen"))(name, mode);
}

#endif
