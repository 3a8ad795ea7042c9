// The searches against simple loops over all pairs, in plain doubles, on small random meshes.
#include "geom/diagnose/diagnose.h"
#include "geom/diagnose/meshes.h"

#include <array>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::geom::testing {
namespace {

using Triangle3 = std::array<DVec3, 3>;

DVec3 naive_cross(const DVec3& a, const DVec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double naive_dot(const DVec3& a, const DVec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
double naive_length(const DVec3& a) {
    return std::sqrt(naive_dot(a, a));
}

double naive_area(const Triangle3& t) { // twice
    return naive_length(naive_cross(t[1] - t[0], t[2] - t[0]));
}

PolygonMesh random_triangles(std::uint32_t seed, int positions, int faces, int steps) {
    std::mt19937 random(seed);
    const auto coordinate = [&] {
        const double x = static_cast<double>(random()) / 4294967296.0;
        return steps == 0 ? x : std::floor(x * (steps + 1));
    };
    PolygonMesh mesh;
    for (int i = 0; i < positions; ++i)
        mesh.positions.push_back({coordinate(), coordinate(), coordinate()});
    for (int f = 0; f < faces; ++f) {
        const auto any = [&] {
            return static_cast<std::int32_t>(random() % static_cast<unsigned>(positions));
        };
        add_face(mesh, {any(), any(), any()});
    }
    return mesh;
}

Triangle3 triangle_of(const PolygonMesh& m, std::size_t face) {
    const auto at = [&](std::size_t i) {
        return m.positions[static_cast<std::size_t>(m.corners[3 * face + i].position)];
    };
    return {at(0), at(1), at(2)};
}

using Point = std::array<double, 3>;
Point key_of(const DVec3& p) {
    return {p.x, p.y, p.z};
}

// The same three corners as an earlier face, wound alike.
bool naive_repeats(const PolygonMesh& m, std::size_t face) {
    const Triangle3 t = triangle_of(m, face);
    if (naive_area(t) == 0) return false;
    for (std::size_t g = 0; g < face; ++g) {
        const Triangle3 u = triangle_of(m, g);
        for (std::size_t s = 0; s < 3; ++s)
            if (t[0] == u[s] && t[1] == u[(s + 1) % 3] && t[2] == u[(s + 2) % 3]) return true;
    }
    return false;
}

// For each undirected edge between different places: uses in the one direction and in the other.
std::map<std::pair<Point, Point>, std::pair<int, int>> naive_edges(const PolygonMesh& m) {
    std::map<std::pair<Point, Point>, std::pair<int, int>> uses;
    for (std::size_t f = 0; f < m.faces(); ++f) {
        const Triangle3 t = triangle_of(m, f);
        if (naive_repeats(m, f) || t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            const Point a = key_of(t[i]), b = key_of(t[(i + 1) % 3]);
            if (a < b) ++uses[{a, b}].first;
            if (b < a) ++uses[{b, a}].second;
        }
    }
    return uses;
}

RC_GTEST_PROP(DiagnoseNaively, Edges, (std::uint32_t seed)) {
    // Few steps: many positions are one place.
    const PolygonMesh mesh = random_triangles(seed, 9, 1 + static_cast<int>(seed % 40), 2);
    std::size_t open = 0, many = 0, mixed = 0;
    for (const auto& [edge, uses] : naive_edges(mesh)) {
        const int all = uses.first + uses.second;
        open += all == 1 ? 1 : 0;
        many += all > 2 ? 1 : 0;
        mixed += all == 2 && uses.first != uses.second ? 1 : 0;
    }
    DiagnoseOptions how;
    how.search = false;
    const Diagnosis found = diagnose(jobs(), mesh, how);
    RC_ASSERT(found.count(Hazard::open_edges) == open);
    RC_ASSERT(found.count(Hazard::non_manifold_edges) == many);
    RC_ASSERT(found.count(Hazard::mixed_winding) == mixed);
}

RC_GTEST_PROP(DiagnoseNaively, RepeatedAndTurnedFaces, (std::uint32_t seed)) {
    const PolygonMesh mesh = random_triangles(seed, 6, 1 + static_cast<int>(seed % 60), 1);
    std::size_t repeated = 0, turned = 0;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const Triangle3 t = triangle_of(mesh, f);
        if (naive_area(t) == 0) continue;
        const bool same = naive_repeats(mesh, f);
        bool back = false;
        for (std::size_t g = 0; g < f; ++g) {
            const Triangle3 u = triangle_of(mesh, g);
            for (std::size_t s = 0; s < 3; ++s) {
                back |= t[0] == u[s] && t[2] == u[(s + 1) % 3] && t[1] == u[(s + 2) % 3];
            }
        }
        repeated += same ? 1 : 0;
        turned += back && !same ? 1 : 0;
    }
    const Diagnosis found = diagnosed(mesh);
    RC_ASSERT(found.count(Hazard::duplicate_faces) == repeated);
    RC_ASSERT(found.count(Hazard::back_to_back) == turned);
}

// The segment from p to q against a triangle: where it meets the plane, and on which side of the
// edges that is.
bool naive_hits(const DVec3& p, const DVec3& q, const Triangle3& t) {
    const DVec3 normal = naive_cross(t[1] - t[0], t[2] - t[0]);
    const double from = naive_dot(p - t[0], normal), to = naive_dot(q - t[0], normal);
    if (!(from * to < 0)) return false;
    const DVec3 hit = p + (q - p) * (from / (from - to));
    for (std::size_t i = 0; i < 3; ++i)
        if (naive_dot(naive_cross(t[(i + 1) % 3] - t[i], hit - t[i]), normal) < 0) return false;
    return true;
}

RC_GTEST_PROP(DiagnoseNaively, Intersections, (std::uint32_t seed)) {
    const PolygonMesh mesh = random_triangles(seed, 30, 1 + static_cast<int>(seed % 24), 0);
    std::size_t pairs = 0;
    for (std::size_t f = 0; f < mesh.faces(); ++f)
        for (std::size_t g = 0; g < f; ++g) {
            const Triangle3 t = triangle_of(mesh, f), u = triangle_of(mesh, g);
            if (naive_area(t) == 0 || naive_area(u) == 0) continue;
            int shared = 0;
            bool hit = false;
            for (std::size_t i = 0; i < 3; ++i) {
                shared += std::count(u.begin(), u.end(), t[i]) > 0 ? 1 : 0;
                for (std::size_t k = 0; k < 3; ++k) {
                    // An edge that ends at a corner of the other one touches it there, no more.
                    const auto apart = [](const DVec3& a, const DVec3& b, const Triangle3& other) {
                        return std::count(other.begin(), other.end(), a) +
                                   std::count(other.begin(), other.end(), b) ==
                               0;
                    };
                    const DVec3 &a = t[i], &b = t[(i + 1) % 3], &c = u[k], &d = u[(k + 1) % 3];
                    hit |= apart(a, b, u) && naive_hits(a, b, u);
                    hit |= apart(c, d, t) && naive_hits(c, d, t);
                }
            }
            pairs += hit && shared < 2 ? 1 : 0;
        }
    DiagnoseOptions how;
    how.touch = 0;
    RC_ASSERT(diagnose(jobs(), mesh, how).count(Hazard::intersections) == pairs);
}

// The area that two triangles of the plane z = 0 have in common: one clipped by the other's edges.
double naive_common_area(Triangle3 t, Triangle3 u) {
    const auto side = [](const DVec3& a, const DVec3& b, const DVec3& p) {
        return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    };
    if (side(u[0], u[1], u[2]) < 0) std::swap(u[1], u[2]);
    std::vector<DVec3> polygon(t.begin(), t.end());
    for (std::size_t i = 0; i < 3; ++i) {
        std::vector<DVec3> left;
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const DVec3 p = polygon[k], q = polygon[(k + 1) % polygon.size()];
            const double sp = side(u[i], u[(i + 1) % 3], p), sq = side(u[i], u[(i + 1) % 3], q);
            if (sp >= 0) left.push_back(p);
            if (sp * sq < 0) left.push_back(p + (q - p) * (sp / (sp - sq)));
        }
        polygon = left;
    }
    double area = 0;
    for (std::size_t k = 2; k < polygon.size(); ++k)
        area += side(polygon[0], polygon[k - 1], polygon[k]);
    return std::abs(area) / 2;
}

RC_GTEST_PROP(DiagnoseNaively, OverlapsInAPlane, (std::uint32_t seed)) {
    // Of whole numbers up to 6: no overlap is narrower than a hundredth of an edge.
    PolygonMesh mesh = random_triangles(seed, 12, 1 + static_cast<int>(seed % 14), 6);
    for (DVec3& p : mesh.positions)
        p.z = 0;
    std::size_t pairs = 0;
    for (std::size_t f = 0; f < mesh.faces(); ++f)
        for (std::size_t g = 0; g < f; ++g) {
            const Triangle3 t = triangle_of(mesh, f), u = triangle_of(mesh, g);
            if (naive_area(t) == 0 || naive_area(u) == 0) continue;
            const bool same = std::is_permutation(t.begin(), t.end(), u.begin());
            pairs += !same && naive_common_area(t, u) > 1e-9 ? 1 : 0;
        }
    RC_ASSERT(diagnosed(mesh).count(Hazard::overlaps) == pairs);
}

// For each edge between different places: its faces, of a face and its turned twin the first.
std::map<std::pair<Point, Point>, std::set<std::size_t>> naive_sheets(const PolygonMesh& m) {
    std::map<std::pair<Point, Point>, std::set<std::size_t>> sheets;
    for (std::size_t f = 0; f < m.faces(); ++f) {
        const Triangle3 t = triangle_of(m, f);
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
        std::size_t first = 0;
        while (first < f) {
            const Triangle3 u = triangle_of(m, first);
            if (naive_area(t) > 0 && std::is_permutation(t.begin(), t.end(), u.begin())) break;
            ++first;
        }
        for (std::size_t i = 0; i < 3; ++i)
            sheets[std::minmax(key_of(t[i]), key_of(t[(i + 1) % 3]))].insert(first);
    }
    return sheets;
}

RC_GTEST_PROP(DiagnoseNaively, TVertices, (std::uint32_t seed)) {
    // On edges of whole numbers lie many others; a tolerance that only such meet.
    const PolygonMesh mesh = random_triangles(seed, 14, 1 + static_cast<int>(seed % 9), 4);
    const auto sheets = naive_sheets(mesh);
    std::set<Point> open;
    for (const auto& [edge, faces] : sheets)
        if (faces.size() == 1) open.insert({edge.first, edge.second});
    std::size_t count = 0;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const Triangle3 t = triangle_of(mesh, f);
        if (naive_repeats(mesh, f) || t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            const DVec3 a = t[i], b = t[(i + 1) % 3];
            const auto found = sheets.find(std::minmax(key_of(a), key_of(b)));
            if (found == sheets.end() || found->second.size() != 1) continue;
            for (const Point& point : open) {
                const DVec3 p(point[0], point[1], point[2]);
                if (std::count(t.begin(), t.end(), p) > 0) continue;
                const bool between = naive_dot(p - a, b - a) > 0 && naive_dot(p - b, a - b) > 0;
                count += between && naive_length(naive_cross(p - a, b - a)) == 0 ? 1 : 0;
            }
        }
    }
    RC_ASSERT(diagnosed(mesh).count(Hazard::t_vertices) == count);
}

} // namespace
} // namespace scanout::geom::testing
