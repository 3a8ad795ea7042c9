#include "geom/normals.h"

#include "geom/triangulate.h"
#include "math/rotation.h"
#include "math/transcendental.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>

namespace scanout::geom {
namespace {

constexpr double kOne = 1 << 30; // a unit normal's length in fixed point

// A face's unit normal; zero for a degenerate face. 12 bytes, and dot products are exact.
struct FixedNormal {
    std::int32_t x = 0, y = 0, z = 0;
    bool operator==(const FixedNormal&) const = default;
};

std::int64_t dot(const FixedNormal& a, const FixedNormal& b) {
    return std::int64_t{a.x} * b.x + std::int64_t{a.y} * b.y + std::int64_t{a.z} * b.z;
}

// A sum of weighted normals: integers, so any order of summands gives the same.
struct Sum {
    std::int64_t x = 0, y = 0, z = 0;
    bool operator==(const Sum&) const = default;
    bool zero() const { return x == 0 && y == 0 && z == 0; }
    Sum& operator+=(const Sum& b) {
        x += b.x, y += b.y, z += b.z;
        return *this;
    }
};

// Half away from zero, so that a mirrored mesh has mirrored normals.
std::int64_t round_to_integer(double x) {
    return static_cast<std::int64_t>(x + (x < 0 ? -0.5 : 0.5));
}

DVec3 unit_or_zero(const DVec3& v) {
    return normalized(v, DVec3(0));
}

FixedNormal to_fixed(const DVec3& unit) {
    const auto fixed = [](double x) {
        return static_cast<std::int32_t>(round_to_integer(x * kOne));
    };
    return {fixed(unit.x), fixed(unit.y), fixed(unit.z)};
}

DVec3 from_fixed(const FixedNormal& n) {
    return DVec3(n.x, n.y, n.z) / kOne;
}

// Twice the triangle's area vector, from the two shorter edges: the long ones of a needle are
// nearly parallel, and their cross product would lose all digits (Kahan, "Miscalculating Area and
// Angles of a Needle-like Triangle").
DVec3 triangle_normal(const DVec3& a, const DVec3& b, const DVec3& c) {
    const DVec3 ab = b - a, bc = c - b, ca = a - c;
    const double ab2 = dot3(ab, ab), bc2 = dot3(bc, bc), ca2 = dot3(ca, ca);
    if (ab2 >= bc2 && ab2 >= ca2) return cross3(bc, ca);
    return bc2 >= ca2 ? cross3(ca, ab) : cross3(ab, bc);
}

// The faces as normals see them.
class Faces {
public:
    Faces(const PolygonMesh& polygons, const std::vector<bool>& usable)
        : m_(polygons), usable_(usable), normals_(polygons.faces()) {
        std::vector<DVec3> outline;
        for (std::size_t f = 0; f < m_.faces(); ++f)
            if (usable_[f]) normals_[f] = to_fixed(unit_or_zero(area_normal(f, outline)));
        block_face_.reserve(m_.corners.size() / kBlock + 1);
        for (std::size_t f = 0, c = 0; c < m_.corners.size(); c += kBlock) {
            while (c >= m_.face_end(f))
                ++f;
            block_face_.push_back(static_cast<std::uint32_t>(f));
        }
    }

    const FixedNormal& normal(std::size_t face) const { return normals_[face]; }
    std::uint32_t smoothing(std::size_t face) const {
        return m_.face_smoothing.empty() ? kSmoothingUnset : m_.face_smoothing[face];
    }
    bool usable(std::size_t face) const { return usable_[face]; }

    // The face that a corner belongs to: a table entry for every few corners, then a few steps.
    std::size_t face_of(std::size_t corner) const {
        std::size_t face = block_face_[corner / kBlock];
        while (corner >= m_.face_end(face))
            ++face;
        return face;
    }

    // The inner angle at a corner, radians. Of corners on the same place in a row the first one
    // carries the angle, the others have 0.
    double angle(std::size_t face, std::size_t corner) const {
        const std::size_t begin = m_.face_begin[face], end = m_.face_end(face);
        const auto after = [&](std::size_t c) { return c + 1 < end ? c + 1 : begin; };
        const DVec3& p = at(corner);
        const DVec3 &before = at(corner > begin ? corner - 1 : end - 1), back = before - p;
        if (before == p) return 0;
        if (end - begin == 3) {
            const DVec3& q = at(after(corner));
            const DVec3 area = triangle_normal(before, p, q);
            return atan2(sqrt(dot3(area, area)), dot3(q - p, back));
        }
        std::size_t next = after(corner);
        while (at(next) == p)
            next = after(next);
        const DVec3 forth = at(next) - p;
        const DVec3 turn = cross3(forth, back);
        const double angle = atan2(sqrt(dot3(turn, turn)), dot3(forth, back));
        return dot3(turn, from_fixed(normals_[face])) < 0 ? 2 * kPi - angle : angle;
    }

private:
    static constexpr std::size_t kBlock = 8;
    static constexpr double kPi = 3.14159265358979323846;

