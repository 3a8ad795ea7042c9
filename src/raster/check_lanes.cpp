#include "raster/check_lanes.h"

#ifdef SCANOUT_CHECK_LANES
#include "base/check.h"

#include <cmath>
#include <string>
#include <string_view>
#include <utility>

namespace scanout::raster {
namespace {

[[noreturn]] void fail(const std::string& what) {
    check_failed(__FILE__, __LINE__, "every live lane is finite", what);
}

void check_depth(double depth, std::string_view of, std::size_t number, std::string_view stage) {
    if (!std::isfinite(depth))
        fail(fmt::format("depth of {} {} is {} after {}", of, number, depth, stage));
}

} // namespace

void check_before_snap(double x, double y, std::size_t vertex) {
    for (const auto& [name, value] : {std::pair("x", x), {"y", y}})
        if (!std::isfinite(value))
            fail(fmt::format("{} of vertex {} is {} before it snaps", name, vertex, value));
}

void check_before_rounding(const ClipVertex& v) {
    for (const auto& [name, value] : {std::pair("x", v.x), {"y", v.y}, {"w", v.w}})
        if (!std::isfinite(value))
            fail(fmt::format("{} of a clipped vertex is {} before rounding", name, value));
}

void check_lanes(std::span<const ScreenVertex> vertices) {
    constexpr double kMax = kGuardPixels * kSubpixel;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const ScreenVertex& v = vertices[i];
        if (!v.on_screen()) continue;
        CHECK_LE(std::abs(v.x), kMax);
        CHECK_LE(std::abs(v.y), kMax);
        check_depth(v.depth, "vertex", i, "transform");
    }
}

void check_lanes(const TriangleList& triangles) {
    for (std::size_t i = 0; i < triangles.which.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t at = triangles.index[std::size_t{triangles.which[i]} * 3 + k];
            check_depth(triangles.vertices[at].depth, "triangle", triangles.id[i], "set-up");
        }
}

void check_lanes(const BinnedList& list) {
    for (const BinnedTriangle& binned : list.triangles) {
        const std::uint32_t id = list.id_of(binned);
        check_lanes(TriangleList{list.vertices, list.index, {&binned.spatial_index, 1}, {&id, 1}});
        const image::Rect box = binned.box();
        CHECK_LE(box.x1, kTileSize);
        CHECK_LE(box.y1, kTileSize);
        if (!is_micro(list.kind)) continue;
        CHECK_LE(box.width(), kMicroSide);
        CHECK_LE(box.height(), kMicroSide);
        if (list.kind == SmallKind::micro_straddling) continue;
        CHECK_EQ(box.x0 / PixelBlock::kSide, (box.x1 - 1) / PixelBlock::kSide);
        CHECK_EQ(box.y0 / PixelBlock::kSide, (box.y1 - 1) / PixelBlock::kSide);
    }
}

void check_lanes(const ClippedTriangle& clipped) {
    for (const ExactPoint& v : clipped.vertex) {
        check_depth(v.z, "triangle", clipped.id, "set-up");
        check_depth(v.depth, "triangle", clipped.id, "set-up");
    }
}

void check_lanes(const Segment& segment) {
    for (const double depth : segment.depth)
        check_depth(depth, "line", segment.id, "set-up");
}

void check_lanes(const Point& point) {
    check_depth(point.depth, "point", point.id, "set-up");
}

void check_lanes(const VisibilityTile& tile) {
    const image::Rect& area = tile.area();
    for (int sample = 0; sample < tile.samples(); ++sample)
        for (int y = area.y0; y < area.y1; ++y)
            for (int x = area.x0; x < area.x1; ++x)
                check_depth(tile.depth(x, y, sample), "primitive",
                            tile.has_ids() ? tile.id(x, y, sample) : kNoPrimitive, "coverage");
}

void check_lanes(std::span<const AreaFragment> fragments) {
    for (const AreaFragment& f : fragments)
        if (!std::isfinite(f.coverage))
            fail(fmt::format("coverage of triangle {} is {} after its area", f.id, f.coverage));
}

} // namespace scanout::raster
#endif
