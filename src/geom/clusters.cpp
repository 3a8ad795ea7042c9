#include "geom/clusters.h"

#include "base/chunks.h"
#include "geom/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace scanout::geom {

namespace {

// Positions of triangles' corners, in spatial order.
struct IndexedPositions {
    std::span<const Vec3> position;
    std::span<const std::uint32_t> index;
};
DVec3 position(const IndexedPositions& all, std::size_t corner) {
    return DVec3(all.position[all.index[corner]]);
}

struct Facing {
    DVec3 normal{0}; // unit; 0 without area
    double height;   // over the longest side
};
Facing facing(const IndexedPositions& all, std::size_t triangle) {
    const DVec3 a = position(all, triangle * 3), b = position(all, triangle * 3 + 1),
                c = position(all, triangle * 3 + 2);
    const DVec3 n = cross3(b - a, c - a);
    const double area = std::sqrt(dot3(n, n));
    const double longest =
        std::sqrt(std::max({dot3(b - a, b - a), dot3(c - b, c - b), dot3(a - c, a - c)}));
    if (!(area > 0) || !(longest > 0)) return {DVec3(0), 0};
    return {n / area, area / longest};
}

Cluster bounds(const IndexedPositions& all, std::size_t begin, std::size_t end) {
    DVec3 least = position(all, begin * 3), most = least, sum(0);
    double thinnest = std::numeric_limits<double>::infinity();
    for (std::size_t corner = begin * 3; corner < end * 3; ++corner) {
        const DVec3 p = position(all, corner);
        least = glm::min(least, p);
        most = glm::max(most, p);
    }
    for (std::size_t t = begin; t < end; ++t) {
        const Facing f = facing(all, t);
        sum = sum + f.normal;
        thinnest = std::min(thinnest, f.height);
    }
    Cluster c{(least + most) * 0.5, 0, DVec3(0, 0, 1), 2, thinnest};
    double farthest = 0;
    for (std::size_t corner = begin * 3; corner < end * 3; ++corner) {
        const DVec3 d = position(all, corner) - c.centre;
        farthest = std::max(farthest, dot3(d, d));
    }
    c.radius = std::sqrt(farthest);
    const double length = std::sqrt(dot3(sum, sum));
    if (!(length > 0)) return c;
    c.axis = sum / length;
    double cosine = 1;
    for (std::size_t t = begin; t < end; ++t)
        cosine = std::min(cosine, dot3(facing(all, t).normal, c.axis));
    if (cosine > 0) c.spread = std::sqrt(std::max(1 - cosine * cosine, 0.0));
    return c;
}

Sphere sphere_of(std::span<const Cluster> clusters) {
    DVec3 least(std::numeric_limits<double>::infinity()), most = -least;
    for (const Cluster& c : clusters) {
        least = glm::min(least, c.centre - c.radius);
        most = glm::max(most, c.centre + c.radius);
    }
    Sphere sphere{(least + most) * 0.5, 0};
    for (const Cluster& c : clusters) {
        const DVec3 d = c.centre - sphere.centre;
        sphere.radius = std::max(sphere.radius, std::sqrt(dot3(d, d)) + c.radius);
    }
    sphere.radius *= 1 + 0x1p-40; // covers the rounding of the radius
    return sphere;
}

// Finds the vertex groups that some triangles use, ascending; returns how many.
constexpr std::size_t kCorners = Clusters::kTriangles * 3;
std::size_t vertex_groups_of(const IndexedPositions& all, std::size_t begin, std::size_t end,
                             std::array<std::uint32_t, kCorners>& out) {
    constexpr std::size_t kRecent = 8; // most corners' groups are among those: few are sorted
    std::size_t count = 0;
    for (std::size_t corner = begin * 3; corner < end * 3; ++corner) {
        const std::uint32_t group = all.index[corner] / std::uint32_t{Clusters::kGroupVertices};
        bool known = false;
        for (std::size_t i = count - std::min(count, kRecent); i < count; ++i)
            known |= out[i] == group;
        if (!known) out[count++] = group;
    }
    const auto first = out.begin(), last = first + static_cast<std::ptrdiff_t>(count);
    std::sort(first, last);
    return static_cast<std::size_t>(std::unique(first, last) - first);
}

} // namespace

Clusters find_clusters(Jobs& jobs, const Mesh& mesh, std::vector<std::uint32_t> order) {
    Clusters all;
    const std::size_t triangles = mesh.triangles();
    all.triangle = std::move(order);
    all.index.resize(all.triangle.size() * 3);
    all.spatial_index.resize(all.triangle.size());
    for_chunks(jobs, all.triangle.size(), 1 << 15, [&](std::size_t from, std::size_t to, int) {
        for (std::size_t i = from; i < to; ++i) {
            std::copy_n(mesh.index.data() + std::size_t{all.triangle[i]} * 3, 3,
                        all.index.data() + i * 3);
            all.spatial_index[all.triangle[i]] = static_cast<std::uint32_t>(i);
        }
    });
    const IndexedPositions vertices{mesh.position, all.index.empty() ? mesh.index : all.index};
    const std::size_t clusters = (triangles + Clusters::kTriangles - 1) / Clusters::kTriangles;
    if (clusters == 0) return all;
    all.cluster.resize(clusters);
    all.begin.assign(clusters + 1, 0);
    // work(number, its first triangle, the one after its last, room)
    const auto for_all = [&](auto work) {
        for_chunks(jobs, clusters, 256, [&](std::size_t from, std::size_t to, int) {
            std::array<std::uint32_t, kCorners> scratch;
            for (std::size_t c = from; c < to; ++c)
                work(c, c * Clusters::kTriangles,
                     std::min((c + 1) * Clusters::kTriangles, triangles), scratch);
        });
    };
    for_all([&](std::size_t c, std::size_t begin, std::size_t end, auto& scratch) {
        all.cluster[c] = bounds(vertices, begin, end);
        all.begin[c + 1] =
            static_cast<std::uint32_t>(vertex_groups_of(vertices, begin, end, scratch));
    });
    for (std::size_t c = 0; c < clusters; c += Clusters::kGroup)
        all.group.push_back(
            sphere_of(std::span(all.cluster).subspan(c, std::min(Clusters::kGroup, clusters - c))));
    std::partial_sum(all.begin.begin(), all.begin.end(), all.begin.begin());
    all.vertex_groups.resize(all.begin.back());
    for_all([&](std::size_t c, std::size_t begin, std::size_t end, auto& scratch) {
        std::copy_n(scratch.begin(), vertex_groups_of(vertices, begin, end, scratch),
                    all.vertex_groups.begin() + all.begin[c]);
    });
    return all;
}

} // namespace scanout::geom
