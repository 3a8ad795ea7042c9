// Merges equal rows: an open-addressing hash table of row numbers, queried for many rows at a time
// on all cores. The rows themselves stay where their owner keeps them, so the table costs 4 bytes a
// slot, however large a row is.
#pragma once

#include "base/chunks.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace scanout::geom {

// Spreads the bits of a hash: the finalizer of MurmurHash3 (Appleby, public domain).
inline std::uint64_t mix_bits(std::uint64_t h) {
    h = (h ^ (h >> 33)) * 0xff51afd7ed558ccdu;
    h = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53u;
    return h ^ (h >> 33);
}

// Row numbers are given in the order of first use: 0, 1, 2 ..., whatever the number of threads or
// the size of the batches.
//
// Items are split into parts by their hash; each part is a table of its own, so that a core works
// on it alone, item after item. Until all parts are done, a new row is known by the batch's first
// item with that row; then a sum over the batch counts the new rows before it.
class JoinTable {
public:
    JoinTable(Jobs& jobs, std::size_t expected_rows)
        : jobs_(jobs), parts_(expected_rows < kFew ? 1 : kParts) {
        const std::size_t rows = expected_rows / parts_.size();
        for (Part& part : parts_)
            part.slots.assign(std::bit_ceil(rows + rows / 2 + 16), kEmpty);
    }

    std::size_t rows() const { return rows_; }

    // The row of each item of [0, count), good until the next call. `items` must have
    //     std::uint64_t hash(std::size_t item), hash_of_row(std::uint32_t row)
    //     bool same(std::size_t a, std::size_t b), is_row(std::size_t item, std::uint32_t row)
    //     void make_room(std::size_t rows)                     for so many in all, before
    //     void write(std::size_t item, std::uint32_t row)      a new one
    // All but make_room are called from several threads at once. Rows and items of one batch
    // together must be fewer than 2^32.
    template <class Items>
    std::span<const std::uint32_t> join(std::size_t count, Items&& items) {
        hashes_.resize(count);
        numbers_.resize(count);
        count_ = count;
        if (count == 0) return numbers_;
        sort_into_parts(items);
        jobs_.for_each(static_cast<int>(parts_.size()), [&](int part, int) {
            const auto p = static_cast<std::size_t>(part);
            look_up(parts_[p], part_begin(p), part_begin(p + 1), items);
        });
        number_new_rows(items);
        return numbers_;
    }

private:
    static constexpr std::uint32_t kEmpty = 0xffffffff;
    static constexpr std::size_t kFew = 4096, kChunk = 4096;
    static constexpr std::size_t kParts = 64; // enough for the cores that share one table well

    static constexpr std::size_t kAhead = 12; // items

    struct alignas(64) Part {
        std::vector<std::uint32_t> slots; // rows_ + item: a new row, by the item that wants it
        std::size_t rows = 0;
        std::vector<std::uint32_t> fresh; // slots of this batch's new rows
    };

    std::size_t chunks() const { return (count_ + kChunk - 1) / kChunk; }
    std::size_t part_of(std::uint32_t hash) const { return hash & (parts_.size() - 1); }
    std::size_t first_slot(const Part& part, std::uint32_t hash) const {
        return hash / parts_.size() & (part.slots.size() - 1);
    }
    std::size_t part_begin(std::size_t part) const {
        if (parts_.size() == 1) return part == 0 ? 0 : count_;
        return part == parts_.size() ? count_ : begin_[part * chunks()];
    }
    static std::uint32_t shorter(std::uint64_t hash) {
        return static_cast<std::uint32_t>(hash >> 32);
    }

