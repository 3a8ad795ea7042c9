#include "geom/triangulate.h"

#include "geom/plane_coordinates.h"
#include "geom/point_tree.h"
#include "math/predicates.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace scanout::geom {

DVec3 newell_normal(std::span<const DVec3> polygon) {
    DVec3 normal(0);
    for (std::size_t i = 2; i < polygon.size(); ++i)
        normal += cross3(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    return normal;
}

namespace {

// True of convex outlines, and of some that cross themselves: no cut of those is right. Corners on
// a straight edge do not turn: a fan would make a T-junction of them.
bool every_corner_turns_left(std::span<const DVec2> p) {
    const std::size_t n = p.size();
    for (std::size_t i = 0; i < n; ++i)
        if (orient2d(p[i], p[(i + 1) % n], p[(i + 2) % n]) <= 0) return false;
    return true;
}

// Of a quadrilateral's two diagonals the one that cuts it into two triangles that turn left; corner
// 0's where both do. A concave one has exactly one.
bool diagonal_is_13(std::span<const DVec2> p) {
    const auto worst = [&](int a, int b, int c, int d) {
        return std::min(orient2d(p[a], p[b], p[c]), orient2d(p[a], p[c], p[d]));
    };
    return worst(1, 2, 3, 0) > worst(0, 1, 2, 3);
}

// A corner on top of its neighbour, or the tip of a spike: the outline goes there and back along
// one line.
bool encloses_nothing(const DVec2& before, const DVec2& tip, const DVec2& after) {
    if (before == tip || after == tip) return true;
    const auto same_side = [](double x, double y, double of) {
        return (x < of) == (y < of) && (x > of) == (y > of);
    };
    return same_side(before.x, after.x, tip.x) && same_side(before.y, after.y, tip.y) &&
           orient2d(before, tip, after) == 0;
}

// Clips the corners that enclose nothing, down to three, and returns the others. They go before the
// first ear: the corner at the foot of a spike can be a concave one, which no test of an ear may
// miss.
std::vector<std::uint32_t> clip_spikes(std::span<const DVec2> p, std::vector<std::uint32_t>& out) {
    std::vector<std::uint32_t> left;
    std::size_t begin = 0; // of `left`: what lies before was clipped at the seam of the ring
    const auto clips = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (!encloses_nothing(p[a], p[b], p[c])) return false;
        out.insert(out.end(), {a, b, c});
        return true;
    };
    const auto n = static_cast<std::uint32_t>(p.size());
    std::uint32_t clipped = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
        left.push_back(i);
        while (left.size() >= 3 && n - clipped > 3 &&
               clips(left[left.size() - 3], left[left.size() - 2], i)) {
            left[left.size() - 2] = i;
            left.pop_back();
            ++clipped;
        }
    }
    while (left.size() - begin > 3) {
        if (clips(left[left.size() - 2], left.back(), left[begin]))
            left.pop_back();
        else if (clips(left.back(), left[begin], left[begin + 1]))
            ++begin;
        else
            break;
    }
    left.erase(left.begin(), left.begin() + static_cast<std::ptrdiff_t>(begin));
    return left;
}

// Ear clipping over a ring of the corners that are left. A corner b between a and c is an ear when
// a, b, c turn left and nothing of the outline reaches into the triangle. Only corners that do not
// turn left can be the first to reach in, so only those are tested; a tree finds them by place.
class EarClipper {
public:
    EarClipper(std::span<const DVec2> points, std::vector<std::uint32_t>& out)
        : p_(points), out_(out), left_(static_cast<std::uint32_t>(points.size())),
          next_(points.size()), previous_(points.size()), clipped_(points.size()),
          waiting_(points.size()), reflex_(points.size()), tree_(points, link()) {}

    void run() {
        // Ears whose cut-off edge passes through a corner come later than all others, so that
        // corners on a straight edge become corners of real triangles; then those without area.
        int stage = kClean;
        while (left_ > 3 && stage <= kFlat && work_ < kMaxWork) {
            const bool some = clip_all(static_cast<Stage>(stage));
            if (!some)
                ++stage;
            else if (stage == kFlat)
                stage = kClean;
        }
        for (std::uint32_t i = next_[hub_]; next_[i] != hub_; i = next_[i])
            emit(hub_, i, next_[i]);
    }

private:
    enum Stage { kClean, kTouching, kFlat };
    static constexpr std::uint64_t kMaxWork = 400'000'000; // tests of a point: some seconds

    int turn(std::uint32_t b) const { return orient2d(p_[previous_[b]], p_[b], p_[next_[b]]); }

    void emit(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        out_.insert(out_.end(), {a, b, c});
    }

    // Clips what the stage allows: round after round over the corners whose neighbours have
    // changed, since no other corner can have become an ear. A corner whose neighbour was clipped
    // waits for the next round, which keeps triangles from all meeting at one corner.
    bool clip_all(Stage stage) {
        queue_.clear();
        for (std::uint32_t i = next_[hub_], n = left_; n > 0; --n, i = next_[i])
            queue_.push_back(i);
        bool some = false;
        while (!queue_.empty()) {
            next_queue_.clear();
            for (const std::uint32_t b : queue_) {
                if (left_ == 3 || work_ >= kMaxWork) return true;
                ++work_;
                if (clipped_[b] || waiting_[b] || !may_clip(b, stage)) continue;
                clip(b);
                some = true;
            }
            for (const std::uint32_t b : next_queue_)
                waiting_[b] = false;
            std::swap(queue_, next_queue_);
        }
        return some;
    }

