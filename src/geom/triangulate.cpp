#include "geom/triangulate.h"

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

// Along the largest axis of the normal, so that the area cannot vanish; the other two axes are
// taken in the order that makes the polygon counter-clockwise.
class Projection {
public:
    explicit Projection(const DVec3& normal) {
        const DVec3 size(std::abs(normal.x), std::abs(normal.y), std::abs(normal.z));
        const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
        u_ = (axis + 1) % 3;
        v_ = (axis + 2) % 3;
        if (normal[axis] < 0) std::swap(u_, v_);
    }
    DVec2 operator()(const DVec3& p) const { return {p[u_], p[v_]}; }

private:
    int u_, v_;
};

// Every corner turns left, and the outline goes round once: along it the direction changes between
// rightward and leftward twice (a pentagram turns left everywhere too, but goes round twice).
// Corners on a straight edge do not count as convex: a fan would make them into a T-junction.
bool is_strictly_convex(std::span<const DVec2> p) {
    const std::size_t n = p.size();
    int changes = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const DVec2 &a = p[i], &b = p[i + 1 < n ? i + 1 : 0], &c = p[i + 2 < n ? i + 2 : i + 2 - n];
        if (orient2d(a, b, c) <= 0) return false;
        const auto rightward = [](const DVec2& d) { return d.x > 0 || (d.x == 0 && d.y > 0); };
        changes += rightward(b - a) != rightward(c - b);
    }
    return changes == 2;
}

// Of a quadrilateral's two diagonals the one that cuts it into two triangles that turn left; corner
// 0's where both do. A concave one has exactly one.
bool diagonal_is_13(std::span<const DVec2> p) {
    const auto worst = [&](int a, int b, int c, int d) {
        return std::min(orient2d(p[a], p[b], p[c]), orient2d(p[a], p[c], p[d]));
    };
    return worst(1, 2, 3, 0) > worst(0, 1, 2, 3);
}

// Ear clipping over a ring of the corners that are left. A corner b between a and c is an ear when
// a, b, c turn left and nothing of the outline reaches into the triangle. Only corners that do not
// turn left can be the first to reach in, so only those are tested; a grid finds them by place.
class EarClipper {
public:
    EarClipper(std::span<const DVec2> points, std::vector<std::uint32_t>& out)
        : p_(points), out_(out), left_(static_cast<std::uint32_t>(points.size())),
          next_(points.size()), previous_(points.size()), reflex_(points.size()) {
        for (std::uint32_t i = 0; i < left_; ++i) {
            next_[i] = i + 1 < left_ ? i + 1 : 0;
            previous_[i] = i > 0 ? i - 1 : left_ - 1;
        }
        make_grid();
    }

    void run() {
        // Ears whose cut-off edge passes through a corner come later than all others, so that
        // corners on a straight edge become corners of real triangles; then those without area.
        std::uint32_t at = 0;
        int stage = 0;
        while (left_ > 3 && stage < 3 && work_ < kMostWork) {
            const bool some = sweep(at, static_cast<Stage>(stage));
            if (!some)
                ++stage;
            else if (stage == kFlat)
                stage = kClean;
        }
        const std::uint32_t hub = at;
        for (std::uint32_t i = next_[hub]; next_[i] != hub; i = next_[i])
            emit(hub, i, next_[i]);
    }

private:
    enum Stage { kClean, kTouching, kFlat };
    static constexpr std::uint64_t kMostWork = 400'000'000; // tests of a point: some seconds

    int turn(std::uint32_t b) const { return orient2d(p_[previous_[b]], p_[b], p_[next_[b]]); }

    void emit(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        out_.insert(out_.end(), {a, b, c});
    }

    // Once round from `at`, clipping what the stage allows. After a clip the next corner is passed
    // over, which keeps triangles from all meeting at one corner.
    bool sweep(std::uint32_t& at, Stage stage) {
        bool some = false;
        for (std::uint32_t steps = left_; steps > 0 && left_ > 3 && work_ < kMostWork; --steps) {
            const std::uint32_t a = previous_[at], c = next_[at];
            // A corner on top of its neighbour encloses nothing: cut it off at once, whatever the
            // stage.
            const bool same = p_[a] == p_[at] || p_[c] == p_[at];
            if (same || (stage == kFlat ? turn(at) == 0 : is_ear(at, stage))) {
                clip(at);
                some = true;
                at = next_[c];
            } else {
                at = c;
            }
            ++work_;
        }
        return some;
    }

    void clip(std::uint32_t b) {
        const std::uint32_t a = previous_[b], c = next_[b];
        emit(a, b, c);
        next_[a] = c;
        previous_[c] = a;
        reflex_[b] = false;
        --left_;
        if (reflex_[a]) reflex_[a] = turn(a) <= 0;
        if (reflex_[c]) reflex_[c] = turn(c) <= 0;
    }

