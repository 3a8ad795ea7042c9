#include "geom/usable.h"

#include "base/check.h"
#include "base/chunks.h"
#include "geom/framing.h"

#include <atomic>

namespace scanout::geom {
namespace {

void check_indices(const PolygonMesh& m, const Corner& c) {
    CHECK_LT(c.position, static_cast<std::int64_t>(m.positions.size()));
    CHECK_LT(c.uv, static_cast<std::int64_t>(m.uvs.size()));
    CHECK_LT(c.normal, static_cast<std::int64_t>(m.normals.size()));
}

bool position_is_finite(const PolygonMesh& m, std::int32_t position) {
    return position >= 0 && is_finite(m.positions[static_cast<std::size_t>(position)]);
}

} // namespace

Usable::Usable(Jobs& jobs, const PolygonMesh& m)
    : face(m.faces()), position(m.positions.size()),
      chunks((m.faces() + kFaceChunk - 1) / kFaceChunk) {
    CHECK_EQ(m.face_material.size(), m.faces());
    CHECK_EQ(m.line_material.size(), m.line_begin.size());
    CHECK_EQ(m.point_material.size(), m.point_vertices.size());
    CHECK(m.face_smoothing.empty() || m.face_smoothing.size() == m.faces());
    CHECK(m.colours.empty() || m.colours.size() == m.positions.size());
    for_chunks(jobs, m.faces(), kFaceChunk, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t f = begin; f < end; ++f)
            add_face(m, f, chunks[begin / kFaceChunk]);
    });
    for (const FaceChunk& chunk : chunks) {
        all.faces += chunk.faces;
        all.corners += chunk.corners;
        all.triangles += chunk.triangles;
        all.uv |= chunk.uv;
    }
    for (const std::uint32_t p : m.line_vertices)
        use(m, p);
    for (const std::uint32_t p : m.point_vertices)
        use(m, p);
}

void Usable::add_face(const PolygonMesh& m, std::size_t f, FaceChunk& chunk) {
    const std::size_t begin = m.face_begin[f], end = m.face_end(f);
    bool usable = end >= begin + 3;
    for (std::size_t c = begin; c < end; ++c) {
        check_indices(m, m.corners[c]);
        usable = usable && position_is_finite(m, m.corners[c].position);
    }
    if (!usable) return;
    face[f] = true;
    ++chunk.faces;
    chunk.corners += end - begin;
    chunk.triangles += end - begin - 2;
    for (std::size_t c = begin; c < end; ++c) {
        // Threads write the same into the same byte.
        std::atomic_ref used(position[static_cast<std::size_t>(m.corners[c].position)]);
        if (used.load(std::memory_order_relaxed) == 0) used.store(1, std::memory_order_relaxed);
        chunk.uv |= m.corners[c].uv >= 0;
    }
}

void Usable::use(const PolygonMesh& m, std::uint32_t p) {
    CHECK_LT(p, m.positions.size());
    if (is_finite(m.positions[p])) position[p] = 1;
}

} // namespace scanout::geom
