#include "geom/build.h"

#include "base/check.h"
#include "base/memory.h"
#include "geom/framing.h"
#include "geom/join_table.h"
#include "geom/line_faces.h"
#include "geom/normals.h"
#include "geom/triangulate.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace scanout::geom {
namespace {

struct Vertex {
    Vec3 position{0}, normal{0, 0, 1}, colour{1};
    Vec2 uv{0};
    bool operator==(const Vertex&) const = default;
};

// 0 where the file's number is not one; floats have room for all others that make sense.
float to_float(double x) {
    return std::abs(x) <= 1e30 ? static_cast<float>(x) : 0.0f;
}

Vec3 finite_or_zero(const Vec3& v) {
    return {to_float(v.x), to_float(v.y), to_float(v.z)};
}

// Gives corners that make the same vertex one number. Memory decides its shape: where faces are
// flat, the vertices are the largest array of all, and they must not stand beside the corners and a
// table that both still grow. So a vertex is first a corner alone, kept in the place of a corner
// that is done with (vertex i comes of corner i or a later one); write() makes the arrays when
// everything else is gone, in their final size.
class Vertices {
public:
    Vertices(PolygonMesh& polygons, std::size_t expected) : m_(polygons), table_(expected) {}

    // Overwrites corners up to the number of calls so far: each of a face's corners must be asked
    // for once, in their order.
    std::uint32_t number_of(Corner c) {
        const Vertex v = vertex(c);
        return table_.find_or_add(
            hash(v), [&](std::uint32_t i) { return is(m_.corners[i], c, v); },
            [&] {
                if (const std::size_t next = table_.rows(); next < m_.corners.size())
                    m_.corners[next] = c;
                else
                    m_.corners.push_back(c);
            },
            [&](std::uint32_t i) { return hash(vertex(m_.corners[i])); });
    }

    // Frees the table, and the corners as it goes.
    void write(Mesh& mesh, bool with_uv, bool with_colour) {
        const std::size_t count = table_.rows();
        table_ = JoinTable(0);
        mesh.position.reserve(count);
        mesh.normal.reserve(count);
        if (with_uv) mesh.uv.reserve(count);
        if (with_colour) mesh.colour.reserve(count);
        constexpr std::size_t kBlock = 65536;
        for (std::size_t i = 0; i < count; ++i) {
            if (i % kBlock == 0 && i > 0)
                release_pages(&m_.corners[i - kBlock], kBlock * sizeof(Corner));
            const Vertex v = vertex(m_.corners[i]);
            mesh.position.push_back(v.position);
            mesh.normal.push_back(v.normal);
            if (with_uv) mesh.uv.push_back(v.uv);
            if (with_colour) mesh.colour.push_back(v.colour);
        }
    }

private:
    // Whether `a` makes the vertex v of corner c: by what decides it with the fewest places in
    // memory.
    bool is(const Corner& a, const Corner& c, const Vertex& v) const {
        if (a.position == c.position && a.uv == c.uv && a.normal == c.normal) return true;
        return position(a) == v.position && vertex(a) == v;
    }

    Vec3 position(const Corner& c) const {
        return Vec3(m_.positions[static_cast<std::size_t>(c.position)]) + 0.0f; // -0 becomes 0
    }

    Vertex vertex(const Corner& c) const {
        Vertex v;
        v.position = position(c);
        if (c.normal >= 0) v.normal = m_.normals[static_cast<std::size_t>(c.normal)] + 0.0f;
        if (c.uv >= 0) {
            const DVec2& uv = m_.uvs[static_cast<std::size_t>(c.uv)];
            v.uv = Vec2(to_float(uv.x), to_float(uv.y)) + 0.0f;
        }
        if (!m_.colours.empty())
            v.colour = finite_or_zero(m_.colours[static_cast<std::size_t>(c.position)]) + 0.0f;
        return v;
    }

    static std::uint64_t bits(float a, float b) {
        return std::uint64_t{std::bit_cast<std::uint32_t>(a)} << 32 |
               std::bit_cast<std::uint32_t>(b);
    }
    std::uint64_t hash(const Vertex& v) const {
        std::uint64_t h = mix_bits(bits(v.position.x, v.position.y));
        h = mix_bits(h ^ bits(v.position.z, v.normal.x));
        h = mix_bits(h + bits(v.normal.y, v.normal.z));
        if (!m_.uvs.empty()) h = mix_bits(h + bits(v.uv.x, v.uv.y));
        if (!m_.colours.empty())
            h = mix_bits(mix_bits(h + bits(v.colour.x, v.colour.y)) + bits(v.colour.z, 0));
        return h;
    }

