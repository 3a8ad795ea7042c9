#include "geom/topology.h"

#include "geom/disjoint_sets.h"
#include "math/rotation.h"
#include "math/transcendental.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>

namespace scanout::geom {
namespace {

// A number for a place: equal places have equal ones, whatever vertices stand there. Steele, Lea
// and Flood 2014 (SplitMix64).
std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31);
}
// What a CAD program writes of one corner is 0 in one triangle and 2e-18 in the next.
std::uint64_t number_of(const Vec3& p) {
    const auto whole = [](float x) {
        return static_cast<std::uint64_t>(
            static_cast<std::int64_t>(std::floor(double{x} * 0x1p22 + 0.5)));
    };
    return mixed(mixed(mixed(whole(p.x)) + whole(p.y)) + whole(p.z));
}

// Counts for an edge in one direction and against it in the other. A sum of 0 over all edges by
// chance has the probability 2^-64; no picture depends on it.
std::uint64_t edge(std::uint64_t from, std::uint64_t to) {
    if (from == to) return 0;
    const std::uint64_t both = mixed(from + to) ^ (from ^ to);
    return from < to ? both : 0 - both;
}

constexpr double kOpposite = -0.99; // cosine

// Joins vertices at one place: the first there is found again by its number. Returns the places
// where some have normals that are opposite but for 8 degrees.
std::vector<std::uint64_t> join_places(DisjointSets& components,
                                       const std::vector<std::uint64_t>& number,
                                       const std::vector<Vec3>& normal) {
    constexpr std::uint32_t kFree = ~std::uint32_t{0};
    std::vector<std::uint32_t> table(std::bit_ceil(2 * number.size() + 1), kFree);
    std::vector<std::uint64_t> opposite;
    for (std::uint32_t v = 0; v < number.size(); ++v) {
        std::size_t at = number[v] & (table.size() - 1);
        while (table[at] != kFree && number[table[at]] != number[v])
            at = (at + 1) & (table.size() - 1);
        if (table[at] == kFree) {
            table[at] = v;
            continue;
        }
        components.join(table[at], v);
        if (dot3(DVec3(normal[v]), DVec3(normal[table[at]])) < kOpposite)
            opposite.push_back(number[v]);
    }
    std::sort(opposite.begin(), opposite.end());
    return opposite;
}

constexpr double kFlat = 0x1p-20; // so far off is still in the plane

struct Triangle {
    const Vec3 &a, &b, &c;
    DVec3 ab, ac, n; // edges and their product

    Triangle(const Mesh& mesh, const std::uint32_t* v)
        : a(mesh.position[v[0]]), b(mesh.position[v[1]]), c(mesh.position[v[2]]),
          ab(DVec3(b) - DVec3(a)), ac(DVec3(c) - DVec3(a)), n(cross3(ab, ac)) {}

    // Does the steepest normal not clearly point to the front? With room for the rounding of
    // floats, and of the face's own normal where it is a sliver.
    bool is_reversed(const Mesh& mesh, const std::uint32_t* v) const {
        const double room = dot3(n, n) * 0x1p-24 + dot3(ab, ab) * dot3(ac, ac) * 0x1p-80;
        const auto lean = [&](int k) { return dot3(DVec3(mesh.normal[v[k]]), n); };
        const auto [least, most] = std::minmax({lean(0), lean(1), lean(2)});
        return !(most + least > 0 && (most + least) * (most + least) > room);
    }
    // Is a vertex' normal another than the face's own, but for rounding?
    bool is_smooth(const Mesh& mesh, const std::uint32_t* v) const {
        constexpr double kStraight = 0x1p-16; // sine: lights no face from behind by a code
        const auto bends = [&](const DVec3& normal) {
            const DVec3 across = cross3(normal, n);
            return dot3(normal, n) <= 0 ||
                   dot3(across, across) > kStraight * kStraight * dot3(normal, normal) * dot3(n, n);
        };
        return dot3(n, n) > 0 &&
               (bends(DVec3(mesh.normal[v[0]])) || bends(DVec3(mesh.normal[v[1]])) ||
                bends(DVec3(mesh.normal[v[2]])));
    }
};

void include(Box& box, const DVec3& low, const DVec3& high) {
    for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] = std::min(box.low[axis], low[axis]);
        box.high[axis] = std::max(box.high[axis], high[axis]);
    }
}

// By component: at the vertex that is its root.
struct Component {
    static constexpr std::uint32_t kNone = ~std::uint32_t{0};
    std::uint64_t open = 0; // sum of its edges; 0: closed
    std::uint32_t solid = kNone;
};

// A closed component. The volume is six times its own, seen from one of its corners; more than
// rounding.
struct Solid {
    DVec3 corner;
    double volume = 0, terms = 0;
    std::size_t triangles = 0;
    void add(const Triangle& t) {
        const double term = dot3(DVec3(t.a) - corner, t.n);
        volume += term;
        terms += std::abs(term);
        ++triangles;
    }
    bool outward() const { return volume > terms * 0x1p-40; }
};

