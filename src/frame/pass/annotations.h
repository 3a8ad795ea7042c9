// Annotations: lines over the shading that show how the model is built. They
// are lines of a mesh of their own, drawn by the rules of the file's lines
// (raster/tile/lines.cpp): a line on a face is visible wherever the face is, a
// line behind a face is hidden. The pass exists only while a plan draws any.
#pragma once

#include "base/jobs.h"
#include "frame/plan/plan.h"
#include "raster/stage/geometry.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "shade/gather/added_lines.h"

#include <cstdint>
#include <optional>
#include <span>

namespace scanout::frame {

class AnnotationPass {
public:
    // Makes the lines if the scene or the plan has others than before, then bins
    // them. `options` are those of the scene's geometry; scale: pixels of it a
    // pixel of the picture.
    void run(Jobs& jobs, const scene::Scene& scene, const FramePlan& plan, scene::UpAxis up,
             const raster::ScreenTransform& transform, const raster::GeometryOptions& options,
             int scale);
    bool has_lines(int tile) const { return geometry_.has_lines(tile); }
    // Draws into a tile that holds the scene's triangles as its support.
    void draw(int tile, const raster::Geometry& scene, raster::VisibilityTile& out) const;
    const shade::AddedLines& lines() const { return lines_; }
    std::uint64_t bytes() const;

private:
    void make(const scene::Scene& scene, const AnnotationPlan& plan, scene::UpAxis up);

    struct Key {
        std::uint64_t revision = 0; // of the scene's mesh
        AnnotationPlan plan;
        scene::UpAxis up = scene::UpAxis::plus_y;
        friend bool operator==(const Key&, const Key&) = default;
    };
    std::optional<Key> key_; // of the lines; nothing where none can be kept
    geom::Mesh mesh_;        // no triangles
    shade::AddedLines lines_;
    raster::Geometry geometry_;
    std::optional<raster::LineSupport::Winding> culled_;
    std::span<const std::uint8_t> one_sided_; // the plan's: faces of these alone are culled
};

} // namespace scanout::frame