    bool may_clip(std::uint32_t b, Stage stage) {
        // A corner on top of its neighbour encloses nothing: it goes at once, whatever the stage.
        if (p_[previous_[b]] == p_[b] || p_[next_[b]] == p_[b]) return true;
        return stage == kFlat ? turn(b) == 0 : is_ear(b, stage);
    }

    void clip(std::uint32_t b) {
        const std::uint32_t a = previous_[b], c = next_[b];
        emit(a, b, c);
        next_[a] = c;
        previous_[c] = a;
        clipped_[b] = true;
        reflex_[b] = false;
        hub_ = c;
        --left_;
        for (const std::uint32_t neighbour : {a, c}) {
            if (reflex_[neighbour]) reflex_[neighbour] = turn(neighbour) <= 0;
            if (waiting_[neighbour]) continue;
            waiting_[neighbour] = true;
            next_queue_.push_back(neighbour);
        }
    }

    bool is_ear(std::uint32_t b, Stage stage) {
        if (turn(b) <= 0) return false;
        const DVec2 &pa = p_[previous_[b]], &pb = p_[b], &pc = p_[next_[b]];
        const DVec2 lo(std::min({pa.x, pb.x, pc.x}), std::min({pa.y, pb.y, pc.y}));
        const DVec2 hi(std::max({pa.x, pb.x, pc.x}), std::max({pa.y, pb.y, pc.y}));
        return tree_.visit(pa, pb, pc, work_, [&](std::uint32_t v) {
            if (!reflex_[v]) return PointTree::Visit::forget; // clipped, or turns left by now
            const DVec2& q = p_[v];
            const bool outside = q.x < lo.x || q.x > hi.x || q.y < lo.y || q.y > hi.y;
            return outside || !reaches_in(b, v, stage) ? PointTree::Visit::go_on
                                                       : PointTree::Visit::stop;
        });
    }

    // Does the outline at corner v reach into the triangle at ear candidate b? It does where v lies
    // inside; where v lies on the border, when one of the edges at v leads inside.
    bool reaches_in(std::uint32_t b, std::uint32_t v, Stage stage) const {
        const std::uint32_t a = previous_[b], c = next_[b];
        if (v == a || v == b || v == c) return false;
        const DVec2 &pa = p_[a], &pb = p_[b], &pc = p_[c], &q = p_[v];
        const int ab = orient2d(pa, pb, q), bc = orient2d(pb, pc, q), ca = orient2d(pc, pa, q);
        if (ab < 0 || bc < 0 || ca < 0) return false;
        if (ab > 0 && bc > 0 && ca > 0) return true;
        if (stage == kClean && ab > 0 && bc > 0) return true; // on the edge that would be cut
        const auto leads_inside = [&](const DVec2& to) {
            return (ab > 0 || orient2d(pa, pb, to) > 0) && (bc > 0 || orient2d(pb, pc, to) > 0) &&
                   (ca > 0 || orient2d(pc, pa, to) > 0);
        };
        return leads_inside(p_[next_[v]]) || leads_inside(p_[previous_[v]]);
    }

    // Makes the ring. Gives the corners that do not turn left: straight ones, and a spike's tip,
    // count with the concave.
    std::vector<std::uint32_t> link() {
        for (std::uint32_t i = 0; i < left_; ++i) {
            next_[i] = i + 1 < left_ ? i + 1 : 0;
            previous_[i] = i > 0 ? i - 1 : left_ - 1;
        }
        std::vector<std::uint32_t> found;
        for (std::uint32_t i = 0; i < left_; ++i)
            if ((reflex_[i] = turn(i) <= 0)) found.push_back(i);
        return found;
    }

    std::span<const DVec2> p_;
    std::vector<std::uint32_t>& out_;
    std::uint32_t left_; // corners in the ring
    std::vector<std::uint32_t> next_, previous_;
    std::vector<std::uint8_t> clipped_, waiting_; // no longer in the ring; in next_queue_
    std::vector<std::uint8_t> reflex_;            // in the ring, and does not turn left
    std::vector<std::uint32_t> queue_, next_queue_;
    std::uint32_t hub_ = 0; // some corner of the ring
    std::uint64_t work_ = 0;
    PointTree tree_; // of the reflex corners; last, since it is made from the others
};

// Of a polygon of the plane; counter-clockwise.
void cut(std::span<const DVec2> points, std::vector<std::uint32_t>& out) {
    const std::size_t n = points.size();
    if (n == 4 && diagonal_is_13(points)) {
        out.insert(out.end(), {1, 2, 3, 1, 3, 0});
    } else if (n <= 4 || every_corner_turns_left(points)) {
        for (std::uint32_t i = 2; i < n; ++i)
            out.insert(out.end(), {0, i - 1, i});
    } else {
        const std::vector<std::uint32_t> left = clip_spikes(points, out);
        if (left.size() == n) return EarClipper(points, out).run();
        std::vector<DVec2> rest;
        for (const std::uint32_t corner : left)
            rest.push_back(points[corner]);
        const std::size_t done = out.size();
        cut(rest, out);
        for (std::size_t i = done; i < out.size(); ++i)
            out[i] = left[out[i]];
    }
}

} // namespace

void triangulate(std::span<const DVec3> polygon, std::vector<std::uint32_t>& out) {
    const std::size_t n = polygon.size();
    if (n < 3) return;
    std::array<DVec2, 16> few; // most polygons are small: no allocation for those
    std::vector<DVec2> many(n > few.size() ? n : 0);
    const std::span<DVec2> points(n > few.size() ? many.data() : few.data(), n);
    const PlaneCoordinates project(newell_normal(polygon));
    for (std::size_t i = 0; i < n; ++i)
        points[i] = project(polygon[i]);
    cut(points, out);
}

} // namespace scanout::geom
