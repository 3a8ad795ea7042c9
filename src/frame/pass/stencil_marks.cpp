#include "frame/pass/stencil_marks.h"

#include <algorithm>

namespace scanout::frame {

void mark_visible(const raster::VisibilityTile& tile,
                  const shade::TransparencyPass::Pixels* blended, int scale, StencilBuffer& out) {
    const image::Rect& area = tile.area();
    for (int y = area.y0; y < area.y1; ++y) {
        const auto row = out.row(y / scale);
        const auto in_tile = static_cast<std::size_t>(y - area.y0);
        const std::uint64_t bits = blended == nullptr ? 0 : (*blended)[in_tile];
        for (int x = area.x0; x < area.x1; ++x) {
            bool shown = (bits >> (x - area.x0) & 1) != 0;
            for (int s = 0; s < tile.samples(); ++s)
                shown = shown || tile.id(x, y, s) != raster::kNoPrimitive;
            if (shown) row[static_cast<std::size_t>(x / scale)] = 1;
        }
    }
}

void mark_visible(raster::AreaTile& tile, StencilBuffer& out) {
    const image::Rect& area = tile.area();
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x)
            if (!tile.fragments(x, y).empty()) out.row(y)[static_cast<std::size_t>(x)] = 1;
}

// Draws the triangles in the order of their ids, each over all before it: after each draw, the
// pixels with its id are the pixels it covers. The coverage is the picture's, to the sample.
void count_covering(const raster::Geometry& geometry, int tile, raster::VisibilityTile& scratch,
                    raster::DepthRule rule, raster::Geometry::ById& order, StencilBuffer& out) {
    rule.test = raster::DepthTest::always;
    scratch.reset(geometry.tile_area(tile), 1, rule);
    geometry.draw_each(tile, scratch, order, [&](std::uint32_t id, const image::Rect& box) {
        for (int y = box.y0; y < box.y1; ++y) {
            const auto row = out.row(y);
            for (int x = box.x0; x < box.x1; ++x) {
                std::uint8_t& count = row[static_cast<std::size_t>(x)];
                if (scratch.id(x, y) == id && count < 255) ++count;
            }
        }
    });
}

void show_marks(Jobs& jobs, const Stencil& stencil, const StencilBuffer& marks,
                image::Image& picture) {
    constexpr int kRows = 16;
    jobs.for_each((marks.height() + kRows - 1) / kRows, [&](int band, int) {
        const int end = std::min((band + 1) * kRows, marks.height());
        for (int y = band * kRows; y < end; ++y)
            stencil.show(marks, y, picture);
    });
}

} // namespace scanout::frame
