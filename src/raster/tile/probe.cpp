#include "raster/tile/probe.h"

#include <algorithm>

namespace scanout::raster {

void Probe::reset(const VisibilityTile& front, const image::Rect& region) {
    constexpr int kSide = 8; // tiles begin at multiples of it
    const auto down = [](int a) { return a / kSide * kSide; };
    const auto up = [&](int a, int limit) { return std::min(down(a + kSide - 1), limit); };
    const image::Rect& whole = front.area();
    front_ = &front;
    drawn_ = {down(region.x0), down(region.y0), up(region.x1, whole.x1), up(region.y1, whole.y1)};
    copy_.reset(drawn_, front.samples(), front.rule(),
                front.has_ids() ? TileFormat::depth_and_id : TileFormat::depth_only);
}

image::Rect Probe::draw(const Geometry& geometry, std::uint32_t triangle) {
    if (!drawn_.empty()) copy_.take(*front_, drawn_);
    id_ = triangle;
    drawn_ = geometry.draw_one(triangle, copy_);
    return drawn_;
}

} // namespace scanout::raster
