#include "io/stl/reader.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

namespace scanout::io {
namespace {

std::uint64_t hash_of(const DVec3& v) {
    constexpr std::uint64_t kFactor = 0x9e3779b97f4a7c15U; // odd, without a pattern
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
    // Doubles made from floats end in zero bits; a product alone would keep them zero in the hash.
    const std::uint64_t h = (bits(v.x) ^ bits(v.x) >> 32) * kFactor + (bits(v.y) ^ bits(v.y) >> 32);
    return geom::mix_bits(h * kFactor + (bits(v.z) ^ bits(v.z) >> 32));
}

// The vertices of some triangles, with the interface that the table calls.
struct Vertices {
    geom::PolygonMesh& m;
    std::span<const StlTriangle> triangles;

    DVec3 at(std::size_t item) const { return triangles[item / 3][item % 3] + 0.0; } // no -0

    std::uint64_t hash(std::size_t item) const { return hash_of(at(item)); }
    std::uint64_t hash_of_row(std::uint32_t row) const { return hash_of(m.positions[row]); }
    bool same(std::size_t a, std::size_t b) const { return at(a) == at(b); }
    bool is_row(std::size_t item, std::uint32_t row) const { return m.positions[row] == at(item); }
    void make_room(std::size_t rows) const { m.positions.resize(rows); }
    void write(std::size_t item, std::uint32_t row) const { m.positions[row] = at(item); }
};

} // namespace

StlCollector::StlCollector(Jobs& jobs, const std::string& path, Warnings& warnings,
                           std::size_t expected)
    : jobs_(jobs), path_(path), warnings_(warnings), positions_(jobs, expected / 2) {
    result_.polygons.positions.reserve(expected / 2);
    result_.polygons.corners.reserve(expected * 3);
    result_.polygons.face_begin.reserve(expected);
}

void StlCollector::add(std::span<const StlTriangle> triangles,
                       std::span<const std::int32_t> materials) {
    constexpr std::size_t kBlock = 4096;
    geom::PolygonMesh& m = result_.polygons;
    const std::span<const std::uint32_t> numbers =
        positions_.join(triangles.size() * 3, Vertices{m, triangles});
    const std::size_t corners = m.corners.size(), faces = m.faces();
    m.corners.resize(corners + numbers.size());
    m.face_begin.resize(faces + triangles.size());
    m.face_material.resize(faces + triangles.size(), -1);
    std::copy(materials.begin(), materials.end(),
              m.face_material.begin() + static_cast<std::ptrdiff_t>(faces));
    for_chunks(jobs_, triangles.size(), kBlock, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i)
            m.face_begin[faces + i] = static_cast<std::uint32_t>(corners + i * 3);
        for (std::size_t i = begin * 3; i < end * 3; ++i)
            m.corners[corners + i].position = static_cast<std::int32_t>(numbers[i]);
    });
}

void StlCollector::skip(std::string line) {
    if (result_.skipped++ == 0) first_fault_ = line;
    warnings_.add("stl facet", std::move(line));
}

Result<StlResult> StlCollector::finish() {
    result_.facets = result_.polygons.faces();
    if (result_.skipped > 0 && result_.facets == 0)
        return fail(Exit::unreadable, "{}; {} has no facet that can be drawn", first_fault_, path_);
    if (result_.facets == 0)
        return fail(Exit::unreadable, "{}: an STL file without facets: nothing to draw", path_);
    return std::move(result_);
}

Result<> report(const std::function<bool(double)>& progress, std::size_t done, std::size_t size,
                const std::string& path) {
    if (progress && !progress(static_cast<double>(done) / static_cast<double>(size)))
        return fail(Exit::unreadable, "{}: loading was cancelled", path);
    return {};
}

} // namespace scanout::io
