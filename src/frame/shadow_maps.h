// The pass that draws shadow maps: the depth of the scene's triangles as each light that casts sees
// them, by the same geometry and coverage as the picture. Williams 1978, [C 10].
#pragma once

#include "base/jobs.h"
#include "frame/light_view.h"
#include "raster/geometry.h"
#include "scene/scene.h"
#include "shade/shadow.h"

#include <vector>

namespace scanout::frame {

class ShadowMaps {
public:
    explicit ShadowMaps(int threads) : tiles_(static_cast<std::size_t>(threads)) {}
    // Appends the light's maps; what pointed to those of other lights is void.
    void add(Jobs& jobs, const scene::Scene& scene, const scene::View& view,
             const scene::ViewLight& light, int size, bool soft);
    void clear();
    std::span<const shade::ShadowMap> maps() const { return maps_; }
    std::size_t bytes() const;

private:
    void draw(Jobs& jobs, const geom::Mesh& mesh, const LightView& from, std::vector<float>& depth);

    raster::Geometry geometry_;
    std::vector<raster::VisibilityTile> tiles_; // one a worker
    std::vector<shade::ShadowMap> maps_;
    std::vector<std::vector<float>> depths_; // of the maps
};

} // namespace scanout::frame
