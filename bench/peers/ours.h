// A load drawn by scanout: one call a frame, from the view to the picture in memory.
#pragma once

#include "base/jobs.h"
#include "bench/peers/load.h"
#include "frame/cleared_tiles.h"
#include "frame/plan/plan_cache.h"
#include "frame/renderer.h"
#include "raster/stage/geometry.h"

#include <optional>
#include <span>
#include <vector>

namespace scanout::bench {

class Ours {
public:
    // The scene must outlive it.
    Ours(Jobs& jobs, const scene::Scene& scene, const Load& load, int width, int height);

    // Plan and frame, as a viewer does whose model turns.
    Result<void> draw(const scene::View& view);

    const image::Image& picture() const { return *picture_; } // of shaded loads
    // Of loads of depth alone: reversed, rows from the top.
    std::span<const float> depth() const { return depth_; }
    std::uint64_t triangles_drawn() const;

private:
    // The renderer always shades. What it runs before that, and writes in its passes of shadow
    // maps, is here by itself: geometry, then the tiles' depths copied to a frame of floats, of
    // which, as in a picture, tiles are left alone that were empty and are.
    void draw_depth(const scene::View& view);

    Jobs& jobs_;
    const scene::Scene& scene_;
    bool depth_only_;
    frame::FrameOptions options_;
    frame::PlanCache plan_;
    frame::Renderer renderer_;
    const image::Image* picture_ = nullptr;
    raster::Geometry geometry_;
    raster::OcclusionHistory occlusion_;
    std::vector<raster::VisibilityTile> tiles_;       // one a worker
    std::vector<raster::DeferredTriangles> deferred_; // scratch, one a worker
    LargeArray<float> scratch_;
    std::span<float> depth_; // in that, from the start of a line of the cache
    frame::ClearedTiles cleared_;
};

} // namespace scanout::bench
