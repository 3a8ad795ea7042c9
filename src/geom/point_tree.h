// Points of the plane in a tree of oriented boxes, to find the points near a triangle quickly: ear
// clipping then need not test every corner against every ear. Gottschalk et al. 1996. Boxes
// along the axes are not enough: ears of a rotated comb are slivers along its teeth's feet, and
// would meet the boxes of them all.
#pragma once

#include "math/vec.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace scanout::geom {

class PointTree {
public:
    // Holds the points with the numbers `members`.
    PointTree(std::span<const DVec2> points, std::vector<std::uint32_t> members);

    enum class Visit { go_on, forget, stop }; // forget: this point is never visited again

    // Visits every point within the counter-clockwise triangle or on its border, and some near it,
    // until one visit says stop. Returns false then. `work` grows by the number of boxes and points
    // looked at.
    template <class Visitor>
    bool visit(const DVec2& a, const DVec2& b, const DVec2& c, std::uint64_t& work,
               Visitor&& visitor) {
        const Triangle triangle{{a, b, c}, {b - a, c - b, a - c}};
        std::array<std::uint32_t, 64> waiting; // at most two a level
        waiting[0] = 0;
        for (std::size_t depth = 1; depth > 0;) {
            const std::uint32_t node = waiting[--depth];
            ++work;
            if (live_[node] == 0 || !may_meet(boxes_[node], triangle)) continue;
            if (node < leaves_ - 1) {
                waiting[depth++] = 2 * node + 2;
                waiting[depth++] = 2 * node + 1;
            } else if (!visit_leaf(node, work, visitor)) {
                return false;
            }
        }
        return true;
    }

private:
    struct Triangle {
        DVec2 corners[3], edges[3];
    };
    struct Box {
        DVec2 centre, along; // a unit vector; the other axis is at its left
        DVec2 half;          // of the size along both axes
    };
    struct Bounds {
        DVec2 lo, hi;
    };

    static bool may_meet(const Box& box, const Triangle& triangle);

    template <class Visitor>
    bool visit_leaf(std::uint32_t leaf, std::uint64_t& work, Visitor&& visitor) {
        std::uint32_t* const members = &members_[first_of(leaf - (leaves_ - 1))];
        work += live_[leaf];
        for (std::uint32_t i = 0; i < live_[leaf];) {
            switch (visitor(members[i])) {
            case Visit::go_on:
                ++i;
                break;
            case Visit::forget:
                members[i] = members[live_[leaf] - 1];
                for (std::uint32_t node = leaf + 1; node > 0; node /= 2)
                    --live_[node - 1];
                break;
            case Visit::stop:
                return false;
            }
        }
        return true;
    }

    // Of a leaf's members, counted from 0 along the bottom of the tree.
    std::size_t first_of(std::uint64_t leaf) const { return leaf * members_.size() / leaves_; }
    void build(std::span<const DVec2> points, std::uint32_t node, std::size_t first,
               std::size_t leaves);
    Bounds bounds(std::span<const DVec2> points, const Box& axes, std::size_t begin,
                  std::size_t end) const;

    std::uint32_t leaves_ = 1;           // a power of two
    std::vector<std::uint32_t> members_; // leaf after leaf; those not forgotten come first
    // Node i has the children 2 i + 1 and 2 i + 2; the leaves are the last ones.
    std::vector<Box> boxes_;
    std::vector<std::uint32_t> live_; // members below the node that are not forgotten
};

} // namespace scanout::geom
