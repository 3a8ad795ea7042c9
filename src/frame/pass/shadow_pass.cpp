#include "frame/pass/shadow_pass.h"

#include "base/check.h"
#include "base/memory.h"
#include "math/rotation.h"

#include <algorithm>
#include <array>

namespace scanout::frame {
namespace {

using raster::VisibilityTile;

ViewPlane in_view(const ShadowPlane& of_mesh, const scene::View& view) {
    ViewPlane plane;
    plane.normal = normalized(view.normal * of_mesh.normal);
    const DVec3 point = view.linear * (of_mesh.normal * of_mesh.offset) + view.translation;
    plane.offset = -dot3(plane.normal, point);
    return plane;
}

// For each triangle, 1 where it casts a shadow; a cut-out one casts the shadow of all its area.
std::vector<std::uint8_t> casting(const geom::Mesh& mesh,
                                  std::span<const raster::AlphaMode> modes) {
    std::vector<std::uint8_t> casts(mesh.triangles(), 1);
    for (std::size_t i = 0; i < casts.size() && !modes.empty(); ++i)
        casts[i] =
            modes[static_cast<std::size_t>(mesh.material[i] + 1)] != raster::AlphaMode::nothing;
    return casts;
}

} // namespace

void ShadowPass::find_casters(const scene::Scene& scene, const ShadowPlan& plan, bool projected) {
    const std::optional<ShadowPlane> plane = projected ? std::optional(plan.plane) : std::nullopt;
    if (scene.mesh_revision() != 0 && casters_.revision == scene.mesh_revision() &&
        casters_.plane == plane && casters_.alpha_modes == plan.casters)
        return;
    const geom::Mesh& mesh = scene.mesh;
    casters_ = {};
    casters_.revision = scene.mesh_revision();
    casters_.alpha_modes = plan.casters;
    casters_.plane = plane;
    casters_.casts = casting(mesh, plan.casters);
    if (!projected) {
        casters_.welded = weld(mesh, casters_.casts);
        return;
    }
    casters_.receives = in_shadow_plane(mesh, *plane);
    for (std::size_t i = 0; i < casters_.casts.size(); ++i) // the plane's own triangles cast none
        if (casters_.receives[i] != 0) casters_.casts[i] = 0;
}

void ShadowPass::run(const ShadowScene& in, const raster::ScreenTransform& transform,
                     const ScreenTiles& grid, FrameLights& lights) {
    CHECK(in.plan.shadow.stage != nullptr);
    const shade::ShadowStage& stage = *in.plan.shadow.stage;
    const bool volume = stage.by == shade::ShadowBy::volumes,
               projected = stage.by == shade::ShadowBy::projection;
    const std::size_t count = lights.lights().size();
    maps_.clear();
    lights_.assign(count, {});
    areas_ = grid.areas;
    if (volume || projected) {
        polygons_.resize(count);
        find_casters(in.scene, in.plan.shadow, projected);
    } else {
        release(polygons_);
        release(edges_);
        casters_ = {};
    }
    const ViewPlane plane = projected ? in_view(in.plan.shadow.plane, in.view) : ViewPlane();
    std::array<std::size_t, scene::kMaxLights + 1> first_map{};
    for (std::size_t k = 0; k < count; ++k) {
        const scene::ViewLight& light = lights.lights()[k];
        first_map[k + 1] = maps_.maps().size();
        if (!light.casts) {
            if (!polygons_.empty()) polygons_[k] = {};
            continue;
        }
        lights.set_varies(k);
        shade::LightShadow& shadow = lights_[k];
        shadow.casts = true;
        shadow.shape = light.shape;
        shadow.soft = stage.soft && light.size > 0;
        shadow.inner = in.plan.shadow.inner[light.source];
        const ShadowCaster caster{in.scene.mesh, casters_.casts, light,       in.view,
                                  transform,     grid,           shadow.inner};
        if (volume)
            shadow_volumes(caster, casters_.welded, edges_, polygons_[k]);
        else if (projected)
            projected_shadows(caster, plane, polygons_[k]);
        else
            maps_.add(in, light, in.plan.options.shadow_size, shadow.soft);
        first_map[k + 1] = maps_.maps().size();
    }
    for (std::size_t k = 0; k < count; ++k)
        lights_[k].maps = maps_.maps().subspan(first_map[k], first_map[k + 1] - first_map[k]);
}

const shade::TileShadow* ShadowPass::count(int tile, int worker, const VisibilityTile& visible) {
    if (polygons_.empty()) return nullptr;
    const std::size_t size = VisibilityTile::kPlane * static_cast<std::size_t>(visible.samples());
    std::vector<float>& counts = counts_[static_cast<std::size_t>(worker)];
    counts.assign(size * polygons_.size(), 0.0F);
    shade::TileShadow& made = tiles_[static_cast<std::size_t>(worker)];
    made = {};
    made.tile = &visible;
    made.areas = areas_;
    made.receives = casters_.receives;
    for (std::size_t k = 0; k < polygons_.size(); ++k) {
        if (!lights_[k].casts) continue;
        float* planes = counts.data() + size * k;
        polygons_[k].count(tile, visible, planes);
        made.count[k] = planes;
        made.polygons[k] = polygons_[k].in_tile(tile);
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
