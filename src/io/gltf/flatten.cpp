#include "io/gltf/flatten.h"

#include "io/vertex_colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace scanout::io::gltf {
namespace {

std::uint64_t triangles_of(Mode mode, std::uint64_t corners) {
    if (mode == Mode::triangles) return corners / 3;
    return mode < Mode::triangles || corners < 3 ? 0 : corners - 2;
}

// Cofactors of the upper 3 x 3: they turn normals, mirrored places included, and are never divided.
struct Turn {
    DMat3 normals{1};
    bool mirrored = false;
};
Turn turn_of(const DMat4& m) {
    const DVec3 x(m[0]), y(m[1]), z(m[2]);
    Turn turn;
    turn.normals = DMat3(cross3(y, z), cross3(z, x), cross3(x, y));
    turn.mirrored = dot3(x, turn.normals[0]) < 0;
    double greatest = 0;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            greatest = std::max(greatest, std::abs(turn.normals[c][r]));
    const double scale = (turn.mirrored ? -1 : 1) / greatest;
    turn.normals = std::isfinite(scale) ? turn.normals * scale : DMat3(0);
    return turn;
}

DVec3 moved_by(const DMat4& m, const DVec3& p) {
    return ((DVec3(m[0]) * p.x + DVec3(m[1]) * p.y) + DVec3(m[2]) * p.z) + DVec3(m[3]);
}
DVec3 turned_by(const DMat3& m, const DVec3& n) {
    return (m[0] * n.x + m[1] * n.y) + m[2] * n.z;
}

} // namespace

void MeshSize::add(const PrimitiveData& p) {
    const std::uint64_t count = p.positions.count, all = p.corners();
    // Enough to be refused; sums of them do not overflow.
    constexpr std::uint64_t kTooMany = std::uint64_t{1} << 32;
    if (count >= kTooMany || all >= kTooMany || vertices >= kTooMany || corners >= kTooMany) {
        vertices = corners = kTooMany;
        return;
    }
    vertices += count;
    normals += p.normals ? count : 0;
    uvs += p.uvs ? count : 0;
    colours += p.colours ? count : 0;
    influences = std::max(influences, count * p.influences.size());
    indices = std::max(indices, all);
    const std::uint64_t triangles = triangles_of(p.mode, all);
    faces += triangles;
    corners += p.mode < Mode::triangles ? all * 2 : triangles * 3;
}

void MeshSize::add(const MeshSize& o) {
    vertices += o.vertices;
    normals += o.normals;
    uvs += o.uvs;
    colours += o.colours;
    corners += o.corners;
    faces += o.faces;
    influences = std::max(influences, o.influences);
    indices = std::max(indices, o.indices);
}

std::uint64_t MeshSize::bytes() const {
    return vertices * sizeof(DVec3) + normals * sizeof(Vec3) + uvs * sizeof(DVec2) +
           (colours > 0 ? vertices : 0) * sizeof(Vec3) + corners * sizeof(geom::Corner) +
           influences * 2 * sizeof(std::array<float, 4>) + indices * sizeof(std::uint32_t) +
           faces * (sizeof(std::uint32_t) + sizeof(std::int32_t));
}

bool MeshSize::fits() const {
    return vertices <= kMostVertices && corners <= kMostCorners;
}

void Flattener::reserve(const MeshSize& size) {
    out_.positions.reserve(size.vertices);
    out_.normals.reserve(size.normals);
    out_.uvs.reserve(size.uvs);
    if (size.colours > 0) out_.colours.reserve(size.vertices);
    out_.corners.reserve(size.faces * 3);
    out_.face_begin.reserve(size.faces);
    out_.face_material.reserve(size.faces);
}

void Flattener::add(const PrimitiveData& p, const Where& where, const UvUse& uv,
                    std::int32_t material, const Which& which) {
    first_ = static_cast<std::int32_t>(out_.positions.size());
    first_uv_ = p.uvs ? static_cast<std::int32_t>(out_.uvs.size()) : -1;
    first_normal_ = p.normals ? static_cast<std::int32_t>(out_.normals.size()) : -1;
    material_ = material;
    vertices_ = static_cast<std::uint32_t>(p.positions.count);
    const std::size_t skipped = skipped_;
    const bool good = read_indices(p, which);
    DMat4 placed = where.matrix;
    if (where.palette != nullptr && !p.influences.empty()) {
        const VertexSkin skin(p.influences, *where.palette);
        if (p.positions.count > 0) placed = skin.at(0).value_or(where.matrix);
        add_skinned(p, where.matrix, skin);
    } else {
        add_vertices(p, where.matrix);
    }
    if (p.uvs) add_uvs(*p.uvs, uv);
    if (p.colours) add_colours(*p.colours);
    if (p.mode == Mode::points)
        add_points();
    else if (p.mode < Mode::triangles)
        add_lines(p.mode);
    else
        add_triangles(p.mode, turn_of(placed).mirrored);
    if (!good && skipped_ - skipped > 1) warnings_.add_more("glTF index", skipped_ - skipped - 1);
}

// False, with a warning, where an index is beyond the vertices.
bool Flattener::read_indices(const PrimitiveData& p, const Which& which) {
    indices_.resize(p.corners());
    all_there_ = true;
    if (!p.indices) {
        for (std::uint32_t i = 0; i < vertices_; ++i)
            indices_[i] = i;
        return true;
    }
    std::uint32_t greatest = 0;
    for_indices(*p.indices, [&](std::uint64_t i, std::uint32_t index) {
        indices_[i] = index;
        greatest = std::max(greatest, index);
    });
    if (indices_.empty() || is_there(greatest)) return true;
    all_there_ = false;
    warnings_.add(
        "glTF index",
        fmt::format(
            "{}: meshes[{}].primitives[{}]: an index is {}, and there are {} vertices: what "
            "it belongs to is left out",
            path_, which.mesh, which.primitive, greatest, vertices_));
    return false;
}

