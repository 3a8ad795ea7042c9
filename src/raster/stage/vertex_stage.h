// The vertices of a frame on the screen. Each is transformed once; vertices that only deferred
// clusters use, when a tile first needs them.
#pragma once

#include "base/jobs.h"
#include "base/large_array.h"
#include "geom/mesh.h"
#include "raster/screen/screen.h"

#include <array>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

namespace scanout::raster {

class VertexStage {
public:
    // Both must outlive the draws that follow. all: transforms every vertex, not only those of
    // clusters passed to need().
    void begin(const geom::Mesh& mesh, const ScreenTransform& transform, bool all);
    // Marks the vertices of a cluster as needed. From any thread.
    void need(std::size_t cluster);
    // Transforms the vertices needed so far, on all cores.
    void transform(Jobs& jobs);
    // Transforms a cluster's vertices that no tile has transformed before. From any thread.
    void transform_deferred(std::size_t cluster);

    // Vertices that are not needed keep positions of earlier frames.
    std::span<const ScreenVertex> vertices() const { return vertices_; }

private:
    void transform_groups(std::size_t begin, std::size_t end);

    const geom::Mesh* mesh_ = nullptr;
    const ScreenTransform* transform_ = nullptr;
    std::vector<std::uint8_t> needed_; // 1 for each vertex group that is transformed, or will be
    std::array<std::mutex, 64> locks_; // for the groups of deferred clusters
    LargeArray<ScreenVertex> vertices_;
};

} // namespace scanout::raster
