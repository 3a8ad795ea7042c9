// A bounding-volume hierarchy over boxes: items in Morton order, four a leaf, and above them a
// binary tree without pointers. Lauterbach et al. 2009 build it likewise.
#pragma once

#include "base/jobs.h"
#include "geom/topology.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace scanout::geom {

inline bool boxes_meet(const Box& a, const Box& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y &&
           b.low.y <= a.high.y && a.low.z <= b.high.z && b.low.z <= a.high.z;
}

class BoxTree {
public:
    static constexpr std::size_t kLeaf = 4; // items

    // Boxes must be finite.
    BoxTree(Jobs& jobs, std::vector<Box> boxes);

    std::size_t size() const { return order_.size(); }
    std::uint32_t item_at(std::size_t place) const { return order_[place]; } // in Morton order
    const Box& box_at(std::size_t place) const { return boxes_[place]; }
    std::size_t leaves() const { return levels_.empty() ? 0 : levels_.front().size(); }
    const Box& leaf(std::size_t number) const { return levels_.front()[number]; }

    // Calls visit(place in Morton order) for items from `first` on in leaves whose boxes
    // meets(box) says yes to.
    template <class Meets, class Visit>
    void visit(std::size_t first, Meets&& meets, Visit&& visit) const {
        if (order_.empty()) return;
        std::array<std::pair<std::uint32_t, std::uint32_t>, 64> stack; // level, node
        std::size_t depth = 0;
        stack[depth++] = {static_cast<std::uint32_t>(levels_.size() - 1), 0};
        while (depth > 0) {
            const auto [level, node] = stack[--depth];
            const std::size_t end = (std::size_t{node} + 1) * kLeaf << level;
            if (end <= first || !meets(levels_[level][node])) continue;
            if (level == 0) {
                const std::size_t begin = std::size_t{node} * kLeaf;
                for (std::size_t i = begin < first ? first : begin; i < end && i < order_.size();
                     ++i)
                    visit(i);
                continue;
            }
            if (2 * node + 1 < levels_[level - 1].size())
                stack[depth++] = {level - 1, 2 * node + 1};
            stack[depth++] = {level - 1, 2 * node};
        }
    }

private:
    void build_levels();

    std::vector<std::uint32_t> order_;
    std::vector<Box> boxes_;               // in this order
    std::vector<std::vector<Box>> levels_; // of nodes: leaves first, the root last
};

} // namespace scanout::geom
