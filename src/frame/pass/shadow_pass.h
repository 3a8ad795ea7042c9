// The shadow pass: shadow maps, drawn before the tiles, or shadow polygons (volumes, projected
// shadows), counted with each tile. A frame whose plan runs no shadow stage has none.
#pragma once

#include "base/jobs.h"
#include "frame/pass/lights.h"
#include "frame/pass/shadow_maps.h"
#include "frame/pass/shadow_polygons.h"
#include "frame/plan/plan.h"
#include "scene/scene.h"
#include "shade/shadow.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace scanout::frame {

class ShadowPass {
public:
    explicit ShadowPass(int threads)
        : maps_(threads), counts_(static_cast<std::size_t>(threads)),
          tiles_(static_cast<std::size_t>(threads)) {}
    // Afterwards lights that cast shadows vary from item to item. The scene must outlive the frame.
    void run(const ShadowScene& in, const raster::ScreenTransform& transform,
             const ScreenTiles& grid, FrameLights& lights);
    std::span<const shade::LightShadow> lights() const { return lights_; }
    // Stencil counts of a tile's samples, which the shadow stage reads; null where the plan's
    // technique reads maps. The result is valid until the worker's next call.
    const shade::TileShadow* count(int tile, int worker, const raster::VisibilityTile& visible);
    // The bytes of maps and polygons, without the planes in which workers count.
    std::size_t bytes() const;

private:
    // Depends on the scene and the plan, not on the view or the lights: cached while the scene's
    // mesh_revision is the same (0: never).
    struct Casters {
        std::uint64_t revision = 0;
        std::vector<raster::AlphaMode> alpha_modes;
        std::optional<ShadowPlane> plane;          // of projected shadows
        std::vector<std::uint8_t> casts, receives; // by triangle; empty: all receive
        Welded welded;                             // of volumes
    };
    void find_casters(const scene::Scene& scene, const ShadowPlan& plan, bool projected);

    ShadowMaps maps_;
    std::vector<ShadowPolygons> polygons_; // of each light; empty where maps are read
    Casters casters_;
    bool areas_ = false;            // ScreenTiles
    std::vector<ShadowEdge> edges_; // scratch
    std::vector<shade::LightShadow> lights_;
    std::vector<std::vector<float>> counts_; // of each worker
    std::vector<shade::TileShadow> tiles_;
};

} // namespace scanout::frame