    PolygonMesh& m_;
    JoinTable table_;
};

// Which faces can be drawn, and which positions anything uses.
struct Usable {
    std::vector<bool> face, position;
    std::size_t faces = 0, triangles = 0;
    bool uv = false;

    explicit Usable(const PolygonMesh& m) : face(m.faces()), position(m.positions.size()) {
        CHECK_EQ(m.face_material.size(), m.faces());
        CHECK_EQ(m.line_material.size(), m.line_begin.size());
        CHECK_EQ(m.point_material.size(), m.point_vertices.size());
        CHECK(m.face_smoothing.empty() || m.face_smoothing.size() == m.faces());
        CHECK(m.colours.empty() || m.colours.size() == m.positions.size());
        for (std::size_t f = 0; f < m.faces(); ++f) {
            const std::size_t begin = m.face_begin[f], end = m.face_end(f);
            face[f] = end >= begin + 3;
            for (std::size_t c = begin; c < end; ++c) {
                check_indices(m, m.corners[c]);
                face[f] = face[f] && position_is_finite(m, m.corners[c].position);
            }
            if (!face[f]) continue;
            ++faces;
            triangles += end - begin - 2;
            for (std::size_t c = begin; c < end; ++c) {
                position[static_cast<std::size_t>(m.corners[c].position)] = true;
                uv |= m.corners[c].uv >= 0;
            }
        }
        for (const std::uint32_t p : m.line_vertices)
            use(m, p);
        for (const std::uint32_t p : m.point_vertices)
            use(m, p);
    }

private:
    static void check_indices(const PolygonMesh& m, const Corner& c) {
        CHECK_LT(c.position, static_cast<std::int64_t>(m.positions.size()));
        CHECK_LT(c.uv, static_cast<std::int64_t>(m.uvs.size()));
        CHECK_LT(c.normal, static_cast<std::int64_t>(m.normals.size()));
    }
    static bool position_is_finite(const PolygonMesh& m, std::int32_t position) {
        return position >= 0 && is_finite(m.positions[static_cast<std::size_t>(position)]);
    }
    void use(const PolygonMesh& m, std::uint32_t p) {
        CHECK_LT(p, m.positions.size());
        if (is_finite(m.positions[p])) position[p] = true;
    }
};

class Builder {
public:
    Builder(PolygonMesh& polygons, BuildResult& result, const Usable& usable)
        : m_(polygons), result_(result), mesh_(result.mesh), usable_(usable),
          vertices_(polygons,
                    std::min(m_.positions.size(), m_.corners.size() + m_.line_vertices.size() +
                                                      m_.point_vertices.size())) {}

    void add_faces() {
        mesh_.index.reserve(usable_.triangles * 3);
        mesh_.material.reserve(usable_.triangles);
        mesh_.face.reserve(usable_.triangles);
        for (std::size_t f = 0; f < m_.faces(); ++f)
            if (usable_.face[f]) add_face(f);
    }

    // A polyline is drawn whole or not at all, as a face is.
    void add_lines() {
        for (std::size_t line = 0; line < m_.line_begin.size(); ++line) {
            const std::size_t begin = m_.line_begin[line];
            const std::size_t end =
                line + 1 < m_.line_begin.size() ? m_.line_begin[line + 1] : m_.line_vertices.size();
            const std::span part = std::span(m_.line_vertices).subspan(begin, end - begin);
            if (!std::all_of(part.begin(), part.end(),
                             [&](auto p) { return usable_.position[p]; })) {
                ++result_.skipped_lines;
                continue;
            }
            for (std::size_t i = 1; i < part.size(); ++i) {
                mesh_.line_index.push_back(bare_vertex(part[i - 1]));
                mesh_.line_index.push_back(bare_vertex(part[i]));
                mesh_.line_material.push_back(m_.line_material[line]);
            }
        }
    }

    void add_points() {
        for (std::size_t i = 0; i < m_.point_vertices.size(); ++i) {
            if (!usable_.position[m_.point_vertices[i]]) {
                ++result_.skipped_points;
                continue;
            }
            mesh_.point_index.push_back(bare_vertex(m_.point_vertices[i]));
            mesh_.point_material.push_back(m_.point_material[i]);
        }
    }