    const DVec3& at(std::size_t corner) const {
        return m_.positions[static_cast<std::size_t>(m_.corners[corner].position)];
    }

    DVec3 area_normal(std::size_t face, std::vector<DVec3>& outline) const {
        const std::size_t begin = m_.face_begin[face], end = m_.face_end(face);
        if (end - begin == 3) return triangle_normal(at(begin), at(begin + 1), at(begin + 2));
        outline.clear();
        for (std::size_t c = begin; c < end; ++c)
            outline.push_back(at(c));
        return newell_normal(outline);
    }

    const PolygonMesh& m_;
    const std::vector<bool>& usable_;
    std::vector<FixedNormal> normals_;      // one a face
    std::vector<std::uint32_t> block_face_; // the face of every kBlock-th corner
};

// The corners around every position, as one array: those of position i begin at begin[i].
struct CornersAt {
    std::vector<std::uint32_t> begin, corners;

    CornersAt(const PolygonMesh& m, const Faces& faces) : begin(m.positions.size() + 1, 0) {
        const auto each = [&](auto&& visit) {
            for (std::size_t f = 0; f < m.faces(); ++f)
                if (faces.usable(f))
                    for (std::size_t c = m.face_begin[f]; c < m.face_end(f); ++c)
                        visit(c, static_cast<std::size_t>(m.corners[c].position));
        };
        each([&](std::size_t, std::size_t position) { ++begin[position]; });
        std::uint32_t total = 0;
        for (std::uint32_t& b : begin)
            b = total += b; // the end of each, which filling moves down
        corners.resize(total);
        each([&](std::size_t c, std::size_t position) {
            corners[--begin[position]] = static_cast<std::uint32_t>(c);
        });
    }
    std::span<const std::uint32_t> operator[](std::size_t position) const {
        return std::span(corners).subspan(begin[position], begin[position + 1] - begin[position]);
    }
};

class NormalMaker {
public:
    NormalMaker(PolygonMesh& polygons, const std::vector<bool>& usable, double crease_degrees)
        : m_(polygons), faces_(polygons, usable), at_(polygons, faces_),
          // The sides of a hexagon differ by 60 degrees up to rounding: all of them are within 60.
          crease_cos_(round_to_integer(cos_degrees(std::clamp(crease_degrees + 0.01, 0.0, 180.0)) *
                                       kOne * kOne)),
          half_crease_cos_(cos_degrees(std::clamp(crease_degrees, 0.0, 180.0) / 2)) {
        m_.normals.reserve(m_.normals.size() + m_.positions.size());
    }

    void run() {
        make_flat();
        for (std::size_t p = 0; p < m_.positions.size(); ++p) {
            const auto corners = at_[p];
            const auto missing = [&](std::uint32_t c) { return m_.corners[c].normal < 0; };
            if (std::any_of(corners.begin(), corners.end(), missing)) make_at(corners);
        }
    }

private:
    void make_flat() {
        for (std::size_t f = 0; f < m_.faces(); ++f) {
            if (!faces_.usable(f) || faces_.smoothing(f) != kSmoothingOff) continue;
            const Sum normal{faces_.normal(f).x, faces_.normal(f).y, faces_.normal(f).z};
            for (std::size_t c = m_.face_begin[f]; c < m_.face_end(f); ++c)
                set(static_cast<std::uint32_t>(c), normal, faces_.normal(f));
        }
    }

    struct Item {
        std::uint32_t group, corner;
        FixedNormal normal;
        Sum weighted;
    };
    // Faces at one position that count as one: all with the same normal, or nearly the same normal
    // where a position has very many.
    struct Direction {
        FixedNormal normal;
        Sum weighted;
    };

    void make_at(std::span<const std::uint32_t> corners) {
        // The scale leaves room for the sum of all: 2^58 over a power of two above their number,
        // and no weighted normal is longer than 2 pi.
        const double scale =
            static_cast<double>(std::uint64_t{1} << (58 - std::bit_width(corners.size())));
        items_.clear();
        for (const std::uint32_t c : corners) {
            const std::size_t face = faces_.face_of(c);
            const FixedNormal& n = faces_.normal(face);
            const std::uint32_t group = faces_.smoothing(face);
            if (group == kSmoothingOff) continue;
            const double weight = n == FixedNormal{} ? 0 : faces_.angle(face, c) * scale / kOne;
            items_.push_back({group,
                              c,
                              n,
                              {round_to_integer(weight * n.x), round_to_integer(weight * n.y),
                               round_to_integer(weight * n.z)}});
        }
        const auto by_group = [](const Item& a, const Item& b) { return a.group < b.group; };
        if (!std::is_sorted(items_.begin(), items_.end(), by_group))
            std::sort(items_.begin(), items_.end(), by_group);
        const std::span<const Item> all(items_);
        for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
            while (end < all.size() && all[end].group == all[begin].group)
                ++end;
            make_group(all.subspan(begin, end - begin));
        }
    }