    // Hashes all items; the items of every part, in their order, come one after the other.
    template <class Items>
    void sort_into_parts(Items&& items) {
        const std::size_t parts = parts_.size();
        begin_.assign(parts == 1 ? 0 : chunks() * parts, 0);
        for_chunks(jobs_, count_, kChunk, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i)
                hashes_[i] = shorter(items.hash(i));
            for (std::size_t i = begin; parts > 1 && i < end; ++i)
                ++begin_[part_of(hashes_[i]) * chunks() + begin / kChunk];
        });
        if (parts == 1) return;
        order_.resize(count_);
        std::uint32_t sum = 0;
        for (std::uint32_t& begin : begin_)
            sum += std::exchange(begin, sum);
        for_chunks(jobs_, count_, kChunk, [&](std::size_t begin, std::size_t end, int) {
            std::uint32_t next[kParts];
            for (std::size_t p = 0; p < parts; ++p)
                next[p] = begin_[p * chunks() + begin / kChunk];
            for (std::size_t i = begin; i < end; ++i)
                order_[next[part_of(hashes_[i])]++] = static_cast<std::uint32_t>(i);
        });
    }

    template <class Items>
    void look_up(Part& part, std::size_t begin, std::size_t end, Items&& items) {
        const bool sorted = parts_.size() > 1;
        const auto item_at = [&](std::size_t k) { return sorted ? order_[k] : k; };
        part.fresh.clear();
        for (std::size_t k = begin; k < end; ++k) {
            // The table of a large model does not fit a cache: without the prefetch it takes a
            // sixth more time.
            if (k + kAhead < end)
                __builtin_prefetch(&part.slots[first_slot(part, hashes_[item_at(k + kAhead)])]);
            const std::size_t item = item_at(k);
            std::size_t slot = first_slot(part, hashes_[item]);
            while (part.slots[slot] != kEmpty && !is(item, part.slots[slot], items))
                slot = (slot + 1) & (part.slots.size() - 1);
            if (part.slots[slot] == kEmpty) {
                part.slots[slot] = static_cast<std::uint32_t>(rows_ + item);
                part.fresh.push_back(static_cast<std::uint32_t>(slot));
                numbers_[item] = static_cast<std::uint32_t>(rows_ + item);
                if (++part.rows > part.slots.size() / 4 * 3) grow(part, items);
            } else {
                numbers_[item] = part.slots[slot];
            }
        }
    }

    template <class Items>
    bool is(std::size_t item, std::uint32_t value, Items&& items) const {
        if (value < rows_) return items.is_row(item, value);
        return hashes_[item] == hashes_[value - rows_] && items.same(item, value - rows_);
    }

    template <class Items>
    void grow(Part& part, Items&& items) {
        const std::vector<std::uint32_t> old =
            std::exchange(part.slots, std::vector<std::uint32_t>(part.slots.size() * 2, kEmpty));
        part.fresh.clear();
        for (const std::uint32_t value : old) {
            if (value == kEmpty) continue;
            std::size_t slot = first_slot(part, value < rows_ ? shorter(items.hash_of_row(value))
                                                              : hashes_[value - rows_]);
            while (part.slots[slot] != kEmpty)
                slot = (slot + 1) & (part.slots.size() - 1);
            part.slots[slot] = value;
            if (value >= rows_) part.fresh.push_back(static_cast<std::uint32_t>(slot));
        }
    }

    // From here on hashes_ holds the rows of the items that want new ones.
    template <class Items>
    void number_new_rows(Items&& items) {
        const auto is_first = [&](std::size_t i) { return numbers_[i] == rows_ + i; };
        new_before_.assign(chunks() + 1, 0);
        for_chunks(jobs_, count_, kChunk, [&](std::size_t begin, std::size_t end, int) {
            std::size_t count = 0;
            for (std::size_t i = begin; i < end; ++i)
                count += is_first(i) ? 1 : 0;
            new_before_[begin / kChunk] = count;
        });
        std::size_t all = 0;
        for (std::size_t& before : new_before_)
            all += std::exchange(before, all);
        items.make_room(rows_ + all);
        for_chunks(jobs_, count_, kChunk, [&](std::size_t begin, std::size_t end, int) {
            auto row = static_cast<std::uint32_t>(rows_ + new_before_[begin / kChunk]);
            for (std::size_t i = begin; i < end; ++i) {
                if (!is_first(i)) continue;
                items.write(i, row);
                hashes_[i] = row++;
            }
        });
        const auto row_of = [&](std::uint32_t value) {
            return value < rows_ ? value : hashes_[value - rows_];
        };
        jobs_.for_each(static_cast<int>(parts_.size()), [&](int part, int) {
            Part& p = parts_[static_cast<std::size_t>(part)];
            for (const std::uint32_t slot : p.fresh)
                p.slots[slot] = row_of(p.slots[slot]);
        });
        for_chunks(jobs_, count_, kChunk, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i)
                numbers_[i] = row_of(numbers_[i]);
        });
        rows_ += all;
    }

    Jobs& jobs_;
    std::vector<Part> parts_;
    std::size_t rows_ = 0;  // of the batches before
    std::size_t count_ = 0; // items of this batch
    std::vector<std::uint32_t> hashes_, numbers_;
    std::vector<std::uint32_t> order_, begin_; // items by part; begin of each chunk's items there
    std::vector<std::size_t> new_before_;      // new rows before each chunk
};

} // namespace scanout::geom
