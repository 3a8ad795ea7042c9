// The pass of ambient occlusion (shade/ambient_occlusion.h): after the geometry stage and before
// shading, it holds what the centre of each pixel shows, of the whole frame, and finds the share of
// the light from everywhere that reaches it. One sample a pixel, by the default depth rule, however
// many samples and whatever depth the frame has; opaque surfaces alone, and cut-outs with their
// holes. A supersampled frame has as many of these pixels as it shades.
#pragma once

#include "base/jobs.h"
#include "base/large_array.h"
#include "frame/plan/plan.h"
#include "raster/tile/tile.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "shade/ambient_occlusion.h"

#include <cstdint>
#include <vector>

namespace scanout::frame {

class AmbientOcclusionPass {
public:
    // width, height: of the pixels that are shaded.
    void begin(Jobs& jobs, const scene::Scene& scene, const scene::View& view, int width,
               int height);
    // Takes what a tile of one sample a pixel shows; its triangles alone are drawn. Tiles may come
    // from several threads.
    void take(const raster::VisibilityTile& tile);
    void take_empty(const image::Rect& area);
    // When all tiles are there.
    void find(Jobs& jobs, const shade::AmbientOcclusion& technique);

    // Stays where it is.
    const shade::OcclusionImage& image() const { return image_; }
    std::uint64_t bytes() const;

private:
    void set_size(int width, int height);
    std::size_t at(int x, int y) const;

    shade::SurfaceImage surface_;
    shade::OcclusionImage image_;
    LargeArray<float> distance_, open_, between_;
    LargeArray<std::uint32_t> triangle_;
    std::vector<Vec3> normals_; // of the scene's triangles, of any length
    std::uint64_t revision_ = 0;
    bool perspective_ = true;
    double nearest_ = 0, origin_ = 0, per_depth_ = 0; // how depth tells a distance
};

} // namespace scanout::frame
