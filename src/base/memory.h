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

// Gives the whole pages within these bytes back to the machine, while whoever allocated them keeps
// the place: for large arrays whose start is done with. What stood there reads as zeros afterwards.
void release_pages(void* begin, std::size_t bytes);

// Asks for pages as large as the machine has, for these bytes and what stands there. Arrays that
// are read out of order, and pictures, of which a tile is a piece of many rows, then need fewer
// entries of the tables that say where pages lie. Small arrays stay as they are, and so do all
// where the machine refuses.
void use_large_pages(void* begin, std::size_t bytes);
template <class T>
void use_large_pages(std::span<T> values) {
    use_large_pages(values.data(), values.size_bytes());
}
template <class T>
void use_large_pages(std::vector<T>& values) {
    use_large_pages(std::span(values));
}

// The same for bytes that nobody has written yet: nothing need be moved.
void expect_large_pages(void* begin, std::size_t bytes);
// Makes an array anew, in such pages. What it holds is lost.
template <class T>
void assign_in_large_pages(std::vector<T>& values, std::size_t size, const T& value = {}) {
    release(values);
    values.reserve(size);
    expect_large_pages(values.data(), size * sizeof(T));
    values.assign(size, value);
}

// Gives the memory of small blocks that were freed back to the machine, wherever it lies.
void release_freed();

} // namespace scanout
