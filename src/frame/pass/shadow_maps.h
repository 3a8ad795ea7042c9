// The pass that draws shadow maps: the depth of the scene's triangles in the views of each light
// that casts shadows, by the same geometry and coverage as the picture. Williams 1978, [Primer 10].
#pragma once

#include "base/jobs.h"
#include "base/large_array.h"
#include "frame/cleared_tiles.h"
#include "frame/plan/plan.h"
#include "frame/view/light_view.h"
#include "raster/stage/geometry.h"
#include "scene/scene.h"
#include "shade/shadow.h"
#include "shade/transparency/transparency_pass.h"

#include <memory>
#include <vector>

namespace scanout::frame {

// The inputs of one frame's shadow casters. All that it refers to must outlive the frame.
struct ShadowScene {
    Jobs& jobs;
    const scene::Scene& scene;
    const scene::View& view;
    const FramePlan& plan;
    const shade::MipChains& mips;
};

class ShadowMaps {
public:
    explicit ShadowMaps(int threads) : workers_(static_cast<std::size_t>(threads)) {}
    // Appends the light's maps; spans of earlier maps become invalid.
    void add(const ShadowScene& in, const scene::ViewLight& light, int size, bool soft);
    void clear();
    std::span<const shade::ShadowMap> maps() const { return maps_; }
    std::size_t bytes() const;

private:
    struct Worker {
        raster::VisibilityTile tile;
        raster::DeferredTriangles deferred;                    // scratch
        std::unique_ptr<shade::TransparencyPass> transparency; // made when something is cut out
    };
    struct Depths {
        LargeArray<float> depth;
        ClearedTiles cleared; // of it
        raster::OcclusionHistory occlusion;
    };
    void draw(const ShadowScene& in, const LightView& from, raster::Facing keep, Depths& out);

    raster::Geometry geometry_;
    std::vector<Worker> workers_;
    std::vector<shade::ShadowMap> maps_;
    std::vector<Depths> depths_;   // one for each map; may hold the last frame's, for reuse
    std::vector<LightView> views_; // of the current light
};

} // namespace scanout::frame
