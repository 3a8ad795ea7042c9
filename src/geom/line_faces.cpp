#include "geom/line_faces.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <tuple>
#include <utility>

namespace scanout::geom {
namespace {

constexpr std::uint32_t kNowhere = 0xffffffff;

bool before(const Vec3& a, const Vec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

template <class T, class Less = std::less<>>
void sort_unique(std::vector<T>& v, Less less = {}) {
    std::sort(v.begin(), v.end(), less);
    const auto same = [&](const T& a, const T& b) { return !less(a, b) && !less(b, a); };
    v.erase(std::unique(v.begin(), v.end(), same), v.end());
}

// For every vertex, the number of its position among the ends of lines.
std::vector<std::uint32_t> places_of(const Mesh& mesh) {
    std::vector<Vec3> place;
    place.reserve(mesh.line_index.size());
    for (const std::uint32_t v : mesh.line_index)
        place.push_back(mesh.position[v]);
    sort_unique(place, before);
    std::vector<std::uint32_t> out;
    out.reserve(mesh.position.size());
    for (const Vec3& p : mesh.position) {
        const auto at = std::lower_bound(place.begin(), place.end(), p, before);
        const bool found = at != place.end() && !before(p, *at);
        out.push_back(found ? static_cast<std::uint32_t>(at - place.begin()) : kNowhere);
    }
    return out;
}

using Pair = std::pair<std::uint32_t, std::uint32_t>; // places, the lower first

// Calls found(i) for every pairs[i] whose places are both in `corner` (sorted). Loops over a
// corner's lines or over the face's corners, whichever are fewer.
template <class F>
void for_pairs_in(const std::vector<Pair>& pairs, const std::vector<std::uint32_t>& first,
                  const std::vector<std::uint32_t>& corner, F&& found) {
    for (const std::uint32_t a : corner) {
        const std::size_t begin = first[a], end = first[a + 1];
        if (end - begin <= corner.size()) {
            for (std::size_t i = begin; i < end; ++i)
                if (std::binary_search(corner.begin(), corner.end(), pairs[i].second)) found(i);
            continue;
        }
        const auto from = pairs.begin() + static_cast<std::ptrdiff_t>(begin),
                   to = pairs.begin() + static_cast<std::ptrdiff_t>(end);
        for (const std::uint32_t b : corner) {
            const auto at = std::lower_bound(from, to, Pair{a, b});
            if (at != to && at->second == b) found(static_cast<std::size_t>(at - pairs.begin()));
        }
    }
}

struct Hit {
    std::uint32_t pair, triangle; // the first of the face
};

// Returns the hits in the order of faces.
std::vector<Hit> hits_of(const Mesh& mesh, const std::vector<std::uint32_t>& place,
                         const std::vector<Pair>& pairs) {
    std::vector<std::uint32_t> first(mesh.line_index.size() + 1); // of a place
    for (std::size_t p = 0, i = 0; p < first.size(); ++p) {
        while (i < pairs.size() && pairs[i].first < p)
            ++i;
        first[p] = static_cast<std::uint32_t>(i);
    }
    std::vector<Hit> out;
    std::vector<std::uint32_t> corner;
    for (std::size_t t = 0; t < mesh.triangles();) {
        const auto first_of_face = static_cast<std::uint32_t>(t);
        corner.clear();
        for (; t < mesh.triangles() && mesh.face[t] == mesh.face[first_of_face]; ++t)
            for (std::size_t k = t * 3; k < t * 3 + 3; ++k)
                if (place[mesh.index[k]] != kNowhere) corner.push_back(place[mesh.index[k]]);
        sort_unique(corner);
        for_pairs_in(pairs, first, corner, [&](std::size_t pair) {
            out.push_back({static_cast<std::uint32_t>(pair), first_of_face});
        });
    }
    return out;
}

} // namespace

void find_line_faces(Mesh& mesh) {
    mesh.line_faces = {};
    if (mesh.lines() == 0 || mesh.triangles() == 0) return;
    const std::vector<std::uint32_t> place = places_of(mesh);
    const auto pair_of = [&](std::size_t line) {
        const auto [a, b] =
            std::minmax(place[mesh.line_index[line * 2]], place[mesh.line_index[line * 2 + 1]]);
        return Pair{a, b};
    };
    std::vector<Pair> pairs;
    pairs.reserve(mesh.lines());
    for (std::size_t line = 0; line < mesh.lines(); ++line)
        pairs.push_back(pair_of(line));
    sort_unique(pairs);
    const std::vector<Hit> hits = hits_of(mesh, place, pairs);
    if (hits.empty()) return;

    LineFaces& out = mesh.line_faces;
    for (std::size_t line = 0; line < mesh.lines(); ++line)
        out.list.push_back(static_cast<std::uint32_t>(
            std::lower_bound(pairs.begin(), pairs.end(), pair_of(line)) - pairs.begin()));
    out.begin.resize(pairs.size() + 1);
    for (const Hit& hit : hits)
        ++out.begin[hit.pair + 1];
    std::partial_sum(out.begin.begin(), out.begin.end(), out.begin.begin());
    out.triangle.resize(hits.size());
    std::vector<std::uint32_t> next(out.begin.begin(), out.begin.end() - 1);
    for (const Hit& hit : hits)
        out.triangle[next[hit.pair]++] = hit.triangle;
}

} // namespace scanout::geom
