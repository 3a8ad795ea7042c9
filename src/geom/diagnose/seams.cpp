#include "geom/diagnose/seams.h"

#include "base/chunks.h"
#include "geom/diagnose/box_tree.h"
#include "geom/diagnose/families.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <tuple>
#include <utility>

namespace scanout::geom {
namespace {

double distance_between(const DVec3& a, const DVec3& b) {
    const DVec3 d = b - a;
    return std::sqrt(dot3(d, d));
}

double distance_from_segment(const DVec3& p, const DVec3& from, const DVec3& to) {
    const DVec3 direction = to - from;
    const double squared = dot3(direction, direction);
    const double along = squared > 0 ? dot3(p - from, direction) / squared : 0;
    return distance_between(p, from + std::clamp(along, 0.0, 1.0) * direction);
}

// Does a segment, `reach` thick, meet the box? Parts of it are clipped by the box's slabs.
bool meets_segment(const Box& box, const DVec3& from, const DVec3& to, double reach) {
    double enter = 0, leave = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = box.low[axis] - reach, high = box.high[axis] + reach;
        const double start = from[axis], step = to[axis] - start;
        if (step == 0) {
            if (start < low || start > high) return false;
            continue;
        }
        const double t = (low - start) / step, u = (high - start) / step;
        enter = std::max(enter, std::min(t, u));
        leave = std::min(leave, std::max(t, u));
    }
    constexpr double kRounding = 1e-9;
    return enter <= leave + kRounding;
}

class SeamFinder {
public:
    SeamFinder(const Surface& surface, double tolerance, std::span<const std::uint8_t> may_be_open)
        : surface_(surface), tolerance_(tolerance), longest_(surface.places(), 0) {
        surface.for_each_edge([&](std::span<const Surface::EdgeUse> uses) {
            if (!is_one_sheet(uses)) return;
            if (!may_be_open.empty() && may_be_open[uses[0].corner] == 0) return;
            open_.insert(open_.end(), uses.begin(), uses.end());
            const double length =
                distance_between(surface.at(uses[0].low), surface.at(uses[0].high));
            for (const std::uint32_t place : {uses[0].low, uses[0].high})
                longest_[place] = std::max(longest_[place], length);
        });
        for (std::uint32_t place = 0; place < longest_.size(); ++place)
            if (longest_[place] > 0) points_.push_back(place);
        for (const Surface::EdgeUse& edge : open_) {
            ends_.push_back({edge.low, edge.high});
            ends_.push_back({edge.high, edge.low});
        }
        std::sort(ends_.begin(), ends_.end());
    }

    Seams find() {
        std::vector<Box> boxes;
        boxes.reserve(points_.size());
        for (const std::uint32_t place : points_)
            boxes.push_back({surface_.at(place), surface_.at(place)});
        const BoxTree tree(surface_.jobs(), std::move(boxes));
        most_asked_ = kAnyway + kAskedAnEdge * open_.size();
        most_found_ = kAnyway + kFoundAnEdge * open_.size();
        Seams out;
        constexpr std::size_t kChunk = 256;
        std::vector<Seams> parts((open_.size() + kChunk - 1) / kChunk);
        for_chunks(surface_.jobs(), open_.size(), kChunk,
                   [&](std::size_t begin, std::size_t end, int) {
                       for (std::size_t i = begin; i < end; ++i)
                           search_edge(tree, open_[i], parts[begin / kChunk]);
                   });
        if (is_crowded()) return {{}, {}, true}; // whichever thread asked for how many
        for (const Seams& part : parts) {
            out.t_vertices.insert(out.t_vertices.end(), part.t_vertices.begin(),
                                  part.t_vertices.end());
            out.cracks.insert(out.cracks.end(), part.cracks.begin(), part.cracks.end());
        }
        put_in_order(out);
        return out;
    }

private:
    // One face, or one and its turned twin.
    bool is_one_sheet(std::span<const Surface::EdgeUse> uses) const {
        if (uses.size() != 2) return uses.size() == 1;
        const std::vector<SameFace>& same = surface_.same_faces();
        const auto twin =
            std::lower_bound(same.begin(), same.end(), uses[1].face,
                             [](const SameFace& s, std::uint32_t face) { return s.face < face; });
        return twin != same.end() && twin->face == uses[1].face && twin->first == uses[0].face;
    }

    double reach(double length) const { return std::min(tolerance_, kSeamShare * length); }

    // Open places near the edge: within it, or near its end at which the edge begins.
    void search_edge(const BoxTree& tree, const Surface::EdgeUse& edge, Seams& out) {
        const DVec3 from = surface_.at(surface_.corner_place(edge.corner));
        const DVec3 to =
            surface_.at(surface_.corner_place(edge.corner) == edge.low ? edge.high : edge.low);
        const double length = distance_between(from, to);
        const double near =
            std::max({reach(length), reach(longest_[edge.low]), reach(longest_[edge.high])});
        const DVec3 reach(near * 1.001); // the rounding of the distances included
        const Box around{glm::min(from, to) - reach, glm::max(from, to) + reach};
        const std::size_t before = out.t_vertices.size() + out.cracks.size();
        const auto found = [&] { return out.t_vertices.size() + out.cracks.size() - before; };
        std::size_t asked = 0; // places
        const bool crowded = is_crowded();
        tree.visit(
            0,
            [&](const Box& box) {
                return !crowded && asked <= most_asked_ && found() <= most_found_ &&
                       boxes_meet(box, around) && meets_segment(box, from, to, near);
            },
            [&](std::size_t i) {
                const std::uint32_t place = points_[tree.item_at(i)];
                if (place == edge.low || place == edge.high) return;
                ++asked;
                if (!add_t_vertex(edge, place, from, to, length, out)) {
                    add_crack(edge, edge.low, place, out);
                    add_crack(edge, edge.high, place, out);
                }
            });
        asked_ += asked;
        found_ += found();
    }

