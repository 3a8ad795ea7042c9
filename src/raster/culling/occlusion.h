// Temporal coherence for occlusion culling: keeps, from frame to frame of one view, which clusters
// of triangles were occluded at their last occlusion query. These are deferred until a tile has
// drawn all others, and are drawn only if the others do not occlude them. Some of the clusters that
// are drawn at once are queried, too: a finished tile reports whether it occludes them. The history
// is a guess; no picture depends on it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace scanout::raster {

class OcclusionHistory {
public:
    void begin_frame(std::size_t clusters);
    // Call at most once a frame and cluster. Queries all clusters in the second frame, later each
    // one from time to time; none in the first frame, which may be the only one.
    enum class Action : std::uint8_t { draw, draw_and_query, defer };
    Action next_action(std::size_t cluster);
    // A queried or deferred cluster that some tile does not occlude. From any thread.
    void set_visible(std::size_t cluster);

private:
    // State from frame to frame: drawn at once, or occluded; a queried one may become visible.
    enum : std::uint8_t { kDrawn, kOccluded, kQueried, kQueriedVisible };
    std::vector<std::uint8_t> state_;
    std::size_t frame_ = 0;
    static constexpr std::size_t kNever = 0;
    std::size_t period_ = kNever; // frames between two queries of a drawn cluster
};

} // namespace scanout::raster