void Flattener::add_vertices(const PrimitiveData& p, const DMat4& m) {
    const bool moved = m != DMat4(1);
    for_elements<3>(p.positions, [&](std::uint64_t, const auto* e) {
        const DVec3 at(e[0], e[1], e[2]);
        out_.positions.push_back(moved ? moved_by(m, at) : at);
    });
    if (!p.normals) return;
    const DMat3 turn = turn_of(m).normals;
    for_elements<3>(*p.normals, [&](std::uint64_t, const auto* e) {
        const DVec3 n(e[0], e[1], e[2]);
        out_.normals.emplace_back(moved ? turned_by(turn, n) : n);
    });
}

// What no joint holds is placed by its node.
void Flattener::add_skinned(const PrimitiveData& p, const DMat4& node, const VertexSkin& skin) {
    for_elements<3>(p.positions, [&](std::uint64_t i, const auto* e) {
        out_.positions.push_back(moved_by(skin.at(i).value_or(node), DVec3(e[0], e[1], e[2])));
    });
    if (!p.normals) return;
    for_elements<3>(*p.normals, [&](std::uint64_t i, const auto* e) {
        out_.normals.emplace_back(
            turned_by(turn_of(skin.at(i).value_or(node)).normals, DVec3(e[0], e[1], e[2])));
    });
}

void Flattener::add_uvs(const View& uvs, const UvUse& uv) {
    for_elements<2>(uvs, [&](std::uint64_t, const auto* e) {
        const DVec2 at = uv.apply(DVec2(e[0], e[1]));
        out_.uvs.emplace_back(at.x, 1 - at.y); // glTF's v runs down
    });
}

// COLOR_0 is linear.
void Flattener::add_colours(const View& colours) {
    out_.colours.resize(static_cast<std::size_t>(first_), Vec3(1));
    const auto light = [](double value) {
        return static_cast<float>(value > kDarkest ? std::min(value, 1.0) : 0);
    };
    for_elements<3>(colours, [&](std::uint64_t, const auto* e) {
        out_.colours.emplace_back(light(e[0]), light(e[1]), light(e[2]));
    });
    if (colours.rows < 4 || colour_alpha_) return;
    for_elements<4>(colours, [&](std::uint64_t, const auto* e) { colour_alpha_ |= e[3] < 0.998; });
}

void Flattener::add_triangles(Mode mode, bool mirrored) {
    const std::size_t count = triangles_of(mode, indices_.size());
    auto& faces = out_.face_begin;
    for (std::size_t i = 0; i < count; ++i) {
        std::uint32_t v[3];
        if (mode == Mode::triangles) {
            for (std::size_t k = 0; k < 3; ++k)
                v[k] = indices_[3 * i + k];
        } else if (mode == Mode::triangle_strip) {
            v[0] = indices_[i];
            v[1] = indices_[i + 1 + i % 2];
            v[2] = indices_[i + 2 - i % 2];
        } else {
            v[0] = indices_[0];
            v[1] = indices_[i + 1];
            v[2] = indices_[i + 2];
        }
        if (!all_there_ && !(is_there(v[0]) && is_there(v[1]) && is_there(v[2]))) {
            ++skipped_;
            continue;
        }
        if (mirrored) std::swap(v[1], v[2]);
        faces.push_back(static_cast<std::uint32_t>(out_.corners.size()));
        for (const std::uint32_t vertex : v) {
            const auto at = static_cast<std::int32_t>(vertex);
            out_.corners.push_back({first_ + at, first_uv_ < 0 ? -1 : first_uv_ + at,
                                    first_normal_ < 0 ? -1 : first_normal_ + at});
        }
    }
    out_.face_material.resize(faces.size(), material_);
}

void Flattener::add_lines(Mode mode) {
    const std::size_t count = indices_.size();
    const auto begin = [&] {
        out_.line_begin.push_back(static_cast<std::uint32_t>(out_.line_vertices.size()));
        out_.line_material.push_back(material_);
    };
    const auto vertex = [&](std::uint32_t index) {
        out_.line_vertices.push_back(static_cast<std::uint32_t>(first_) + index);
    };
    const auto segment = [&](std::uint32_t from, std::uint32_t to, bool goes_on) {
        if (!is_there(from) || !is_there(to)) {
            ++skipped_;
            return false;
        }
        if (!goes_on) {
            begin();
            vertex(from);
        }
        vertex(to);
        return true;
    };
    if (mode == Mode::lines) {
        for (std::size_t i = 0; i + 1 < count; i += 2)
            segment(indices_[i], indices_[i + 1], false);
        return;
    }
    bool goes_on = false;
    for (std::size_t i = 0; i + 1 < count; ++i)
        goes_on = segment(indices_[i], indices_[i + 1], goes_on);
    if (mode == Mode::line_loop && count > 2) segment(indices_[count - 1], indices_[0], goes_on);
}

void Flattener::add_points() {
    for (const std::uint32_t index : indices_) {
        if (!is_there(index)) {
            ++skipped_;
            continue;
        }
        out_.point_vertices.push_back(static_cast<std::uint32_t>(first_) + index);
        out_.point_material.push_back(material_);
    }
}

geom::PolygonMesh Flattener::take() {
    if (!out_.colours.empty()) out_.colours.resize(out_.positions.size(), Vec3(1));
    return std::move(out_);
}

} // namespace scanout::io::gltf