    bool is_crowded() const { return asked_ > most_asked_ || found_ > most_found_; }

    bool add_t_vertex(const Surface::EdgeUse& edge, std::uint32_t place, const DVec3& from,
                      const DVec3& to, double length, Seams& out) const {
        const DVec3 p = surface_.at(place), direction = to - from;
        const double along = dot3(p - from, direction) / (length * length);
        const double most = reach(length);
        if (!(along * length > most) || !((1 - along) * length > most)) return false;
        const double distance = distance_between(p, from + along * direction);
        if (distance > most || surface_.has_corner_at(edge.face, place)) return false;
        out.t_vertices.push_back(
            {edge.corner, edge.face, place, along, distance, is_on_seam(place, from, to, most)});
        return true;
    }

    // Does an open edge at a place within the edge run along it, to its own end or to the edge's?
    bool is_on_seam(std::uint32_t place, const DVec3& from, const DVec3& to, double most) const {
        const auto first = std::lower_bound(ends_.begin(), ends_.end(), std::pair(place, 0U));
        for (auto end = first; end != ends_.end() && end->first == place; ++end) {
            const DVec3 p = surface_.at(place), q = surface_.at(end->second);
            const DVec3& ahead = dot3(q - p, to - from) > 0 ? to : from;
            if (distance_from_segment(q, p, ahead) <= most ||
                distance_from_segment(ahead, p, q) <= most)
                return true;
        }
        return false;
    }

    void add_crack(const Surface::EdgeUse& edge, std::uint32_t a, std::uint32_t b,
                   Seams& out) const {
        const double distance = distance_between(surface_.at(a), surface_.at(b));
        if (distance > reach(std::min(longest_[a], longest_[b]))) return;
        if (!joined(a, b))
            out.cracks.push_back({std::min(a, b), std::max(a, b), edge.face, distance});
    }

    bool joined(std::uint32_t a, std::uint32_t b) const {
        const auto key = [](const Surface::EdgeUse& e) { return std::pair(e.low, e.high); };
        const std::pair wanted(std::min(a, b), std::max(a, b));
        const auto found = std::lower_bound(
            surface_.edges().begin(), surface_.edges().end(), wanted,
            [&](const Surface::EdgeUse& e, const auto& value) { return key(e) < value; });
        return found != surface_.edges().end() && key(*found) == wanted;
    }

    // A crack is met from several edges: the lowest face stays.
    static void put_in_order(Seams& out) {
        std::sort(
            out.t_vertices.begin(), out.t_vertices.end(), [](const TVertex& a, const TVertex& b) {
                return std::tie(a.corner, a.along, a.place) < std::tie(b.corner, b.along, b.place);
            });
        std::sort(out.cracks.begin(), out.cracks.end(), [](const Crack& a, const Crack& b) {
            return std::tie(a.place, a.other, a.face) < std::tie(b.place, b.other, b.face);
        });
        out.cracks.erase(std::unique(out.cracks.begin(), out.cracks.end(),
                                     [](const Crack& a, const Crack& b) {
                                         return a.place == b.place && a.other == b.other;
                                     }),
                         out.cracks.end());
    }

    // Of a map of Vienna, exported by SketchUp, 20 an edge are asked, and one of 30 edges has one.
    static constexpr std::size_t kAnyway = 100'000, kAskedAnEdge = 256, kFoundAnEdge = 8;

    const Surface& surface_;
    double tolerance_;
    std::size_t most_asked_ = 0, most_found_ = 0;
    std::atomic<std::size_t> asked_ = 0; // open places near edges, so far
    std::atomic<std::size_t> found_ = 0; // T-vertices and cracks
    std::vector<Surface::EdgeUse> open_;
    std::vector<double> longest_; // open edge at each place
    std::vector<std::uint32_t> points_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> ends_; // both ways of the open edges
};

} // namespace

Seams find_seams(const Surface& surface, double tolerance,
                 std::span<const std::uint8_t> may_be_open) {
    return SeamFinder(surface, tolerance, may_be_open).find();
}

void examine_seams(const Surface& surface, const DiagnoseOptions& how, Findings& findings) {
    const Seams seams = find_seams(surface, how.tolerance * surface.framing().radius);
    Tally t_vertices, cracks;
    const auto place = [&](std::uint32_t face, std::uint32_t at) {
        return HazardPlace{face, {}, surface.position_of(at), file_position(surface, at)};
    };
    for (const TVertex& t : seams.t_vertices) {
        t_vertices.add(t.distance, place(t.face, t.place));
        findings.mark(t.face, Hazard::t_vertices);
    }
    for (const Crack& crack : seams.cracks) {
        cracks.add(crack.distance, place(crack.face, crack.place));
        findings.mark(crack.face, Hazard::cracks);
    }
    const double searched = seams.crowded ? 0 : 1;
    findings.add(Hazard::t_vertices, t_vertices, t_vertices.badness() * surface.unit(), searched);
    findings.add(Hazard::cracks, cracks, cracks.badness() * surface.unit(), searched);
}

} // namespace scanout::geom
