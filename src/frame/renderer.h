// render(): scene + view + plan -> back buffer. Owns the frame's buffers, which live from frame to
// frame; the picture does not depend on the number of threads.
#pragma once

#include "base/jobs.h"
#include "frame/plan/plan.h"
#include "image/image.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "shade/resolve/linear_picture.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace scanout::frame {

// Statistics of the last frame. Milliseconds of wall time: geometry is transform to bin, tiles is
// coverage to back buffer.
struct FrameStats {
    double total_ms = 0, geometry_ms = 0, tiles_ms = 0;
    double shadow_ms = 0;                  // of geometry_ms: shadow maps, volumes
    std::uint64_t triangles_submitted = 0; // of the mesh
    std::uint64_t triangles_drawn = 0;     // left after clipping and culling
    std::uint64_t items_shaded = 0;
    std::uint64_t fragments_blended = 0; // triangles in pixels, in front of the opaque surface
    std::size_t transparency_bytes = 0;  // held for cut-outs and blending
    // The part of transparency_bytes for the longest list of blended fragments that a part of a
    // tile needed; each worker that meets such a part holds as much. Independent of threads and
    // tile order.
    std::size_t blend_list_bytes = 0;
    std::uint64_t shadow_bytes = 0;     // held by the shadow pass
    std::uint64_t occlusion_bytes = 0;  // held by ambient occlusion; 0 where there is none
    std::uint64_t stencil_bytes = 0;    // held; 0 where nothing is marked
    std::uint64_t annotation_bytes = 0; // held; 0 where nothing is drawn over the shading
    std::uint64_t mipmap_bytes = 0;     // held; 0 where no texture is minified
    std::uint64_t splat_bytes = 0;      // held for filters that reach into neighbours; 0 without
};

// Visibility at every sample of a frame: [(sample * height + y) * width + x]. With supersampling,
// of every shaded pixel; with areas, at the pixel's centre.
struct Visibility {
    int width = 0, height = 0, samples = 0;
    std::vector<std::uint32_t> id; // primitive, or raster::kNoPrimitive
    std::vector<float> depth;      // reversed; 0 where no primitive is visible
};

class Renderer {
public:
    explicit Renderer(Jobs& jobs);
    ~Renderer();

    // The picture stays valid until the next call. tile_size: 8, 16, 32 or 64; it changes no bit.
    const image::Image& render(const scene::Scene& scene, const scene::View& view,
                               const FramePlan& plan, Visibility* visibility = nullptr,
                               int tile_size = 64, shade::LinearPicture* linear = nullptr);
    const FrameStats& stats() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace scanout::frame
