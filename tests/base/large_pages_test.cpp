// Large pages hold what stood there, and the machine gives them where it has them for the asking.
#include "base/large_array.h"
#include "base/memory.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/mman.h>

namespace scanout {
namespace {

// KiB of large pages in this process.
long large_pages() {
    std::ifstream file("/proc/self/smaps_rollup");
    long kib = 0;
    for (std::string line; std::getline(file, line);)
        if (std::sscanf(line.c_str(), "AnonHugePages: %ld", &kib) == 1) return kib;
    return kib;
}

constexpr long kSome = 30'000; // KiB, of 64 MiB that ask

// Does the machine make large pages of a mapping that is full, when asked? Some make them unasked.
bool gives_large_pages() {
    constexpr std::size_t kBytes = 64 << 20;
    constexpr int kCollapse = 25; // MADV_COLLAPSE
    void* pages =
        ::mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (pages == MAP_FAILED) return false;
    std::memset(pages, 1, kBytes);
    const long before = large_pages();
    ::madvise(pages, kBytes, kCollapse);
    const bool gives = large_pages() > before + kSome;
    ::munmap(pages, kBytes);
    return gives;
}

TEST(LargePages, KeepWhatStoodThere) {
    for (const std::size_t size : {std::size_t{0}, std::size_t{1000}, std::size_t{5'000'003}}) {
        std::vector<std::uint32_t> values(size);
        std::iota(values.begin(), values.end(), 7U);
        use_large_pages(values);
        for (std::size_t i = 0; i < size; ++i)
            ASSERT_EQ(values[i], i + 7);
    }
}

TEST(LargePages, AreGivenWhereTheMachineGivesThem) {
    std::vector<std::uint32_t> values(16 << 20, 1);
    const long before = large_pages();
    use_large_pages(values);
    EXPECT_EQ(large_pages() > before + kSome, gives_large_pages());
}

#ifndef SCANOUT_SANITIZED // whose allocator writes first
TEST(LargeArray, IsMadeOfLargePagesWhereTheyAreHalfFull) {
    for (const long kib : {64 << 10, (64 << 10) - 1000}) {
        const long before = large_pages();
        const LargeArray<std::uint32_t> values(static_cast<std::size_t>(kib) * 256, 5U);
        EXPECT_TRUE(std::all_of(values.begin(), values.end(), [](auto v) { return v == 5; }));
        EXPECT_EQ(large_pages() == before + (64 << 10), gives_large_pages());
    }
    const long before = large_pages();
    const LargeArray<std::uint32_t> values(100 * 256, 5U);
    EXPECT_EQ(large_pages(), before);
}
#endif

TEST(LargeArray, IsCopiedAndMoved) {
    for (const std::size_t size : {std::size_t{0}, std::size_t{1000}, std::size_t{1'000'003}}) {
        LargeArray<std::uint32_t> values(size);
        std::iota(values.begin(), values.end(), 7U);
        LargeArray<std::uint32_t> copy = values;
        if (size > 0) {
            EXPECT_NE(copy.data(), values.data());
            values[0] = 3;
        }
        values = std::move(copy);
        ASSERT_EQ(values.size(), size);
        for (std::size_t i = 0; i < size; ++i)
            ASSERT_EQ(values[i], i + 7);
        values = {};
        EXPECT_TRUE(values.empty());
    }
}

} // namespace
} // namespace scanout
