// Everything that a frame's shadows need beside their stage: maps before the tiles, or polygons
// that are counted with each tile. There is none in a frame whose plan runs no shadow stage.
#pragma once

#include "base/jobs.h"
#include "frame/lights.h"
#include "frame/plan.h"
#include "frame/shadow_maps.h"
#include "frame/shadow_polygons.h"
#include "scene/scene.h"
#include "shade/shadow.h"

#include <cstddef>
#include <span>
#include <vector>

namespace scanout::frame {

class ShadowPass {
public:
    explicit ShadowPass(int threads)
        : maps_(threads), counts_(static_cast<std::size_t>(threads)),
          tiles_(static_cast<std::size_t>(threads)) {}
    // Lights that cast vary from then on. The scene must outlive the frame.
    void run(const ShadowScene& in, const raster::ScreenTransform& transform, const TileGrid& grid,
             FrameLights& lights);
    std::span<const shade::LightShadow> lights() const { return lights_; }
    // Counts over a tile's samples, for the stage; null where the plan's technique reads maps. The
    // result is the worker's until its next call.
    const shade::TileShadow* count(int tile, int worker, const raster::VisibilityTile& seen);
    // Of maps and polygons; what each worker counts in for one tile is not in it.
    std::size_t bytes() const;

private:
    ShadowMaps maps_;
    std::vector<ShadowPolygons> polygons_;       // of each light; empty where maps are read
    std::vector<std::uint8_t> casts_, receives_; // by triangle
    std::vector<shade::LightShadow> lights_;
    std::vector<std::vector<float>> counts_; // of each worker
    std::vector<shade::TileShadow> tiles_;
};

} // namespace scanout::frame
