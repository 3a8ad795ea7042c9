#include "geom/normals.h"

#include "base/chunks.h"
#include "geom/triangulate.h"
#include "math/rotation.h"
#include "math/transcendental.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
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

// The faces, as normals need them.
class Faces {
public:
    Faces(Jobs& jobs, const PolygonMesh& polygons, const std::vector<bool>& usable)
        : m_(polygons), usable_(usable), normals_(polygons.faces()),
          block_face_(polygons.corners.size() / kBlock + 1) {
        for_chunks(jobs, m_.faces(), kFaces, [&](std::size_t begin, std::size_t end, int) {
            std::vector<DVec3> outline;
            for (std::size_t f = begin; f < end; ++f) {
                if (usable_[f]) normals_[f] = to_fixed(unit_or_zero(area_normal(f, outline)));
                const std::size_t first = (m_.face_begin[f] + kBlock - 1) / kBlock;
                for (std::size_t b = first; b * kBlock < m_.face_end(f); ++b)
                    block_face_[b] = static_cast<std::uint32_t>(f);
            }
        });
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
    static constexpr std::size_t kBlock = 8, kFaces = 4096;
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

// The corners around every position, as one array: the corners of position i begin at begin[i].
// Each thread takes a range of positions and scans all corners for them: every thread reads all
// corners once, but no memory is needed beside the result.
struct CornersAt {
    std::vector<std::uint32_t> begin, corners;

    CornersAt(Jobs& jobs, const PolygonMesh& m, const Faces& faces)
        : begin(m.positions.size() + 1, 0) {
        const std::size_t range = m.positions.size() / static_cast<std::size_t>(jobs.threads()) + 1;
        const auto each = [&](std::size_t first, std::size_t last, auto&& visit) {
            for (std::size_t f = 0; f < m.faces(); ++f)
                if (faces.usable(f))
                    for (std::size_t c = m.face_begin[f]; c < m.face_end(f); ++c) {
                        const auto position = static_cast<std::size_t>(m.corners[c].position);
                        if (position - first < last - first) visit(c, position);
                    }
        };
        std::vector<std::uint32_t> total(m.positions.size() / range + 2); // of the ranges before
        for_chunks(jobs, m.positions.size(), range, [&](std::size_t first, std::size_t last, int) {
            std::uint32_t count = 0;
            each(first, last, [&](std::size_t, std::size_t position) {
                ++begin[position];
                ++count;
            });
            total[first / range + 1] = count;
        });
        std::partial_sum(total.begin(), total.end(), total.begin());
        corners.resize(total.back());
        begin.back() = total.back();
        for_chunks(jobs, m.positions.size(), range, [&](std::size_t first, std::size_t last, int) {
            std::uint32_t sum = total[first / range];
            for (std::size_t p = first; p < last; ++p)
                begin[p] = sum += begin[p]; // the end of each, which filling moves down
            each(first, last, [&](std::size_t c, std::size_t position) {
                corners[--begin[position]] = static_cast<std::uint32_t>(c);
            });
        });
    }
    std::span<const std::uint32_t> operator[](std::size_t position) const {
        return std::span(corners).subspan(begin[position], begin[position + 1] - begin[position]);
    }
};

// The inputs of all makers of normals.
struct Surroundings {
    const Faces& faces;
    std::int64_t crease_cos; // of a product of two fixed normals
    double half_crease_cos;

    Surroundings(const Faces& all, double crease_degrees)
        : faces(all),
          // The sides of a hexagon differ by 60 degrees up to rounding: all are within 60.
          crease_cos(round_to_integer(cos_degrees(std::clamp(crease_degrees + 0.01, 0.0, 180.0)) *
                                      kOne * kOne)),
          half_crease_cos(cos_degrees(std::clamp(crease_degrees, 0.0, 180.0) / 2)) {}
};

// Makes the normals of some positions or faces, independently of other makers. Numbers them from 0
// until number_from() gives the number of the first.
class NormalMaker {
public:
    NormalMaker(PolygonMesh& polygons, const Surroundings& in) : m_(polygons), in_(in) {}

    void make_flat(std::size_t face) {
        const FixedNormal& n = in_.faces.normal(face);
        for (std::size_t c = m_.face_begin[face]; c < m_.face_end(face); ++c)
            set(static_cast<std::uint32_t>(c), {n.x, n.y, n.z}, n);
    }

    void make_missing(std::span<const std::uint32_t> corners) {
        const auto missing = [&](std::uint32_t c) { return m_.corners[c].normal < 0; };
        if (std::any_of(corners.begin(), corners.end(), missing)) make_at(corners);
    }

    std::span<const Vec3> made() const { return made_; }
    void number_from(std::int32_t first) const {
        for (const std::uint32_t c : set_)
            m_.corners[c].normal += first;
    }
    void clear() {
        made_.clear();
        set_.clear();
        last_sum_ = {};
    }

private:
    struct Item {
        std::uint32_t group, corner;
        FixedNormal normal;
        Sum weighted;
    };
    // Faces at one position that count as one: all with the same normal, or, where a position has
    // very many faces, with nearly the same normal.
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
            const std::size_t face = in_.faces.face_of(c);
            const FixedNormal& n = in_.faces.normal(face);
            const std::uint32_t group = in_.faces.smoothing(face);
            if (group == kSmoothingOff) continue;
            const double weight = n == FixedNormal{} ? 0 : in_.faces.angle(face, c) * scale / kOne;
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

    // A sufficient test: normals within half the crease angle of their sum are within it of each
    // other.
    bool all_within_crease(std::span<const Item> group, const Sum& sum) const {
        const DVec3 axis = unit_or_zero(DVec3(sum.x, sum.y, sum.z));
        return std::all_of(group.begin(), group.end(), [&](const Item& item) {
            return item.normal == FixedNormal{} ||
                   dot3(axis, from_fixed(item.normal)) > in_.half_crease_cos;
        });
    }

    void make_by_crease(std::span<const Item> group) {
        // Pairs are compared; where there would be too many, directions are first rounded to a grid
        // of a few degrees, which bounds their number.
        const bool coarse = group.size() > kMaxPairwise;
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
                    if (dot(d.normal, own) >= in_.crease_cos || own == FixedNormal{})
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
            made_.emplace_back(n);
            last_sum_ = sum;
        }
        index = static_cast<std::int32_t>(made_.size() - 1);
        set_.push_back(corner);
    }

    static constexpr std::size_t kMaxPairwise = 256;

    PolygonMesh& m_;
    const Surroundings& in_;
    std::vector<Vec3> made_;
    std::vector<std::uint32_t> set_; // the corners that have them
    std::vector<Item> items_, sorted_;
    std::vector<Direction> directions_;
    Sum last_sum_; // the sum of the last entry of the normals
};

// Calls make(maker, i) for every i of [0, count), in chunks on all cores, and appends the makers'
// normals in order. Works in waves, so that the makers hold few normals at a time.
template <class Make>
bool make_in_order(Jobs& jobs, PolygonMesh& m, const Surroundings& in, std::size_t count,
                   Make&& make, const std::function<bool(double)>& go_on) {
    constexpr std::size_t kChunk = 512, kWave = 32 * kChunk;
    std::vector<NormalMaker> makers(std::min(kWave / kChunk, count / kChunk + 1),
                                    NormalMaker(m, in));
    std::vector<std::size_t> begin(makers.size() + 1);
    for (std::size_t wave = 0; wave < count; wave += kWave) {
        if (go_on && !go_on(static_cast<double>(wave) / static_cast<double>(count))) return false;
        const std::size_t length = std::min(kWave, count - wave);
        for_chunks(jobs, length, kChunk, [&](std::size_t first, std::size_t last, int) {
            NormalMaker& maker = makers[first / kChunk];
            maker.clear();
            for (std::size_t i = first; i < last; ++i)
                make(maker, wave + i);
            begin[first / kChunk + 1] = maker.made().size();
        });
        begin[0] = m.normals.size();
        const std::size_t used = (length + kChunk - 1) / kChunk;
        for (std::size_t i = 0; i < used; ++i)
            begin[i + 1] += begin[i];
        m.normals.resize(begin[used]);
        for_chunks(jobs, used, 1, [&](std::size_t i, std::size_t, int) {
            const std::span<const Vec3> made = makers[i].made();
            std::copy(made.begin(), made.end(),
                      m.normals.begin() + static_cast<std::ptrdiff_t>(begin[i]));
            makers[i].number_from(static_cast<std::int32_t>(begin[i]));
        });
    }
    return true;
}

// Returns true when a corner is without a normal. Makes the file's normals unit vectors; a corner
// with a zero or non-finite one counts as without.
bool take_normals_of_file(Jobs& jobs, PolygonMesh& m) {
    constexpr std::size_t kChunk = 16384;
    for_chunks(jobs, m.normals.size(), kChunk, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i)
            m.normals[i] = Vec3(unit_or_zero(DVec3(m.normals[i])));
    });
    std::vector<std::uint8_t> missing(m.corners.size() / kChunk + 1, 0);
    for_chunks(jobs, m.corners.size(), kChunk, [&](std::size_t begin, std::size_t end, int) {
        bool some = false;
        for (std::size_t c = begin; c < end; ++c) {
            std::int32_t& normal = m.corners[c].normal;
            if (normal >= 0 && m.normals[static_cast<std::size_t>(normal)] == Vec3(0)) normal = -1;
            some |= normal < 0;
        }
        missing[begin / kChunk] = some ? 1 : 0;
    });
    return std::find(missing.begin(), missing.end(), 1) != missing.end();
}

} // namespace

bool make_normals(Jobs& jobs, PolygonMesh& m, const std::vector<bool>& usable,
                  double crease_degrees, const std::function<bool(double)>& go_on) {
    if (!take_normals_of_file(jobs, m)) return true;
    const Faces faces(jobs, m, usable);
    const Surroundings in(faces, crease_degrees);
    m.normals.reserve(m.normals.size() + m.positions.size());
    if (!m.face_smoothing.empty())
        make_in_order(
            jobs, m, in, m.faces(),
            [&](NormalMaker& maker, std::size_t face) {
                if (usable[face] && faces.smoothing(face) == kSmoothingOff) maker.make_flat(face);
            },
            nullptr);
    const CornersAt at(jobs, m, faces);
    return make_in_order(
        jobs, m, in, m.positions.size(),
        [&](NormalMaker& maker, std::size_t position) { maker.make_missing(at[position]); }, go_on);
}

} // namespace scanout::geom