// Where the components are: the planes of open ones, the boxes of closed ones. Returns these.
std::vector<Solid> locate(MeshTopology& result, const Mesh& mesh, DisjointSets& components,
                          std::vector<Component>& of) {
    std::vector<Solid> solids;
    for (std::size_t i = 0; i + 2 < mesh.index.size(); i += 3) {
        const std::uint32_t* v = &mesh.index[i];
        const Triangle t(mesh, v);
        Component& component = of[components.root(v[0])];
        if (component.open != 0) {
            ++result.open_triangles;
            result.open_planes.add(DVec3(t.a), DVec3(t.b), DVec3(t.c));
            continue;
        }
        if (component.solid == Component::kNone) {
            component.solid = static_cast<std::uint32_t>(solids.size());
            solids.push_back({DVec3(t.a)});
            if (result.closed_boxes.size() < MeshTopology::kMaxBoxes)
                result.closed_boxes.push_back({DVec3(t.a), DVec3(t.a)});
        }
        solids[component.solid].add(t);
        Box& box =
            result
                .closed_boxes[std::min<std::size_t>(component.solid, MeshTopology::kMaxBoxes - 1)];
        for (const Vec3* corner : {&t.a, &t.b, &t.c})
            include(box, DVec3(*corner), DVec3(*corner));
    }
    for (const Solid& solid : solids)
        result.inside_out += solid.outward() ? 0 : solid.triangles;
    result.closed = result.open_triangles == 0 && !mesh.index.empty();
    return solids;
}

// A face at one of its edges.
struct FaceEdge {
    std::uint64_t low, high; // ends
    bool rises;
    DVec3 normal;
};

bool are_opposite(const FaceEdge& a, const FaceEdge& b) {
    return a.rises != b.rises && dot3(a.normal, b.normal) < kOpposite;
}

// Of many faces at one edge: are two of them opposite? Their normals stand about the edge, in a
// circle; so each is compared with those alone that stand nearest to its opposite.
bool some_are_opposite(std::span<const FaceEdge> faces) {
    DVec3 x(0), y(0);
    for (const FaceEdge& face : faces)
        if (x == DVec3(0)) x = face.normal;
    for (const FaceEdge& face : faces)
        if (const DVec3 across = face.normal - x * dot3(face.normal, x);
            dot3(across, across) > dot3(y, y))
            y = across;
    y = normalized(y, DVec3(0));
    constexpr double kTurn = 6.283185307179586;
    using Placed = std::pair<double, const FaceEdge*>; // by angle
    std::vector<Placed> rising, falling;
    for (const FaceEdge& face : faces) {
        if (face.normal == DVec3(0)) continue;
        const double angle = scanout::atan2(dot3(face.normal, y), dot3(face.normal, x));
        (face.rises ? rising : falling).emplace_back(angle, &face);
    }
    const auto by_angle = [](const Placed& a, const Placed& b) { return a.first < b.first; };
    std::sort(falling.begin(), falling.end(), by_angle);
    return !falling.empty() && std::any_of(rising.begin(), rising.end(), [&](const Placed& face) {
        const double opposite = face.first + (face.first > 0 ? -kTurn / 2 : kTurn / 2);
        const auto next =
            std::lower_bound(falling.begin(), falling.end(), Placed(opposite, nullptr), by_angle);
        const Placed& above = next == falling.end() ? falling.front() : *next;
        const Placed& below = next == falling.begin() ? falling.back() : *(next - 1);
        return are_opposite(*face.second, *above.second) ||
               are_opposite(*face.second, *below.second);
    });
}

// Does a face lie on the back of another? Then they share an edge that ends at one of the places,
// run along it in opposite directions, and look in opposite ones.
bool lie_back_to_back(const Mesh& mesh, const std::vector<std::uint64_t>& number,
                      const std::vector<std::uint64_t>& places) {
    std::vector<FaceEdge> edges;
    const auto listed = [&](std::uint64_t place) {
        return std::binary_search(places.begin(), places.end(), place);
    };
    for (std::size_t i = 0; i + 2 < mesh.index.size() && !places.empty(); i += 3) {
        const std::uint32_t* v = &mesh.index[i];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint64_t from = number[v[k]], to = number[v[(k + 1) % 3]];
            if (from != to && (listed(from) || listed(to)))
                edges.push_back({std::min(from, to), std::max(from, to), from < to,
                                 normalized(Triangle(mesh, v).n, DVec3(0))});
        }
    }
    const auto before = [](const FaceEdge& a, const FaceEdge& b) {
        return std::tie(a.low, a.high) < std::tie(b.low, b.high);
    };
    std::sort(edges.begin(), edges.end(), before);
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        while (end < edges.size() && !before(edges[begin], edges[end]))
            ++end;
        if (some_are_opposite(std::span(edges).subspan(begin, end - begin))) return true;
    }
    return false;
}

bool is_flat(const std::vector<Plane>& planes) {
    return planes.size() == 1 ||
           (planes.size() == 2 && dot3(planes[0].normal, planes[1].normal) < -1 + kFlat * kFlat &&
            std::abs(planes[0].offset + planes[1].offset) < kFlat);
}

