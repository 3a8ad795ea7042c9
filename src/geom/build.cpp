#include "geom/build.h"

#include "base/check.h"
#include "geom/framing.h"
#include "geom/join_table.h"
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
};

// The mesh's vertices as they come to be; equal ones are joined.
class Vertices {
public:
    Vertices(Mesh& mesh, std::size_t expected, bool with_uv, bool with_colour)
        : mesh_(mesh), with_uv_(with_uv), with_colour_(with_colour), table_(expected) {
        mesh_.position.reserve(expected);
        mesh_.normal.reserve(expected);
        if (with_uv_) mesh_.uv.reserve(expected);
        if (with_colour_) mesh_.colour.reserve(expected);
    }

    std::uint32_t number_of(Vertex v) {
        v.position += 0.0f; // -0 becomes 0
        v.normal += 0.0f;
        v.uv += 0.0f;
        v.colour += 0.0f;
        return table_.find_or_add(
            hash(v), [&](std::uint32_t i) { return equals(i, v); }, [&] { append(v); },
            [&](std::uint32_t i) { return hash(vertex(i)); });
    }

private:
    static std::uint64_t bits(float a, float b) {
        return std::uint64_t{std::bit_cast<std::uint32_t>(a)} << 32 |
               std::bit_cast<std::uint32_t>(b);
    }

    std::uint64_t hash(const Vertex& v) const {
        std::uint64_t h = mix_bits(bits(v.position.x, v.position.y));
        h = mix_bits(h ^ bits(v.position.z, v.normal.x));
        h = mix_bits(h + bits(v.normal.y, v.normal.z));
        if (with_uv_) h = mix_bits(h + bits(v.uv.x, v.uv.y));
        if (with_colour_)
            h = mix_bits(mix_bits(h + bits(v.colour.x, v.colour.y)) + bits(v.colour.z, 0));
        return h;
    }
    bool equals(std::uint32_t i, const Vertex& v) const {
        return mesh_.position[i] == v.position && mesh_.normal[i] == v.normal &&
               (!with_uv_ || mesh_.uv[i] == v.uv) && (!with_colour_ || mesh_.colour[i] == v.colour);
    }
    Vertex vertex(std::uint32_t i) const {
        return {mesh_.position[i], mesh_.normal[i], with_colour_ ? mesh_.colour[i] : Vec3(1),
                with_uv_ ? mesh_.uv[i] : Vec2(0)};
    }
    void append(const Vertex& v) {
        mesh_.position.push_back(v.position);
        mesh_.normal.push_back(v.normal);
        if (with_uv_) mesh_.uv.push_back(v.uv);
        if (with_colour_) mesh_.colour.push_back(v.colour);
    }

    Mesh& mesh_;
    bool with_uv_, with_colour_;
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

// 0 where the file's number is not one; floats have room for all others that make sense.
float to_float(double x) {
    return std::abs(x) <= 1e30 ? static_cast<float>(x) : 0.0f;
}

Vec3 finite_or_zero(const Vec3& v) {
    return {to_float(v.x), to_float(v.y), to_float(v.z)};
}

class Builder {
public:
    Builder(PolygonMesh& polygons, BuildResult& result, const Usable& usable)
        : m_(polygons), result_(result), mesh_(result.mesh), usable_(usable),
          vertices_(result.mesh,
                    std::min(m_.positions.size(), m_.corners.size() + m_.line_vertices.size() +
                                                      m_.point_vertices.size()),
                    usable.uv, !m_.colours.empty()) {}

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

private:
    // A texture that is repeated very often has uvs whose floats keep too few digits of the place
    // within one repeat: such a face is moved by whole repeats towards 0 (HARD-CASES 36).
    static constexpr double kLargeUv = 64;

    void add_face(std::size_t face) {
        const std::size_t begin = m_.face_begin[face], n = m_.face_end(face) - begin;
        const DVec2 shift = uv_shift(face);
        numbers_.clear();
        for (std::size_t i = 0; i < n; ++i)
            numbers_.push_back(corner_vertex(begin + i, shift));
        cut_.clear();
        if (n == 3) {
            cut_ = {0, 1, 2};
        } else {
            outline_.clear();
            for (std::size_t i = 0; i < n; ++i)
                outline_.push_back(
                    m_.positions[static_cast<std::size_t>(m_.corners[begin + i].position)]);
            triangulate(outline_, cut_);
        }
        for (const std::uint32_t i : cut_)
            mesh_.index.push_back(numbers_[i]);
        mesh_.material.insert(mesh_.material.end(), n - 2, m_.face_material[face]);
        mesh_.face.insert(mesh_.face.end(), n - 2, static_cast<std::uint32_t>(face));
    }

    std::uint32_t corner_vertex(std::size_t corner, const DVec2& shift) {
        const Corner& c = m_.corners[corner];
        Vertex v = at_position(static_cast<std::size_t>(c.position));
        v.normal = m_.normals[static_cast<std::size_t>(c.normal)];
        if (c.uv >= 0) {
            const DVec2 uv = m_.uvs[static_cast<std::size_t>(c.uv)] - shift;
            v.uv = {to_float(uv.x), to_float(uv.y)};
        }
        return vertices_.number_of(v);
    }

    std::uint32_t bare_vertex(std::size_t position) {
        return vertices_.number_of(at_position(position));
    }

    Vertex at_position(std::size_t position) const {
        Vertex v;
        v.position = Vec3(m_.positions[position]);
        if (!m_.colours.empty()) v.colour = finite_or_zero(m_.colours[position]);
        return v;
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
    m.face_smoothing = {};
    {
        Builder builder(m, result, usable);
        builder.add_faces();
        builder.add_lines();
        builder.add_points();
    }
    warn_of(result.skipped_faces, "faces", name, warnings);
    warn_of(result.skipped_lines, "lines", name, warnings);
    warn_of(result.skipped_points, "points", name, warnings);
    return result;
}

} // namespace scanout::geom
