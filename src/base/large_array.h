// An array of constant size in the largest pages that the machine has, to save TLB misses: for
// pictures, of which a tile touches many rows, and for arrays that are read out of order. Its
// values are undefined until they are written; the first write to a page allocates it.
#pragma once

#include "base/memory.h"

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace scanout {

template <class T>
class LargeArray {
    static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= alignof(std::max_align_t));

public:
    LargeArray() = default;
    explicit LargeArray(std::size_t size)
        : values_(size == 0 ? nullptr : static_cast<T*>(allocate_large_pages(size * sizeof(T)))),
          size_(size) {}
    LargeArray(std::size_t size, const T& value) : LargeArray(size) {
        std::fill(begin(), end(), value);
    }
    LargeArray(const LargeArray& from) : LargeArray(from.size_) {
        std::copy(from.begin(), from.end(), begin());
    }
    LargeArray(LargeArray&& from) noexcept { swap(from); }
    LargeArray& operator=(LargeArray from) noexcept {
        swap(from);
        return *this;
    }
    ~LargeArray() { free_large_pages(values_, size_ * sizeof(T)); }

    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    T* data() { return values_; }
    const T* data() const { return values_; }
    T* begin() { return values_; }
    const T* begin() const { return values_; }
    T* end() { return values_ + size_; }
    const T* end() const { return values_ + size_; }
    T& operator[](std::size_t i) { return values_[i]; }
    const T& operator[](std::size_t i) const { return values_[i]; }
    friend bool operator==(const LargeArray& a, const LargeArray& b) {
        return std::equal(a.begin(), a.end(), b.begin(), b.end());
    }

private:
    void swap(LargeArray& other) noexcept {
        std::swap(values_, other.values_);
        std::swap(size_, other.size_);
    }
    T* values_ = nullptr;
    std::size_t size_ = 0;
};

} // namespace scanout
