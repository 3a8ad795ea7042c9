#include "frame/shadow_maps.h"

#include <algorithm>

namespace scanout::frame {
namespace {

// Texels around what throws shadows: the widest filter, and penumbrae (shade/shadow/map_soft.cpp).
constexpr int kMargin = 8, kSoftMargin = 64;

shade::ShadowMap map_of(const LightView& from, const scene::ViewLight& light) {
    shade::ShadowMap map;
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c)
            map.turn[r][c] = static_cast<float>(from.turn[c][r]);
        map.move[r] = static_cast<float>(from.move[r]);
    }
    const scene::View& view = from.view;
    map.perspective = view.projection == scene::Projection::perspective;
    map.scale_x = static_cast<float>(from.texels_x);
    map.scale_y = static_cast<float>(from.texels_y);
    const double depth_scale = map.perspective ? view.near_distance : view.depth_scale;
    map.depth_scale = static_cast<float>(depth_scale);
    if (!map.perspective)
        map.depth_offset = static_cast<float>(-view.depth_origin * view.depth_scale);
    map.size = from.size;
    map.half = static_cast<float>(from.half);
    // A light of radius r over a blocker at distance b spreads the shadow at distance d by
    // r (1/b - 1/d) of an angle's tangent; a parallel one by its own tangent times d - b.
    const double spread = light.size / (map.perspective ? view.near_distance : view.depth_scale);
    map.soft_x = static_cast<float>(spread * from.texels_x);
    map.soft_y = static_cast<float>(spread * from.texels_y);
    return map;
}

} // namespace

void ShadowMaps::clear() {
    maps_.clear();
    depths_.clear();
}

std::size_t ShadowMaps::bytes() const {
    std::size_t bytes = 0;
    for (const std::vector<float>& depth : depths_)
        bytes += depth.size() * sizeof(float);
    return bytes;
}

void ShadowMaps::add(Jobs& jobs, const scene::Scene& scene, const scene::View& view,
                     const scene::ViewLight& light, int size, bool soft) {
    const int margin = std::min(soft ? kSoftMargin : kMargin, size / 4);
    for (const LightView& from : light_views(light, scene.mesh, view, size, margin)) {
        maps_.push_back(map_of(from, light));
        std::vector<float>& depth = depths_.emplace_back();
        draw(jobs, scene.mesh, from, depth);
        maps_.back().depth = depth.data(); // stays where it is when depths_ grows
        if (soft) maps_.back().nearest = *std::max_element(depth.begin(), depth.end());
    }
}

void ShadowMaps::draw(Jobs& jobs, const geom::Mesh& mesh, const LightView& from,
                      std::vector<float>& depth) {
    const auto side = static_cast<std::size_t>(from.size);
    depth.resize(side * side);
    const raster::ScreenTransform transform(from.view, from.size, from.size);
    raster::GeometryOptions options;
    options.width = options.height = from.size;
    options.triangles_only = true;
    geometry_.run(jobs, mesh, transform, options);
    jobs.for_each(geometry_.tiles(), [&](int number, int worker) {
        raster::VisibilityTile& tile = tiles_[static_cast<std::size_t>(worker)];
        const image::Rect area = geometry_.tile_area(number);
        tile.reset(area, 1);
        geometry_.draw(number, tile);
        const std::span<const float> seen = tile.depths(0);
        for (int y = area.y0; y < area.y1; ++y) {
            const float* row = seen.data() + (y - area.y0) * raster::kTileSize;
            std::copy_n(row, area.x1 - area.x0,
                        depth.data() + static_cast<std::size_t>(y) * side + area.x0);
        }
    });
}

} // namespace scanout::frame
