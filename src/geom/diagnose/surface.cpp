#include "geom/diagnose/surface.h"

#include "base/chunks.h"
#include "geom/diagnose/shape.h"
#include "geom/join_table.h"
#include "geom/place.h"
#include "geom/triangulate.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace scanout::geom {
namespace {

// The positions that are used, as items of a JoinTable whose rows are the places.
struct PlaceRows {
    const std::vector<Vec3>& drawn;          // by item
    std::vector<std::uint32_t>& first_items; // of each row

    std::uint64_t hash(std::size_t item) const { return hash_of_place(drawn[item]); }
    std::uint64_t hash_of_row(std::uint32_t row) const { return hash(first_items[row]); }
    bool same(std::size_t a, std::size_t b) const { return drawn[a] == drawn[b]; }
    bool is_row(std::size_t item, std::uint32_t row) const {
        return drawn[item] == drawn[first_items[row]];
    }
    void make_room(std::size_t rows) const { first_items.resize(rows); }
    void write(std::size_t item, std::uint32_t row) const {
        first_items[row] = static_cast<std::uint32_t>(item);
    }
};

} // namespace

Surface::Surface(Jobs& jobs, const PolygonMesh& mesh, const Framing* framing)
    : jobs_(jobs), mesh_(mesh), usable_(jobs, mesh),
      framing_(framing != nullptr ? *framing : framing_of(jobs, mesh.positions, usable_.position)) {
    find_places();
    find_triangles();
    find_areas();
    same_faces_ = find_same_faces(*this);
    find_edges();
}

double Surface::unit() const {
    return std::ldexp(1.0, framing_.exponent);
}

void Surface::find_places() {
    std::vector<std::uint32_t> items;
    for (std::size_t i = 0; i < mesh_.positions.size(); ++i)
        if (usable_.position[i] != 0) items.push_back(static_cast<std::uint32_t>(i));
    std::vector<Vec3> drawn(items.size());
    for_chunks(jobs_, items.size(), 16384, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i)
            drawn[i] = place_as_drawn(framing_.normalise(mesh_.positions[items[i]]));
    });
    JoinTable table(jobs_, items.size());
    const auto rows = table.join(items.size(), PlaceRows{drawn, position_});
    for (std::uint32_t& position : position_)
        position = items[position];
    place_.assign(mesh_.positions.size(), kNoPlace);
    for (std::size_t i = 0; i < items.size(); ++i)
        place_[items[i]] = rows[i];
    at_.resize(position_.size());
    for (std::size_t i = 0; i < at_.size(); ++i) {
        const DVec3& p = mesh_.positions[position_[i]];
        at_[i] = {std::ldexp(p.x, -framing_.exponent), std::ldexp(p.y, -framing_.exponent),
                  std::ldexp(p.z, -framing_.exponent)};
    }
}

void Surface::find_triangles() {
    triangles_.reserve(usable_.all.triangles);
    std::vector<DVec3> outline;
    std::vector<std::uint32_t> cut;
    for (std::size_t f = 0; f < mesh_.faces(); ++f) {
        if (!usable_.face[f]) continue;
        const std::size_t begin = mesh_.face_begin[f], end = mesh_.face_end(f);
        cut.assign({0, 1, 2});
        if (end - begin > 3) {
            outline.clear();
            cut.clear();
            for (std::size_t c = begin; c < end; ++c)
                outline.push_back(at_[corner_place(c)]);
            triangulate(outline, cut);
        }
        for (std::size_t i = 0; i < cut.size(); i += 3)
            triangles_.push_back({{corner_place(begin + cut[i]), corner_place(begin + cut[i + 1]),
                                   corner_place(begin + cut[i + 2])},
                                  static_cast<std::uint32_t>(f)});
    }
}

void Surface::find_areas() {
    has_area_.assign(mesh_.faces(), false);
    for (const Triangle& t : triangles_)
        if (!has_no_area(*this, t.place)) has_area_[t.face] = true;
}

// A radix sort by the lower place, then each run by the higher one: half the time of std::sort.
void Surface::find_edges() {
    std::vector<EdgeUse> uses;
    uses.reserve(usable_.all.corners);
    std::vector<std::size_t> begin(places() + 1, 0);
    auto same = same_faces_.begin();
    for (std::size_t f = 0; f < mesh_.faces(); ++f) {
        const bool repeats = same != same_faces_.end() && same->face == f && !same->turned;
        if (same != same_faces_.end() && same->face == f) ++same;
        if (!usable_.face[f] || repeats || stands_on_two_places(f)) continue;
        for (std::size_t c = mesh_.face_begin[f]; c < mesh_.face_end(f); ++c) {
            const std::uint32_t a = corner_place(c), b = corner_place(next_corner(f, c));
            if (a == b) continue;
            uses.push_back({std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(c),
                            static_cast<std::uint32_t>(f), a < b});
            ++begin[std::min(a, b) + 1];
        }
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    edges_.resize(uses.size());
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for (const EdgeUse& use : uses)
        edges_[next[use.low]++] = use;
    for_chunks(jobs_, places(), 4096, [&](std::size_t first, std::size_t last, int) {
        for (std::size_t p = first; p < last; ++p)
            std::stable_sort(edges_.begin() + static_cast<std::ptrdiff_t>(begin[p]),
                             edges_.begin() + static_cast<std::ptrdiff_t>(begin[p + 1]),
                             [](const EdgeUse& a, const EdgeUse& b) { return a.high < b.high; });
    });
}

bool Surface::stands_on_two_places(std::size_t face) const {
    return !has_area_[face] && geom::stands_on_two_places(mesh_, face, [this](std::size_t corner) {
        return corner_place(corner);
    });
}

bool Surface::has_corner_at(std::size_t face, std::uint32_t place) const {
    for (std::size_t c = mesh_.face_begin[face]; c < mesh_.face_end(face); ++c)
        if (corner_place(c) == place) return true;
    return false;
}

DVec3 Surface::normal(std::size_t face) const {
    const std::size_t begin = mesh_.face_begin[face], end = mesh_.face_end(face);
    const DVec3 origin = at_[corner_place(begin)];
    DVec3 sum(0);
    for (std::size_t c = begin + 1; c + 1 < end; ++c)
        sum += cross3(at_[corner_place(c)] - origin, at_[corner_place(c + 1)] - origin);
    return sum;
}

} // namespace scanout::geom