// MeshTopology::convex_components.
std::vector<Box> convex_components(const Mesh& mesh, DisjointSets& components,
                                   const std::vector<Component>& of,
                                   const std::vector<Solid>& solids) {
    struct Convex {
        std::uint32_t root;
        PlaneSet planes;
        Box box;
    };
    // Every vertex is compared with every plane.
    constexpr std::size_t kFewTriangles = 4096, kManyPlanes = 1024;
    const std::size_t most = mesh.triangles() <= kFewTriangles ? kManyPlanes : PlaneSet::kMaxPlanes;
    std::vector<Convex> found;
    const auto find = [&](std::uint32_t vertex) {
        const std::uint32_t root = components.root(vertex);
        return std::find_if(found.begin(), found.end(),
                            [&](const Convex& convex) { return convex.root == root; });
    };
    for (std::size_t i = 0; i + 2 < mesh.index.size(); i += 3) {
        const std::uint32_t* v = &mesh.index[i];
        const Triangle t(mesh, v);
        if (dot3(t.n, t.n) == 0) continue; // covers nothing
        auto convex = find(v[0]);
        if (convex == found.end()) {
            if (found.size() == MeshTopology::kMaxConvex) return {};
            convex = found.insert(
                convex, {components.root(v[0]), PlaneSet(most), {DVec3(t.a), DVec3(t.a)}});
        }
        convex->planes.add(DVec3(t.a), DVec3(t.b), DVec3(t.c));
        if (convex->planes.too_many()) return {};
        for (const Vec3* corner : {&t.a, &t.b, &t.c})
            include(convex->box, DVec3(*corner), DVec3(*corner));
    }
    const auto outward = [&](const Convex& convex) {
        const Component& component = of[convex.root];
        return component.open == 0 && solids[component.solid].outward();
    };
    if (!std::all_of(found.begin(), found.end(), [&](const Convex& convex) {
            return is_flat(convex.planes.planes()) || outward(convex);
        }))
        return {};
    const auto rises = [&](std::uint32_t v) {
        const auto convex = find(v);
        if (convex == found.end()) return false;
        const auto& planes = convex->planes.planes();
        const DVec4 at(DVec3(mesh.position[v]), 1);
        return !is_flat(planes) &&
               std::any_of(planes.begin(), planes.end(),
                           [&](const Plane& plane) { return height(at, plane) > kFlat; });
    };
    if (std::any_of(mesh.index.begin(), mesh.index.end(), rises)) return {};
    std::vector<Box> boxes;
    for (const Convex& convex : found)
        boxes.push_back(convex.box);
    return boxes;
}

} // namespace

bool is_collapsed(const Mesh& mesh, std::size_t triangle) {
    const std::uint32_t* v = &mesh.index[triangle * 3];
    const Vec3 &a = mesh.position[v[0]], &b = mesh.position[v[1]], &c = mesh.position[v[2]];
    return a == b || b == c || c == a;
}

MeshTopology topology(const Mesh& mesh, const std::vector<bool>& lets_through) {
    std::vector<std::uint64_t> number(mesh.position.size());
    for (std::size_t i = 0; i < number.size(); ++i)
        number[i] = number_of(mesh.position[i]);
    DisjointSets components(number.size());
    MeshTopology result;
    result.back_to_back =
        lie_back_to_back(mesh, number, join_places(components, number, mesh.normal));
    PlaneSet planes;
    for (std::size_t i = 0; i + 2 < mesh.index.size(); i += 3) {
        const std::uint32_t* v = &mesh.index[i];
        components.join(v[0], v[1]);
        components.join(v[0], v[2]);
        const Triangle t(mesh, v);
        result.reversed_triangles += t.is_reversed(mesh, v) && !is_collapsed(mesh, i / 3) ? 1 : 0;
        planes.add(DVec3(t.a), DVec3(t.b), DVec3(t.c));
    }
    std::vector<Component> of(number.size());
    for (std::size_t i = 0; i + 2 < mesh.index.size(); i += 3) {
        const std::uint32_t* v = &mesh.index[i];
        of[components.root(v[0])].open += edge(number[v[0]], number[v[1]]) +
                                          edge(number[v[1]], number[v[2]]) +
                                          edge(number[v[2]], number[v[0]]);
    }
    for (std::size_t t = 0; t < lets_through.size(); ++t)
        if (lets_through[t]) of[components.root(mesh.index[3 * t])].open = 1;
    const std::vector<Solid> solids = locate(result, mesh, components, of);
    result.flat = is_flat(planes.planes());
    result.convex_components = convex_components(mesh, components, of, solids);
    if (!result.flat && result.convex_components.empty()) return result;
    for (std::size_t i = 0; i + 2 < mesh.index.size(); i += 3) {
        const std::uint32_t* v = &mesh.index[i];
        result.smooth_triangles += Triangle(mesh, v).is_smooth(mesh, v) ? 1 : 0;
    }
    return result;
}

} // namespace scanout::geom