    // Last: frees what the others need.
    void make_vertices() {
        release(m_.face_begin);
        release(m_.face_material);
        vertices_.write(mesh_, usable_.uv, !m_.colours.empty());
    }

private:
    // A texture that is repeated very often has uvs whose floats keep too few digits of the place
    // within one repeat: such a face is moved by whole repeats towards 0 (HARD-CASES 36).
    static constexpr double kLargeUv = 64;

    void add_face(std::size_t face) {
        const std::size_t begin = m_.face_begin[face], n = m_.face_end(face) - begin;
        cut_.clear(); // before the vertices are numbered, which overwrites corners
        if (n == 3) {
            cut_ = {0, 1, 2};
        } else {
            outline_.clear();
            for (std::size_t i = 0; i < n; ++i)
                outline_.push_back(
                    m_.positions[static_cast<std::size_t>(m_.corners[begin + i].position)]);
            triangulate(outline_, cut_);
        }
        const DVec2 shift = uv_shift(face);
        numbers_.clear();
        for (std::size_t i = 0; i < n; ++i)
            numbers_.push_back(vertices_.number_of(shifted(m_.corners[begin + i], shift)));
        for (const std::uint32_t i : cut_)
            mesh_.index.push_back(numbers_[i]);
        mesh_.material.insert(mesh_.material.end(), n - 2, m_.face_material[face]);
        mesh_.face.insert(mesh_.face.end(), n - 2, static_cast<std::uint32_t>(face));
    }

    Corner shifted(Corner c, const DVec2& shift) {
        constexpr std::size_t kMostUvs = std::numeric_limits<std::int32_t>::max();
        if (c.uv < 0 || shift == DVec2(0) || m_.uvs.size() >= kMostUvs) return c;
        const DVec2 uv = m_.uvs[static_cast<std::size_t>(c.uv)] - shift;
        c.uv = static_cast<std::int32_t>(m_.uvs.size());
        m_.uvs.push_back(uv);
        return c;
    }

    std::uint32_t bare_vertex(std::uint32_t position) {
        return vertices_.number_of({.position = static_cast<std::int32_t>(position)});
    }

    DVec2 uv_shift(std::size_t face) const {
        DVec2 lo(std::numeric_limits<double>::infinity()), largest(0);
        if (!usable_.uv) return largest;
        for (std::size_t c = m_.face_begin[face]; c < m_.face_end(face); ++c) {
            if (m_.corners[c].uv < 0) continue;
            const DVec2& uv = m_.uvs[static_cast<std::size_t>(m_.corners[c].uv)];
            lo = {std::min(lo.x, uv.x), std::min(lo.y, uv.y)};
            largest = {std::max(largest.x, std::abs(uv.x)), std::max(largest.y, std::abs(uv.y))};
        }
        return {largest.x > kLargeUv ? std::floor(lo.x) : 0,
                largest.y > kLargeUv ? std::floor(lo.y) : 0};
    }

    PolygonMesh& m_;
    BuildResult& result_;
    Mesh& mesh_;
    const Usable& usable_;
    Vertices vertices_;
    std::vector<std::uint32_t> numbers_, cut_; // of one face: vertex numbers, triangles of corners
    std::vector<DVec3> outline_;
};

void warn_of(std::size_t count, const char* what, const std::string& name, Warnings& warnings) {
    if (count > 0)
        warnings.add(what,
                     fmt::format("{}: {} {} not drawn: a coordinate is not a finite number, or "
                                 "there are too few corners",
                                 name, count, what));
}

} // namespace

BuildResult build_mesh(PolygonMesh&& polygons, const BuildOptions& options, const std::string& name,
                       Warnings& warnings) {
    PolygonMesh m = std::move(polygons);
    BuildResult result;
    const Usable usable(m);
    result.skipped_faces = m.faces() - usable.faces;

    const Framing framing = framing_of(m.positions, usable.position);
    result.mesh.centre = framing.centre;
    result.mesh.exponent = framing.exponent;
    result.mesh.radius = framing.radius;
    result.mesh.box_min = framing.box_min;
    result.mesh.box_max = framing.box_max;
    for (DVec3& p : m.positions)
        p = framing.normalise(p); // from here on everything is of unit size

    make_normals(m, usable.face, options.crease_degrees);
    release(m.face_smoothing);
    {
        Builder builder(m, result, usable);
        builder.add_faces();
        builder.add_lines();
        builder.add_points();
        builder.make_vertices();
    }
    find_line_faces(result.mesh);
    warn_of(result.skipped_faces, "faces", name, warnings);
    warn_of(result.skipped_lines, "lines", name, warnings);
    warn_of(result.skipped_points, "points", name, warnings);
    return result;
}

} // namespace scanout::geom
