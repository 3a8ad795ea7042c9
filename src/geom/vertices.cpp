#include "geom/vertices.h"

#include "base/memory.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace scanout::geom {
namespace {

struct Vertex {
    Vec3 position{0}, normal{0, 0, 1}, colour{1};
    Vec2 uv{0};
    DVec2 exact_uv{0}; // where uv is large
    bool operator==(const Vertex&) const = default;
};

// 0 where the file's number is NaN, infinite or beyond 1e30: no model needs one like that.
float to_float(double x) {
    return std::abs(x) <= 1e30 ? static_cast<float>(x) : 0.0f;
}

double to_finite(double x) {
    return std::abs(x) <= 1e30 ? x : 0;
}
DVec2 exact(const DVec2& uv) {
    return {to_finite(uv.x), to_finite(uv.y)};
}
bool is_large(const Vec2& uv) {
    return std::max(std::abs(uv.x), std::abs(uv.y)) > Mesh::kLargeUv;
}

Vec3 finite_or_zero(const Vec3& v) {
    return {to_float(v.x), to_float(v.y), to_float(v.z)};
}

std::uint64_t bits(float a, float b) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(a)} << 32 | std::bit_cast<std::uint32_t>(b);
}

Vec3 position_of(const PolygonMesh& m, const Corner& c) {
    return Vec3(m.positions[static_cast<std::size_t>(c.position)]) + 0.0f; // -0 becomes 0
}

Vertex vertex_of(const PolygonMesh& m, const Corner& c) {
    Vertex v;
    v.position = position_of(m, c);
    if (c.normal >= 0) v.normal = m.normals[static_cast<std::size_t>(c.normal)] + 0.0f;
    if (c.uv >= 0) {
        const DVec2& uv = m.uvs[static_cast<std::size_t>(c.uv)];
        v.uv = Vec2(to_float(uv.x), to_float(uv.y)) + 0.0f;
        if (is_large(v.uv)) v.exact_uv = exact(uv) + 0.0;
    }
    if (!m.colours.empty())
        v.colour = finite_or_zero(m.colours[static_cast<std::size_t>(c.position)]) + 0.0f;
    return v;
}

DVec2 exact_uv_of(const PolygonMesh& m, const Corner& c) {
    return c.uv < 0 ? DVec2(0) : exact(m.uvs[static_cast<std::size_t>(c.uv)]);
}

std::uint64_t hash_of(const PolygonMesh& m, const Corner& c) {
    constexpr std::uint64_t kFactor = 0x9e3779b97f4a7c15U; // odd, without a pattern
    const Vertex v = vertex_of(m, c);
    std::uint64_t h = bits(v.position.x, v.position.y);
    h = h * kFactor + bits(v.position.z, v.normal.x);
    h = h * kFactor + bits(v.normal.y, v.normal.z);
    if (!m.uvs.empty()) h = h * kFactor + bits(v.uv.x, v.uv.y);
    if (!m.colours.empty())
        h = (h * kFactor + bits(v.colour.x, v.colour.y)) * kFactor + bits(v.colour.z, 0);
    return mix_bits(h);
}

// Do both make the same vertex? Compares indices first, then positions, then all: the fewest memory
// reads come first.
bool are_one(const PolygonMesh& m, const Corner& a, const Corner& b) {
    if (a.position == b.position && a.uv == b.uv && a.normal == b.normal) return true;
    return position_of(m, a) == position_of(m, b) && vertex_of(m, a) == vertex_of(m, b);
}

// The interface that the table calls.
struct Items {
    PolygonMesh& m;
    std::span<const Corner> corners;

    std::uint64_t hash(std::size_t item) const { return hash_of(m, corners[item]); }
    std::uint64_t hash_of_row(std::uint32_t row) const { return hash_of(m, m.corners[row]); }
    bool same(std::size_t a, std::size_t b) const { return are_one(m, corners[a], corners[b]); }
    bool is_row(std::size_t item, std::uint32_t row) const {
        return are_one(m, m.corners[row], corners[item]);
    }
    void make_room(std::size_t rows) const {
        if (rows > m.corners.size()) m.corners.resize(rows);
    }
    void write(std::size_t item, std::uint32_t row) const { m.corners[row] = corners[item]; }
};

bool has_large_uv(const PolygonMesh& m, std::size_t vertices) {
    const auto large = [](const DVec2& uv) {
        return is_large(Vec2(to_float(uv.x), to_float(uv.y)));
    };
    if (std::none_of(m.uvs.begin(), m.uvs.end(), large)) return false; // as nearly always
    return std::any_of(
        m.corners.begin(), m.corners.begin() + static_cast<std::ptrdiff_t>(vertices),
        [&](const Corner& c) { return c.uv >= 0 && large(m.uvs[static_cast<std::size_t>(c.uv)]); });
}

} // namespace

Vertices::Vertices(Jobs& jobs, PolygonMesh& polygons, std::size_t expected)
    : jobs_(jobs), m_(polygons), table_(std::make_unique<JoinTable>(jobs, expected)) {}

std::span<const std::uint32_t> Vertices::numbers_of(std::span<const Corner> corners) {
    return table_->join(corners.size(), Items{m_, corners});
}

void Vertices::write(Mesh& mesh, bool with_uv, bool with_colour) {
    const std::size_t count = table_->rows();
    table_.reset();
    release_freed(); // its parts
    mesh.position.reserve(count);
    mesh.normal.reserve(count);
    if (with_uv) mesh.uv.reserve(count);
    if (with_colour) mesh.colour.reserve(count);
    const bool with_exact_uv = with_uv && has_large_uv(m_, count);
    if (with_exact_uv) mesh.exact_uv.reserve(count);
    constexpr std::size_t kChunk = 8192, kWave = 8 * kChunk;
    for (std::size_t wave = 0; wave < count; wave += kWave) {
        const std::size_t wave_end = std::min(wave + kWave, count);
        mesh.position.resize(wave_end);
        mesh.normal.resize(wave_end);
        if (with_uv) mesh.uv.resize(wave_end);
        if (with_exact_uv) mesh.exact_uv.resize(wave_end);
        if (with_colour) mesh.colour.resize(wave_end);
        for_chunks(jobs_, wave_end - wave, kChunk, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = wave + begin; i < wave + end; ++i) {
                const Vertex v = vertex_of(m_, m_.corners[i]);
                mesh.position[i] = v.position;
                mesh.normal[i] = v.normal;
                if (with_uv) mesh.uv[i] = v.uv;
                if (with_exact_uv) mesh.exact_uv[i] = exact_uv_of(m_, m_.corners[i]);
                if (with_colour) mesh.colour[i] = v.colour;
            }
        });
        release_pages(&m_.corners[wave], (wave_end - wave) * sizeof(Corner));
    }
}

} // namespace scanout::geom
