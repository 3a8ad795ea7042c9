// What the hazards of a model do to its picture, in pixels: for a view, and for the worst of the 26
// framed ones. Counted in visibility buffers that the renderer draws, one sample a pixel, with
// everything opaque.
#pragma once

#include "base/jobs.h"
#include "base/result.h"
#include "frame/options.h"
#include "geom/diagnose/diagnosis.h"
#include "scene/scene.h"
#include "scene/view.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace scanout::measure {

inline constexpr std::size_t kHazards = static_cast<std::size_t>(geom::Hazard::small_triangles) + 1;

struct PixelsOfView {
    std::string view; // its name
    // Pixels whose nearest surface is a face with the hazard.
    std::array<std::int64_t, kHazards> shown{};
    // Pixels that show the background, or a surface more than kBehind farther away, where the
    // picture of the mended model shows a face.
    std::int64_t through = 0, background = 0;
    std::size_t small = 0; // triangles, no points, whose longest edge is below a pixel there
};
inline constexpr double kBehind = 0.01; // of the distance

struct HazardPixels {
    PixelsOfView here;
    std::vector<PixelsOfView> framed; // in the order of framed_views()
    double pixels_per_radius = 0;     // here, at the model's centre
};

struct HazardPixelsOptions {
    frame::FrameOptions frame; // its size, culling, depth
    scene::ModelTransform model;
    scene::CameraOptions camera;
    std::function<void(double)> progress; // the share that is done
};

// `marks`: by face of the file. `mended`: with T-vertices in their edges; null where there are
// none.
Result<HazardPixels> hazard_pixels(const scene::Scene& scene, const scene::Scene* mended,
                                   const std::vector<geom::HazardMask>& marks,
                                   const HazardPixelsOptions& how, Jobs& jobs);

// The smallest difference of distances, in bounding radii, that depth keeps at the model's centre.
double depth_step(const scene::View& view, const frame::FrameOptions& options);

} // namespace scanout::measure