    bool is_ear(std::uint32_t b, Stage stage) {
        if (turn(b) <= 0) return false;
        const DVec2 &pa = p_[previous_[b]], &pb = p_[b], &pc = p_[next_[b]];
        const DVec2 lo(std::min({pa.x, pb.x, pc.x}), std::min({pa.y, pb.y, pc.y}));
        const DVec2 hi(std::max({pa.x, pb.x, pc.x}), std::max({pa.y, pb.y, pc.y}));
        const int x1 = column(hi.x), y0 = row(lo.y), y1 = row(hi.y);
        for (int x = column(lo.x); x <= x1; ++x)
            for (int y = y0; y <= y1; ++y) {
                std::uint32_t* const cell = &cells_[cell_begin_[index(x, y)]];
                std::uint32_t& count = cell_count_[index(x, y)];
                work_ += count + 1;
                for (std::uint32_t i = 0; i < count; ++i) {
                    const std::uint32_t v = cell[i];
                    if (!reflex_[v]) { // it was clipped, or turns left by now
                        cell[i--] = cell[--count];
                        continue;
                    }
                    const DVec2& q = p_[v];
                    if (q.x < lo.x || q.x > hi.x || q.y < lo.y || q.y > hi.y) continue;
                    if (reaches_in(b, v, stage)) return false;
                }
            }
        return true;
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

    // The corners that do not turn left, sorted into about as many cells.
    void make_grid() {
        std::uint32_t reflex = 0;
        DVec2 lo = p_[0], hi = p_[0];
        for (std::uint32_t i = 0; i < left_; ++i) {
            reflex_[i] = turn(i) <= 0;
            reflex += reflex_[i];
            lo = {std::min(lo.x, p_[i].x), std::min(lo.y, p_[i].y)};
            hi = {std::max(hi.x, p_[i].x), std::max(hi.y, p_[i].y)};
        }
        side_ = 1;
        while (side_ < 1024 && side_ * side_ < static_cast<int>(reflex / 4))
            side_ *= 2;
        origin_ = lo;
        per_unit_ = {hi.x > lo.x ? side_ / (hi.x - lo.x) : 0,
                     hi.y > lo.y ? side_ / (hi.y - lo.y) : 0};

        const std::size_t cells = static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
        cell_count_.assign(cells, 0);
        cell_begin_.assign(cells, 0);
        cells_.resize(reflex + 1); // + 1: an empty last cell has an address too
        for (std::uint32_t i = 0; i < left_; ++i)
            if (reflex_[i]) ++cell_count_[index_of(i)];
        for (std::size_t i = 1; i < cells; ++i)
            cell_begin_[i] = cell_begin_[i - 1] + cell_count_[i - 1];
        std::fill(cell_count_.begin(), cell_count_.end(), 0);
        for (std::uint32_t i = 0; i < left_; ++i)
            if (reflex_[i]) cells_[cell_begin_[index_of(i)] + cell_count_[index_of(i)]++] = i;
    }
    // Both never fall as x or y grows, so a point within a box lies within the box's cells.
    int column(double x) const { return cell_of((x - origin_.x) * per_unit_.x); }
    int row(double y) const { return cell_of((y - origin_.y) * per_unit_.y); }
    int cell_of(double t) const {
        return t >= side_ ? side_ - 1 : t >= 0 ? static_cast<int>(t) : 0;
    }
    std::size_t index(int x, int y) const { return static_cast<std::size_t>(y * side_ + x); }
    std::size_t index_of(std::uint32_t i) const { return index(column(p_[i].x), row(p_[i].y)); }

    std::span<const DVec2> p_;
    std::vector<std::uint32_t>& out_;
    std::uint32_t left_; // corners in the ring
    std::vector<std::uint32_t> next_, previous_;
    std::vector<std::uint8_t> reflex_; // in the ring, and does not turn left
    std::uint64_t work_ = 0;

    int side_ = 1; // the grid has side_ x side_ cells
    DVec2 origin_{0}, per_unit_{0};
    std::vector<std::uint32_t> cell_begin_, cell_count_, cells_;
};

} // namespace

void triangulate(std::span<const DVec3> polygon, std::vector<std::uint32_t>& out) {
    const std::size_t n = polygon.size();
    if (n < 3) return;
    std::array<DVec2, 16> few; // most polygons are small: no allocation for those
    std::vector<DVec2> many(n > few.size() ? n : 0);
    const std::span<DVec2> points(n > few.size() ? many.data() : few.data(), n);
    const Projection project(newell_normal(polygon));
    for (std::size_t i = 0; i < n; ++i)
        points[i] = project(polygon[i]);

    if (n == 4 && diagonal_is_13(points)) {
        out.insert(out.end(), {1, 2, 3, 1, 3, 0});
    } else if (n <= 4 || is_strictly_convex(points)) {
        for (std::uint32_t i = 2; i < n; ++i)
            out.insert(out.end(), {0, i - 1, i});
    } else {
        EarClipper(points, out).run();
    }
}

} // namespace scanout::geom
