// Disjoint sets (union-find) of numbers from 0 on (Tarjan 1975): which of them are connected.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace scanout::geom {

// A forest in which each item points towards the root of its set.
class DisjointSets {
public:
    explicit DisjointSets(std::size_t items) : parent_(items) {
        for (std::size_t i = 0; i < items; ++i)
            parent_[i] = static_cast<std::uint32_t>(i);
    }
    std::uint32_t root(std::uint32_t item) {
        while (parent_[item] != item)
            item = parent_[item] = parent_[parent_[item]];
        return item;
    }
    // The lower one becomes the root of both.
    void join(std::uint32_t a, std::uint32_t b) {
        a = root(a);
        b = root(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::uint32_t> parent_;
};

} // namespace scanout::geom
