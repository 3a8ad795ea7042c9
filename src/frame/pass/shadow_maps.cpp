#include "frame/pass/shadow_maps.h"

#include "scene/uv_step.h"

#include <algorithm>

namespace scanout::frame {
namespace {

// Empty texels around the shadow casters: for the widest filter, and for penumbrae
// (shade/shadow/map_soft.cpp).
constexpr int kMargin = 8, kSoftMargin = 64;
static_assert(kMaxShadowFilter <= shade::kMaxFilter);

// unit: the factor of positions and of the light (scene::to_floats).
shade::ShadowMap map_of(const LightView& from, const scene::ViewLight& light, double unit) {
    shade::ShadowMap map;
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c)
            map.rotation[r][c] = static_cast<float>(from.rotation[c][r]);
        map.translation[r] = static_cast<float>(from.translation[r] * unit);
    }
    const scene::View& view = from.view;
    map.perspective = view.projection == scene::Projection::perspective;
    // Scales are by angle in perspective, else by length.
    const double length = map.perspective ? 1 : unit;
    const double scale_x = from.texels_x / length, scale_y = from.texels_y / length;
    const double depth_scale =
        map.perspective ? view.near_distance * unit : view.depth_scale / unit;
    map.scale_x = static_cast<float>(scale_x);
    map.scale_y = static_cast<float>(scale_y);
    map.depth_scale = static_cast<float>(depth_scale);
    if (!map.perspective)
        map.depth_offset = static_cast<float>(-view.depth_origin * view.depth_scale);
    map.size = from.size;
    map.half = static_cast<float>(from.half);
    // A light of radius r over a blocker at distance b spreads the shadow at distance d by
    // r (1/b - 1/d) of an angle's tangent; a parallel one by its own tangent times d - b.
    const double spread = light.size / depth_scale;
    map.soft_x = static_cast<float>(spread * scale_x);
    map.soft_y = static_cast<float>(spread * scale_y);
    return map;
}

// The input of the pass that finds the alpha of cut-out triangles at the map's texels.
shade::TransparencyInput transparency_input(const FramePlan& plan) {
    const TransparencyPlan& alpha = plan.transparency;
    shade::TransparencyInput transparency;
    transparency.alpha = alpha.alpha;
    transparency.stages = alpha.stages;
    transparency.frame.attributes = alpha.attributes;
    transparency.frame.filter = alpha.filter;
    transparency.frame.mapped = plan.mapped;
    transparency.cut = static_cast<float>(plan.options.alpha_cut);
    return transparency;
}

} // namespace

void ShadowMaps::clear() {
    depths_.resize(maps_.size()); // frees those that the last frame did not need
    maps_.clear();
}

std::size_t ShadowMaps::bytes() const {
    std::size_t bytes = 0;
    for (std::size_t i = 0; i < maps_.size(); ++i)
        bytes += depths_[i].depth.size() * sizeof(float);
    return bytes;
}

void ShadowMaps::add(const ShadowScene& in, const scene::ViewLight& light, int size, bool soft) {
    const int margin = std::min(soft ? kSoftMargin : kMargin, size / 4);
    light_views(light, in.scene.mesh, in.view, size, margin, views_);
    for (const LightView& from : views_) {
        maps_.push_back(map_of(from, light, to_floats(in.view)));
        if (depths_.size() < maps_.size()) depths_.emplace_back();
        Depths& drawn = depths_[maps_.size() - 1];
        draw(in, from, in.plan.shadow.in_maps[light.source], drawn);
        const LargeArray<float>& depth = drawn.depth;
        maps_.back().depth = depth.data(); // stays where it is when depths_ grows
        if (soft) maps_.back().nearest = *std::max_element(depth.begin(), depth.end());
    }
}

void ShadowMaps::draw(const ShadowScene& in, const LightView& from, raster::Facing keep,
                      Depths& out) {
    const auto side = static_cast<std::size_t>(from.size);
    if (out.depth.size() != side * side) out.depth = LargeArray<float>(side * side);
    const raster::ScreenTransform transform(from.view, from.size, from.size);
    raster::GeometryOptions options;
    options.width = options.height = from.size;
    options.keep = keep;
    options.mirrored = in.view.mirrored;
    options.triangles_only = true;
    options.alpha_modes = in.plan.shadow.casters;
    if (options.alpha_modes.empty()) options.occlusion = &out.occlusion;
    geometry_.run(in.jobs, in.scene.mesh, transform, options);
    out.cleared.begin({from.size, from.size, options.tile_size, geometry_.tiles(), {}});
    shade::TransparencyInput transparency = transparency_input(in.plan);
    transparency.frame.exact_uv = !in.scene.mesh.exact_uv.empty();
    const std::vector<DVec2> uv_steps =
        transparency.frame.exact_uv ? scene::uv_steps(in.scene.materials) : std::vector<DVec2>();
    shade::GatherInput gather;
    gather.mesh = &in.scene.mesh;
    gather.geometry = &geometry_;
    gather.transform = &transform;
    gather.set_view(from.view);
    gather.materials = in.scene.materials;
    gather.unnamed = &in.scene.unnamed;
    gather.textures = in.scene.textures;
    gather.mips = &in.mips;
    gather.wrap = in.plan.wrap;
    gather.uv_steps = uv_steps;
    gather.frame = &transparency.frame;
    gather.transparency = &transparency;
    in.jobs.for_each(geometry_.tiles(), [&](int number, int worker_number) {
        const image::Rect area = geometry_.tile_area(number);
        const auto row = [&](int y) {
            return out.depth.data() + static_cast<std::size_t>(y) * side + area.x0;
        };
        const bool empty = geometry_.is_empty(number);
        if (empty && !out.cleared.is_cleared(number))
            for (int y = area.y0; y < area.y1; ++y)
                std::fill_n(row(y), area.width(), 0.0F);
        out.cleared.set_cleared(number, empty);
        if (empty) return;
        Worker& worker = workers_[static_cast<std::size_t>(worker_number)];
        raster::VisibilityTile& tile = worker.tile;
        const bool cut = !in.plan.shadow.casters.empty(); // texels need their triangles' ids
        tile.reset(area, 1, {},
                   cut ? raster::TileFormat::depth_and_id : raster::TileFormat::depth_only);
        geometry_.draw_triangles(number, tile, &worker.deferred);
        if (cut) {
            if (worker.transparency == nullptr)
                worker.transparency = std::make_unique<shade::TransparencyPass>();
            worker.transparency->cut_out(geometry_, number, gather, tile);
        }
        const std::span<const float> seen = tile.depths(0);
        for (int y = area.y0; y < area.y1; ++y)
            std::copy_n(seen.data() + (y - area.y0) * raster::kTileSize, area.width(), row(y));
    });
}

} // namespace scanout::frame
