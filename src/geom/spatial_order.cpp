#include "geom/spatial_order.h"

#include "base/check.h"
#include "base/chunks.h"
#include "base/memory.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>
#include <utility>

namespace scanout::geom {
namespace {

constexpr std::size_t kRun = Clusters::kTriangles;
constexpr std::size_t kMinTriangles = 1024; // fewer triangles stay as they are
// A run of equal squares that fill a square has a squared half diagonal of half their area. In row
// order a body's triangles have some 4 times their area, Stanford's bunny 290, its dragon 1200.
constexpr double kCompact = 8;
constexpr double kWorthwhile = 0.5;    // of the file order's compactness; else that order stays
constexpr double kThin = 0.15;         // of the mean height over the longest side
constexpr std::size_t kTogether = 512; // triangles: enough that the thin ones fill a run or two
constexpr std::size_t kSpatialChunk = 1 << 15; // triangles: a worker's next work
constexpr std::size_t kAtOnce = 16;            // chunks between two reports of progress

struct PositionBox {
    Vec3 low{std::numeric_limits<float>::infinity()}, high{-std::numeric_limits<float>::infinity()};
    void add(const Vec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    Vec3 size() const { return high - low; }
};

struct SpatialTriangle {
    Vec3 middle; // of the triangle's box, times two
    std::uint32_t triangle : 31, thin : 1;
};
using SpatialTriangles = std::span<SpatialTriangle>;

// Sorted by position: sums round to the same, whichever vertex a file begins with.
struct TriangleVertices {
    Vec3 at[3];
    TriangleVertices(const Mesh& mesh, std::size_t triangle) {
        for (std::size_t k = 0; k < 3; ++k)
            at[k] = mesh.position[mesh.index[triangle * 3 + k]];
        std::sort(std::begin(at), std::end(at), [](const Vec3& a, const Vec3& b) {
            return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
        });
    }
    // Twice the area.
    float area() const {
        const Vec3 n = glm::cross(at[1] - at[0], at[2] - at[0]);
        return std::sqrt(glm::dot(n, n));
    }
    float height() const { // over the longest side
        const auto square = [&](int a, int b) {
            const Vec3 side = at[b] - at[a];
            return glm::dot(side, side);
        };
        const float longest = std::max({square(0, 1), square(1, 2), square(2, 0)});
        return longest > 0 ? area() / std::sqrt(longest) : 0;
    }
};

// The extent of the runs of triangles, and their total area and height.
struct Compactness {
    double squares = 0;          // of the half diagonals of the runs' boxes
    double area = 0, height = 0; // sums
};
// number(i): the triangle with spatial index i.
template <class Number>
Compactness compactness(Jobs& jobs, const Mesh& mesh, Number&& number) {
    constexpr std::size_t kRuns = 1024;
    const std::size_t triangles = mesh.triangles(), runs = (triangles + kRun - 1) / kRun;
    std::vector<Compactness> of_chunk((runs + kRuns - 1) / kRuns);
    for_chunks(jobs, runs, kRuns, [&](std::size_t begin, std::size_t end, int) {
        Compactness& sum = of_chunk[begin / kRuns];
        for (std::size_t run = begin; run < end; ++run) {
            PositionBox box;
            for (std::size_t i = run * kRun; i < std::min((run + 1) * kRun, triangles); ++i) {
                const TriangleVertices vertices(mesh, number(i));
                for (const Vec3& p : vertices.at)
                    box.add(p);
                sum.area += vertices.area() / 2;
                sum.height += vertices.height();
            }
            const Vec3 half = box.size() / 2.0F;
            sum.squares += glm::dot(half, half);
        }
    });
    Compactness all;
    for (const Compactness& sum : of_chunk) {
        all.squares += sum.squares;
        all.area += sum.area;
        all.height += sum.height;
    }
    return all;
}

// Splits into two across the longest side of their box; `first` triangles go to the first half.
// Position and number decide the half, so the result does not depend on the library.
std::pair<SpatialTriangles, SpatialTriangles> cut(SpatialTriangles all, std::size_t first) {
    PositionBox box;
    for (const SpatialTriangle& p : all)
        box.add(p.middle);
    const Vec3 size = box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(first), all.end(),
                     [axis](const SpatialTriangle& a, const SpatialTriangle& b) {
                         return a.middle[axis] < b.middle[axis] ||
                                (a.middle[axis] == b.middle[axis] && a.triangle < b.triangle);
                     });
    return {all.first(first), all.subspan(first)};
}
// Splits into whole runs, as many in the first half as in the second.
std::pair<SpatialTriangles, SpatialTriangles> halve(SpatialTriangles all) {
    return cut(all, (all.size() + kRun - 1) / kRun / 2 * kRun);
}

void sort_runs(SpatialTriangles all) {
    while (all.size() > kRun) {
        const auto [first, second] = halve(all);
        sort_runs(first);
        all = second;
    }
    // The order within a run must not depend on the library.
    std::sort(all.begin(), all.end(), [](const SpatialTriangle& a, const SpatialTriangle& b) {
        return a.triangle < b.triangle;
    });
}

// Sorts triangles of one place so that those much thinner than the mesh's others come last, by
// whole runs. Snapped to the grid of the screen a thin one may turn over, so no cluster that has
// one can be culled as a whole (raster/culling/cluster_cull.h). Where a scan's surface passes close
// to a corner of the volume that it was merged in, one triangle in eight is like that.
void sort_spatially(SpatialTriangles all) {
    while (all.size() > kTogether) {
        const auto [first, second] = halve(all);
        sort_spatially(first);
        all = second;
    }
    const auto thin = std::partition(all.begin(), all.end(),
                                     [](const SpatialTriangle& p) { return p.thin == 0; });
    const auto stout = static_cast<std::size_t>(thin - all.begin()), whole = stout / kRun * kRun;
    cut(all.first(stout), whole);
    sort_runs(all.first(whole));
    sort_runs(all.subspan(whole));
}

std::vector<SpatialTriangle> middles(Jobs& jobs, const Mesh& mesh, double thinnest) {
    std::vector<SpatialTriangle> all(mesh.triangles());
    for_chunks(jobs, all.size(), kSpatialChunk, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t t = begin; t < end; ++t) {
            PositionBox box;
            for (const Vec3& p : TriangleVertices(mesh, t).at)
                box.add(p);
            const bool thin = static_cast<double>(TriangleVertices(mesh, t).height()) < thinnest;
            all[t] = {box.low + box.high, static_cast<std::uint32_t>(t), thin ? 1U : 0U};
        }
    });
    return all;
}

