// The process's own memory, as the kernel counts it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace scanout {

std::uint64_t resident_bytes();      // now (VmRSS)
std::uint64_t peak_resident_bytes(); // the most so far (VmHWM)

// Empties an array and gives its memory back; `values = {}` keeps it.
template <class T>
void release(std::vector<T>& values) {
    std::vector<T>().swap(values);
}

// Gives the whole pages within these bytes back to the machine, but keeps the allocation: for large
// arrays whose first part is done with. The pages read as zeros afterwards.
void release_pages(void* begin, std::size_t bytes);

// Asks for the largest pages that the machine has, for these bytes and their contents. Arrays that
// are read out of order, and pictures, of which a tile touches many rows, then cause fewer TLB
// misses. Small arrays stay as they are, and so do all where the machine refuses.
void use_large_pages(void* begin, std::size_t bytes);
template <class T>
void use_large_pages(std::span<T> values) {
    use_large_pages(values.data(), values.size_bytes());
}
template <class T>
void use_large_pages(std::vector<T>& values) {
    use_large_pages(std::span(values));
}

// Bytes that nobody has written yet, in large pages where they fill at least half of one. They
// begin at a page, so that none need be made of small pages. Throws std::bad_alloc, as new does.
void* allocate_large_pages(std::size_t bytes);
void free_large_pages(void* begin, std::size_t bytes);

// Gives the memory of all freed small blocks back to the machine.
void release_freed();

} // namespace scanout
