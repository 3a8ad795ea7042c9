#include "bench/peers/ours.h"

#include "base/memory.h"
#include "raster/tile/copy_depths.h"

#include <algorithm>
#include <memory>

namespace scanout::bench {

Ours::Ours(Jobs& jobs, const scene::Scene& scene, const Load& load, int width, int height)
    : jobs_(jobs), scene_(scene), depth_only_(load.shading == Shading::depth),
      options_(options_of(load, width, height)), plan_(frame::facts(scene)), renderer_(jobs),
      tiles_(static_cast<std::size_t>(jobs.threads())),
      deferred_(static_cast<std::size_t>(jobs.threads())) {}

Result<void> Ours::draw(const scene::View& view) {
    if (depth_only_) {
        draw_depth(view);
        return {};
    }
    TRY(const frame::FramePlan* const plan, plan_.plan(options_, view));
    picture_ = &renderer_.render(scene_, view, *plan);
    return {};
}

void Ours::draw_depth(const scene::View& view) {
    const auto width = static_cast<std::size_t>(options_.width);
    const std::size_t pixels = width * static_cast<std::size_t>(options_.height);
    if (depth_.size() != pixels) {
        constexpr std::size_t kLine = 64; // bytes
        scratch_ = LargeArray<float>(pixels + kLine / sizeof(float));
        void* begin = scratch_.data();
        std::size_t bytes = scratch_.size() * sizeof(float);
        std::align(kLine, pixels * sizeof(float), begin, bytes);
        depth_ = {static_cast<float*>(begin), pixels};
    }
    raster::GeometryOptions options;
    options.width = options_.width;
    options.height = options_.height;
    options.keep = options_.cull == frame::Cull::back ? raster::Facing::front : raster::Facing::any;
    options.mirrored = view.mirrored;
    options.occlusion = &occlusion_;
    geometry_.run(jobs_, scene_.mesh,
                  raster::ScreenTransform(view, options_.width, options_.height), options);
    cleared_.begin({options_.width, options_.height, raster::kTileSize, geometry_.tiles(), {}});
    jobs_.for_each(geometry_.tiles(), [&](int number, int worker) {
        const image::Rect area = geometry_.tile_area(number);
        const auto row = [&](int y) {
            return depth_.data() + static_cast<std::size_t>(y) * width + area.x0;
        };
        const bool empty = geometry_.is_empty(number);
        if (empty && !cleared_.is_cleared(number))
            for (int y = area.y0; y < area.y1; ++y)
                std::fill_n(row(y), area.width(), 0.0F);
        cleared_.set_cleared(number, empty);
        if (empty) return;
        raster::VisibilityTile& tile = tiles_[static_cast<std::size_t>(worker)];
        tile.reset(area, 1, {}, raster::TileFormat::depth_only);
        geometry_.draw_triangles(number, tile, &deferred_[static_cast<std::size_t>(worker)]);
        raster::copy_depths(tile, row(area.y0), width);
    });
}

std::uint64_t Ours::triangles_drawn() const {
    return depth_only_ ? geometry_.triangles_drawn() : renderer_.stats().triangles_drawn;
}

} // namespace scanout::bench
