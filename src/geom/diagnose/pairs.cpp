// Triangles that intersect, and those that overlap in one plane: pairs with boxes that meet, from a
// bounding-volume hierarchy.
#include "base/chunks.h"
#include "base/stopwatch.h"
#include "geom/diagnose/box_tree.h"
#include "geom/diagnose/families.h"
#include "geom/diagnose/triangle_pairs.h"

#include <algorithm>
#include <cmath>

namespace scanout::geom {
namespace {

class PairSearch {
public:
    PairSearch(const Surface& surface, const DiagnoseOptions& how, Findings& findings)
        : surface_(surface), how_(how), findings_(findings),
          gap_(how.gap * surface.framing().radius), touch_(how.touch * surface.framing().radius),
          tree_(surface.jobs(), boxes_of(surface)),
          tallies_(static_cast<std::size_t>(surface.jobs().threads())) {}

    // False where progress ended it.
    bool run() {
        const Stopwatch watch;
        std::atomic<std::size_t> searched{0};
        // Rounds, between which the calling thread tells how far it is.
        constexpr std::size_t kChunk = 128, kRound = 64 * kChunk; // leaves
        const std::size_t leaves = tree_.leaves();
        for (std::size_t from = 0; from < leaves; from += kRound) {
            const std::size_t to = std::min(from + kRound, leaves);
            for_chunks(surface_.jobs(), to - from, kChunk,
                       [&](std::size_t begin, std::size_t end, int worker) {
                           std::size_t i = begin;
                           for (; i < end && watch.milliseconds() < 1000 * how_.seconds; ++i)
                               search_from(from + i, tallies_[static_cast<std::size_t>(worker)]);
                           searched.fetch_add(i - begin, std::memory_order_relaxed);
                       });
            if (how_.progress &&
                !how_.progress(0.5 + 0.5 * static_cast<double>(to) / static_cast<double>(leaves)))
                return false;
        }
        tell(leaves == 0 ? 1 : static_cast<double>(searched) / static_cast<double>(leaves));
        return true;
    }

private:
    struct alignas(64) Tallies {
        Tally crossing, overlapping;
    };

    static std::vector<Box> boxes_of(const Surface& surface) {
        std::vector<Box> boxes;
        boxes.reserve(surface.triangles().size());
        for (const Surface::Triangle& t : surface.triangles()) {
            const DVec3 &a = surface.at(t.place[0]), &b = surface.at(t.place[1]),
                        &c = surface.at(t.place[2]);
            boxes.push_back(
                {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
                 {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}),
                  std::max({a.z, b.z, c.z})}});
        }
        return boxes;
    }

    // Pairs of the leaf's triangles with those behind them in the tree's order: one walk through
    // the tree for all four.
    void search_from(std::size_t leaf, Tallies& tallies) {
        const std::size_t begin = leaf * BoxTree::kLeaf;
        const std::size_t end = std::min(begin + BoxTree::kLeaf, tree_.size());
        const Box box = grown(tree_.leaf(leaf));
        tree_.visit(
            begin, [&](const Box& other) { return boxes_meet(box, other); },
            [&](std::size_t k) {
                const Box other = grown(tree_.box_at(k));
                for (std::size_t i = begin; i < std::min(end, k); ++i)
                    if (boxes_meet(tree_.box_at(i), other))
                        judge(surface_.triangles()[tree_.item_at(i)],
                              surface_.triangles()[tree_.item_at(k)], tallies);
            });
    }
    Box grown(const Box& box) const { return {box.low - DVec3(gap_), box.high + DVec3(gap_)}; }

    void judge(const Surface::Triangle& a, const Surface::Triangle& b, Tallies& tallies) {
        int shared = 0;
        for (const std::uint32_t place : a.place)
            shared += std::count(b.place.begin(), b.place.end(), place) > 0 ? 1 : 0;
        if (shared == 3) return; // a duplicate, or turned
        const Corners corners_a = corners_of(a), corners_b = corners_of(b);
        if (shared < 2 && triangles_cross(corners_a, corners_b, touch_)) {
            tallies.crossing.add(0, pair_place(a, b));
            mark(a, b, Hazard::intersections);
            return;
        }
        // The triangles of one face are cut so that they do not overlap, unless it crosses itself.
        if (a.face == b.face) return;
        const auto gap = overlap_gap(corners_a, corners_b, gap_);
        if (!gap) return;
        tallies.overlapping.add(-*gap, pair_place(a, b));
        mark(a, b, Hazard::overlaps);
    }

    Corners corners_of(const Surface::Triangle& t) const {
        return {surface_.at(t.place[0]), surface_.at(t.place[1]), surface_.at(t.place[2])};
    }
    HazardPlace pair_place(const Surface::Triangle& a, const Surface::Triangle& b) const {
        const Surface::Triangle& low = a.face <= b.face ? a : b;
        return {low.face, std::max(a.face, b.face), {}, middle_of(surface_, low)};
    }
    void mark(const Surface::Triangle& a, const Surface::Triangle& b, Hazard hazard) {
        findings_.mark(a.face, hazard);
        findings_.mark(b.face, hazard);
    }

    void tell(double searched) {
        Tallies all;
        for (const Tallies& some : tallies_) {
            all.crossing.add(some.crossing);
            all.overlapping.add(some.overlapping);
        }
        findings_.add(Hazard::overlaps, all.overlapping,
                      -all.overlapping.badness() * surface_.unit(), searched);
        findings_.add(Hazard::intersections, all.crossing, 0, searched);
    }

    const Surface& surface_;
    const DiagnoseOptions& how_;
    Findings& findings_;
    double gap_, touch_; // of at()
    BoxTree tree_;
    std::vector<Tallies> tallies_; // of each worker
};

} // namespace

bool examine_pairs(const Surface& surface, const DiagnoseOptions& how, Findings& findings) {
    return PairSearch(surface, how, findings).run();
}

} // namespace scanout::geom
