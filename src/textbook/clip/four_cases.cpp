// A triangle against a plane in four cases [Course 5.2], by the signed distances of its corners.
// The document collects corners as they come, which turns some triangles over; here the triangle is
// turned until the odd corner comes first, so that the winding stays.
#include "textbook/clip/clip.h"

#include <algorithm>

namespace scanout::textbook {

std::vector<std::array<Vertex, 3>> clip_four_cases(const std::array<Vertex, 3>& triangle,
                                                   const Plane& plane) {
    std::array<Vertex, 3> t = triangle;
    const auto inside = [&](const Vertex& v) { return plane.distance(v.clip) >= 0; };
    const auto count = std::count_if(t.begin(), t.end(), inside);
    if (count == 3) return {t};
    if (count == 0) return {};
    const bool odd_one = count == 1; // inside, alone; else it is the one outside
    std::rotate(
        t.begin(),
        std::find_if(t.begin(), t.end(), [&](const Vertex& v) { return inside(v) == odd_one; }),
        t.end());
    const auto cut = [&](const Vertex& a, const Vertex& b) {
        const double from = plane.distance(a.clip), to = plane.distance(b.clip);
        return mix(a, b, from / (from - to));
    };
    const Vertex next = cut(t[0], t[1]), last = cut(t[0], t[2]);
    if (odd_one) return {{t[0], next, last}};
    return {{next, t[1], t[2]}, {next, t[2], last}};
}

} // namespace scanout::textbook
