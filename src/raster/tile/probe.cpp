#include "raster/tile/probe.h"

namespace scanout::raster {

void Probe::reset(const VisibilityTile& front) {
    front_ = &front;
    copy_ = front;
    drawn_ = {};
}

image::Rect Probe::draw(const Geometry& geometry, std::uint32_t triangle) {
    if (!drawn_.empty()) copy_.take(*front_, drawn_);
    id_ = triangle;
    drawn_ = geometry.draw_one(triangle, copy_);
    return drawn_;
}

} // namespace scanout::raster