    void make_group(std::span<const Item> group) {
        Sum sum;
        for (const Item& item : group)
            sum += item.weighted;
        if (group[0].group != kSmoothingUnset || all_within_crease(group, sum))
            for (const Item& item : group)
                set(item.corner, sum, item.normal);
        else
            make_by_crease(group);
    }

    // Sufficient: all within half the crease angle of their sum are within it of each other.
    bool all_within_crease(std::span<const Item> group, const Sum& sum) const {
        const DVec3 axis = unit_or_zero(DVec3(sum.x, sum.y, sum.z));
        return std::all_of(group.begin(), group.end(), [&](const Item& item) {
            return item.normal == FixedNormal{} ||
                   dot3(axis, from_fixed(item.normal)) > half_crease_cos_;
        });
    }

    void make_by_crease(std::span<const Item> group) {
        // Pairs are compared; where there would be too many, directions are first rounded to a grid
        // of a few degrees, which bounds their number.
        const bool coarse = group.size() > kMostPairwise;
        const auto key = [&](const Item& item) {
            FixedNormal k = item.normal;
            if (coarse) k.x >>= 27, k.y >>= 27, k.z >>= 27;
            return std::array{k.x, k.y, k.z};
        };
        sorted_.assign(group.begin(), group.end());
        std::sort(sorted_.begin(), sorted_.end(),
                  [&](const Item& a, const Item& b) { return key(a) < key(b); });
        directions_.clear();
        for (std::size_t i = 0; i < sorted_.size(); ++i) {
            if (i == 0 || key(sorted_[i]) != key(sorted_[i - 1]))
                directions_.push_back({sorted_[i].normal, {}});
            directions_.back().weighted += sorted_[i].weighted;
        }
        if (coarse)
            for (Direction& d : directions_)
                d.normal = to_fixed(unit_or_zero(DVec3(d.weighted.x, d.weighted.y, d.weighted.z)));
        Sum sum;
        std::size_t direction = 0;
        for (std::size_t i = 0; i < sorted_.size(); ++i) {
            direction += i > 0 && key(sorted_[i]) != key(sorted_[i - 1]);
            if (i == 0 || key(sorted_[i]) != key(sorted_[i - 1])) {
                const FixedNormal own = directions_[direction].normal;
                sum = {};
                for (const Direction& d : directions_)
                    if (dot(d.normal, own) >= crease_cos_ || own == FixedNormal{})
                        sum += d.weighted;
            }
            set(sorted_[i].corner, sum, sorted_[i].normal);
        }
    }

    // Gives a corner without a normal the sum's direction, or the face's where the sum is zero.
    // Corners with the same sum come one after the other and share one entry.
    void set(std::uint32_t corner, const Sum& sum, const FixedNormal& face_normal) {
        std::int32_t& index = m_.corners[corner].normal;
        if (index >= 0) return;
        if (sum.zero() || sum != last_sum_) {
            DVec3 n = unit_or_zero(DVec3(sum.x, sum.y, sum.z));
            if (n == DVec3(0)) n = unit_or_zero(from_fixed(face_normal));
            if (n == DVec3(0)) n.z = 1;
            m_.normals.emplace_back(n);
            last_sum_ = sum;
        }
        index = static_cast<std::int32_t>(m_.normals.size() - 1);
    }

    static constexpr std::size_t kMostPairwise = 256;

    PolygonMesh& m_;
    Faces faces_;
    CornersAt at_;
    std::int64_t crease_cos_; // of a product of two fixed normals
    double half_crease_cos_;
    std::vector<Item> items_, sorted_;
    std::vector<Direction> directions_;
    Sum last_sum_; // what the last entry of the normals was made of
};

} // namespace

void make_normals(PolygonMesh& polygons, const std::vector<bool>& usable, double crease_degrees) {
    for (Vec3& n : polygons.normals)
        n = Vec3(unit_or_zero(DVec3(n)));
    bool missing = false;
    for (Corner& corner : polygons.corners) {
        if (corner.normal >= 0 &&
            polygons.normals[static_cast<std::size_t>(corner.normal)] == Vec3(0))
            corner.normal = -1;
        missing |= corner.normal < 0;
    }
    if (missing) NormalMaker(polygons, usable, crease_degrees).run();
}

} // namespace scanout::geom
