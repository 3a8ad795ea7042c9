// Rows that are equal become one: an open-addressing table of row numbers. The rows themselves stay
// where their owner keeps them, so the table costs 4 bytes a slot whatever a row holds.
#pragma once

#include "base/memory.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace scanout::geom {

// Spreads the bits of a hash: the finalizer of MurmurHash3 (Appleby, public domain).
inline std::uint64_t mix_bits(std::uint64_t h) {
    h = (h ^ (h >> 33)) * 0xff51afd7ed558ccdu;
    h = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53u;
    return h ^ (h >> 33);
}

// Row numbers are given in the order of first use: 0, 1, 2 ...
class JoinTable {
public:
    explicit JoinTable(std::size_t expected_rows)
        : slots_(std::bit_ceil(expected_rows + expected_rows / 2 + 16), kEmpty) {}

    std::size_t rows() const { return rows_; }

    // The number of the row that equals(row) accepts, or rows() after add() was called to append
    // one. hash_of(row) is asked again for every row when the table grows; it must give `hash` for
    // this one.
    template <class Equals, class Add, class HashOf>
    std::uint32_t find_or_add(std::uint64_t hash, Equals&& equals, Add&& add, HashOf&& hash_of) {
        std::size_t slot = hash & (slots_.size() - 1);
        for (; slots_[slot] != kEmpty; slot = (slot + 1) & (slots_.size() - 1))
            if (equals(slots_[slot])) return slots_[slot];
        add();
        slots_[slot] = rows_;
        if (++rows_ > slots_.size() / 4 * 3) grow(hash_of);
        return rows_ - 1;
    }

private:
    static constexpr std::uint32_t kEmpty = 0xffffffff;

    template <class HashOf>
    void grow(HashOf&& hash_of) {
        const std::size_t size = slots_.size() * 2;
        release(slots_); // the old slots are not needed: every row is numbered
        slots_.assign(size, kEmpty);
        for (std::uint32_t row = 0; row < rows_; ++row) {
            std::size_t slot = hash_of(row) & (size - 1);
            while (slots_[slot] != kEmpty)
                slot = (slot + 1) & (size - 1);
            slots_[slot] = row;
        }
    }

    std::vector<std::uint32_t> slots_;
    std::uint32_t rows_ = 0;
};

} // namespace scanout::geom