// Halves until each chunk is one worker's work.
void cut_in_chunks(SpatialTriangles all, std::vector<SpatialTriangles>& chunks) {
    if (all.size() <= kSpatialChunk) {
        chunks.push_back(all);
        return;
    }
    const auto [first, second] = halve(all);
    cut_in_chunks(first, chunks);
    cut_in_chunks(second, chunks);
}

// Moves the element at from[i] to position i.
template <class T>
void take(Jobs& jobs, std::span<const std::uint32_t> from, std::vector<T>& array) {
    if (array.empty()) return;
    CHECK_EQ(array.size(), from.size());
    std::vector<T> taken(from.size());
    for_chunks(jobs, taken.size(), kSpatialChunk, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i)
            taken[i] = array[from[i]];
    });
    array = std::move(taken);
}

} // namespace

bool spatial_order(Jobs& jobs, const Mesh& mesh, std::vector<std::uint32_t>& order,
                   const std::function<bool(double)>& go_on) {
    order.clear();
    if (mesh.triangles() < kMinTriangles) return true;
    CHECK_LT(mesh.triangles(), std::size_t{1} << 31); // SpatialTriangle
    const Compactness in_file =
        compactness(jobs, mesh, [](std::size_t i) { return static_cast<std::uint32_t>(i); });
    if (!(in_file.squares > kCompact * in_file.area)) return true;
    if (!go_on(0.1)) return false;
    {
        std::vector<SpatialTriangle> triangles =
            middles(jobs, mesh, kThin * in_file.height / static_cast<double>(mesh.triangles()));
        std::vector<SpatialTriangles> chunks;
        cut_in_chunks(triangles, chunks);
        for (std::size_t done = 0; done < chunks.size(); done += kAtOnce) {
            if (!go_on(0.3 + 0.5 * static_cast<double>(done) / static_cast<double>(chunks.size())))
                return false;
            const std::size_t some = std::min(kAtOnce, chunks.size() - done);
            jobs.for_each(static_cast<int>(some), [&](int chunk, int) {
                sort_spatially(chunks[done + static_cast<std::size_t>(chunk)]);
            });
        }
        order.reserve(triangles.size());
        for (const SpatialTriangle& p : triangles)
            order.push_back(p.triangle);
    }
    const Compactness in_spatial_order =
        compactness(jobs, mesh, [&order](std::size_t i) { return order[i]; });
    if (in_spatial_order.squares > kWorthwhile * in_file.squares) release(order);
    return true;
}

void order_vertices(Jobs& jobs, Mesh& mesh, std::span<const std::uint32_t> triangles) {
    constexpr std::uint32_t kNone = ~std::uint32_t{0};
    std::vector<std::uint32_t> number(mesh.position.size(), kNone), from;
    from.reserve(number.size());
    const auto add = [&](std::uint32_t vertex) {
        if (number[vertex] != kNone) return;
        number[vertex] = static_cast<std::uint32_t>(from.size());
        from.push_back(vertex);
    };
    for (const std::uint32_t t : triangles)
        for (std::size_t k = 0; k < 3; ++k)
            add(mesh.index[std::size_t{t} * 3 + k]);
    for (std::size_t v = 0; v < number.size(); ++v)
        add(static_cast<std::uint32_t>(v));
    for (auto* indices : {&mesh.index, &mesh.line_index, &mesh.point_index})
        for_chunks(jobs, indices->size(), kSpatialChunk,
                   [&](std::size_t begin, std::size_t end, int) {
                       for (std::size_t i = begin; i < end; ++i)
                           (*indices)[i] = number[(*indices)[i]];
                   });
    take(jobs, from, mesh.position);
    take(jobs, from, mesh.normal);
    take(jobs, from, mesh.uv);
    take(jobs, from, mesh.exact_uv);
    take(jobs, from, mesh.colour);
}

} // namespace scanout::geom
