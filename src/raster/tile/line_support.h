// Line support: the triangles visible under lines and points. A line's pixel is visible at a sample
// when the line's own point there, not the sample beside it, is not behind the triangle that is
// visible at the sample (HARD-CASES 17).
#pragma once

#include "geom/mesh.h"
#include "raster/screen/screen.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace scanout::raster {

// The plane of a triangle's depth on the screen, a pixel, and the range of its depths.
struct DepthSlope {
    double per_x = 0, per_y = 0;
    double lowest = 0, highest = 1;
};

class LineSupport {
public:
    enum class Winding : std::uint8_t { counter_clockwise, clockwise };
    // Supports no line: all triangles are treated as touching none.
    LineSupport() = default;
    // The vertices of the mesh on the screen; all three must outlive the support.
    LineSupport(const geom::Mesh& mesh, std::span<const ScreenVertex> vertices,
                const ScreenTransform& transform)
        : mesh_(&mesh), lines_(&mesh), first_line_(static_cast<std::uint32_t>(mesh.triangles())),
          vertices_(vertices), transform_(&transform) {}
    // Supports the lines and points of another mesh, with ids from first_line on; their faces are
    // those of this one. hidden: which winding on the screen is culled of these; one_sided: 1 of
    // the default material, then of each, where it is. Empty: everywhere.
    LineSupport of(const geom::Mesh& lines, std::uint32_t first_line, std::optional<Winding> hidden,
                   std::span<const std::uint8_t> one_sided = {}) const {
        LineSupport other = *this;
        other.lines_ = &lines;
        other.first_line_ = first_line;
        other.hidden_ = hidden;
        other.one_sided_ = one_sided;
        return other;
    }

    enum class Contact : std::uint8_t {
        none,
        beside, // the triangle goes on where a face of the line ends
        holds   // the line, or the point, lies on the triangle's face or in its plane
    };
    // primitive: the id of a segment or a point.
    Contact contact(std::uint32_t triangle, std::uint32_t primitive) const;

    // Is the segment, by its id, part of culled faces alone?
    bool is_culled(std::uint32_t segment) const {
        return hidden_.has_value() && faces_are_culled(segment);
    }

    // The slope of the snapped triangle; of the unclipped triangle, where it leaves the screen.
    DepthSlope slope(std::uint32_t triangle) const;

    // Does the triangle, without its edges, contain the position (pixels)?
    bool covers(std::uint32_t triangle, double x, double y) const;

private:
    bool faces_are_culled(std::uint32_t segment) const;
    bool is_of(std::uint32_t triangle, std::span<const std::uint32_t> first) const;
    bool in_plane_of(std::uint32_t triangle, const Vec3& point) const;
    bool has_vertex_at(std::uint32_t triangle, const Vec3& point) const;
    bool continues(std::uint32_t triangle, std::uint32_t first,
                   const std::array<Vec3, 2>& end) const;
    // Vertices before the divide, in pixels times w; vertices on the screen as they were snapped.
    std::array<ClipVertex, 3> vertices_of(std::uint32_t triangle) const;

    const geom::Mesh* mesh_ = nullptr;
    const geom::Mesh* lines_ = nullptr; // whose lines and points they are
    std::uint32_t first_line_ = 0;      // the id of the first
    std::optional<Winding> hidden_;
    std::span<const std::uint8_t> one_sided_;
    std::span<const ScreenVertex> vertices_;
    const ScreenTransform* transform_ = nullptr;
};

} // namespace scanout::raster
