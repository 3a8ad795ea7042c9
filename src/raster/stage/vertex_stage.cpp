#include "raster/stage/vertex_stage.h"

#include "raster/check_lanes.h"

#include <algorithm>
#include <atomic>

namespace scanout::raster {

using geom::Clusters;

void VertexStage::begin(const geom::Mesh& mesh, const ScreenTransform& transform, bool all) {
    mesh_ = &mesh;
    transform_ = &transform;
    if (vertices_.size() != mesh.position.size())
        vertices_ = LargeArray<ScreenVertex>(mesh.position.size());
    needed_.assign((mesh.position.size() + Clusters::kGroupVertices - 1) / Clusters::kGroupVertices,
                   all ? 1 : 0);
}

void VertexStage::need(std::size_t cluster) {
    for (const std::uint32_t group : mesh_->clusters.vertex_groups_of(cluster))
        std::atomic_ref(needed_[group]).store(1, std::memory_order_relaxed);
}

void VertexStage::transform(Jobs& jobs) {
    constexpr std::size_t kGroups = 256; // a worker's next work: 4096 vertices
    const auto chunks = static_cast<int>((needed_.size() + kGroups - 1) / kGroups);
    jobs.for_each(chunks, [&](int chunk, int) {
        std::size_t group = static_cast<std::size_t>(chunk) * kGroups;
        const std::size_t last = std::min(group + kGroups, needed_.size());
        while (group < last) {
            const std::size_t from = group;
            while (group < last && needed_[group] != 0)
                ++group;
            if (group > from)
                transform_groups(from, group);
            else
                ++group;
        }
    });
}

void VertexStage::transform_groups(std::size_t begin, std::size_t end) {
    const std::size_t first = begin * Clusters::kGroupVertices,
                      n = std::min(end * Clusters::kGroupVertices, mesh_->position.size()) - first;
    const auto out = std::span(vertices_).subspan(first, n);
    transform_vertices(*transform_, std::span(mesh_->position).subspan(first, n), out);
    check_lanes(out);
}

void VertexStage::transform_deferred(std::size_t cluster) {
    for (const std::uint32_t group : mesh_->clusters.vertex_groups_of(cluster)) {
        const std::atomic_ref needed(needed_[group]);
        if (needed.load(std::memory_order_acquire) != 0) continue;
        const std::scoped_lock lock(locks_[group % locks_.size()]);
        if (needed.load(std::memory_order_relaxed) != 0) continue;
        transform_groups(group, group + 1);
        needed.store(1, std::memory_order_release);
    }
}

} // namespace scanout::raster
