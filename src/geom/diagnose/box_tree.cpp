#include "geom/diagnose/box_tree.h"

#include "base/chunks.h"

#include <algorithm>

namespace scanout::geom {
namespace {

Box around(const Box& a, const Box& b) {
    return {
        {std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y), std::min(a.low.z, b.low.z)},
        {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y), std::max(a.high.z, b.high.z)}};
}

// 21 bits, two zeros before each.
std::uint64_t spread_bits(std::uint64_t x) {
    x = (x | x << 32) & 0x1f00000000ffff;
    x = (x | x << 16) & 0x1f0000ff0000ff;
    x = (x | x << 8) & 0x100f00f00f00f00f;
    x = (x | x << 4) & 0x10c30c30c30c30c3;
    return (x | x << 2) & 0x1249249249249249;
}

std::uint64_t cell(double x, double low, double high) {
    constexpr double kCells = 2097151; // 2^21 - 1
    return high > low ? static_cast<std::uint64_t>((x - low) / (high - low) * kCells) : 0;
}

std::uint64_t morton_code(const DVec3& p, const Box& all) {
    return spread_bits(cell(p.x, all.low.x, all.high.x)) |
           spread_bits(cell(p.y, all.low.y, all.high.y)) << 1 |
           spread_bits(cell(p.z, all.low.z, all.high.z)) << 2;
}

struct MortonKey {
    std::uint64_t code;
    std::uint32_t item;
};

} // namespace

BoxTree::BoxTree(Jobs& jobs, std::vector<Box> boxes) {
    if (boxes.empty()) return;
    Box all = {boxes[0].low * 0.5 + boxes[0].high * 0.5, boxes[0].low * 0.5 + boxes[0].high * 0.5};
    for (const Box& box : boxes) {
        const DVec3 middle = box.low * 0.5 + box.high * 0.5;
        all = around(all, {middle, middle});
    }
    std::vector<MortonKey> keys(boxes.size());
    for_chunks(jobs, boxes.size(), 16384, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i)
            keys[i] = {morton_code(boxes[i].low * 0.5 + boxes[i].high * 0.5, all),
                       static_cast<std::uint32_t>(i)};
    });
    std::sort(keys.begin(), keys.end(), [](const MortonKey& a, const MortonKey& b) {
        return a.code != b.code ? a.code < b.code : a.item < b.item;
    });
    order_.reserve(keys.size());
    boxes_.reserve(keys.size());
    for (const MortonKey& key : keys) {
        order_.push_back(key.item);
        boxes_.push_back(boxes[key.item]);
    }
    build_levels();
}

void BoxTree::build_levels() {
    const auto parents = [](const std::vector<Box>& children, std::size_t each) {
        std::vector<Box> level;
        level.reserve((children.size() + each - 1) / each);
        for (std::size_t i = 0; i < children.size(); i += each) {
            Box box = children[i];
            for (std::size_t k = i + 1; k < std::min(i + each, children.size()); ++k)
                box = around(box, children[k]);
            level.push_back(box);
        }
        return level;
    };
    levels_.push_back(parents(boxes_, kLeaf));
    while (levels_.back().size() > 1)
        levels_.push_back(parents(levels_.back(), 2));
}

} // namespace scanout::geom
