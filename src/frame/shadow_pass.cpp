#include "frame/shadow_pass.h"

#include "base/check.h"
#include "math/rotation.h"

#include <algorithm>
#include <string_view>

namespace scanout::frame {
namespace {

using raster::VisibilityTile;

ViewPlane in_view(const Ground& ground, const scene::View& view) {
    DVec3 axis(0), point(0);
    axis[ground.axis] = ground.high ? -1 : 1; // to the inside
    point[ground.axis] = ground.at;
    ViewPlane plane;
    plane.normal = normalized(view.normal * axis);
    plane.offset = -dot3(plane.normal, view.linear * point + view.translation);
    return plane;
}

} // namespace

void ShadowPass::run(Jobs& jobs, const scene::Scene& scene, const scene::View& view,
                     const FramePlan& plan, const raster::ScreenTransform& transform,
                     const TileGrid& grid, FrameLights& lights) {
    CHECK(plan.shadow != nullptr);
    const std::string_view technique = plan.shadow->card.name;
    const bool volume = technique == "volume", projected = technique == "projected";
    const std::size_t count = lights.lights().size();
    maps_.clear();
    polygons_.clear();
    receives_.clear();
    lights_.assign(count, {});
    if (volume || projected) polygons_.resize(count);
    const Welded welded = volume ? weld(scene.mesh) : Welded();
    if (projected) receives_ = in_ground(scene.mesh, plan.ground);
    std::vector<std::size_t> first_map(count + 1, 0);
    for (std::size_t k = 0; k < count; ++k) {
        const scene::ViewLight& light = lights.lights()[k];
        first_map[k + 1] = maps_.maps().size();
        if (!light.casts) continue;
        lights.set_varies(k);
        shade::LightShadow& shadow = lights_[k];
        shadow.casts = true;
        shadow.shape = light.shape;
        shadow.soft = technique == "map_soft" && light.size > 0;
        if (volume)
            polygons_[k] = shadow_volumes(scene.mesh, welded, light, view, transform, grid);
        else if (projected)
            polygons_[k] = projected_shadows(scene.mesh, in_view(plan.ground, view), receives_,
                                             light, view, transform, grid);
        else
            maps_.add(jobs, scene, view, light, plan.options.shadow_size, shadow.soft);
        first_map[k + 1] = maps_.maps().size();
    }
    for (std::size_t k = 0; k < count; ++k)
        lights_[k].maps = maps_.maps().subspan(first_map[k], first_map[k + 1] - first_map[k]);
}

const shade::TileShadow* ShadowPass::count(int tile, int worker, const VisibilityTile& seen) {
    if (polygons_.empty()) return nullptr;
    const std::size_t size = VisibilityTile::kPlane * static_cast<std::size_t>(seen.samples());
    std::vector<float>& counts = counts_[static_cast<std::size_t>(worker)];
    counts.assign(size * polygons_.size(), 0.0F);
    shade::TileShadow& made = tiles_[static_cast<std::size_t>(worker)];
    made = {};
    made.tile = &seen;
    made.receives = receives_;
    for (std::size_t k = 0; k < polygons_.size(); ++k) {
        if (!lights_[k].casts) continue;
        float* planes = counts.data() + size * k;
        polygons_[k].count(tile, seen, planes);
        made.count[k] = planes;
    }
    return &made;
}

std::size_t ShadowPass::bytes() const {
    std::size_t bytes = maps_.bytes();
    for (const ShadowPolygons& polygons : polygons_)
        bytes += polygons.bytes();
    return bytes;
}

} // namespace scanout::frame
