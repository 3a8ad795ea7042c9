// The reference: a picture by rays in double precision, against which every rung of the renderer is
// measured. It shares no code with raster, shade and frame, and holds nothing back for speed but
// samples: a pixel gets 16 to 4096, stratified, until its estimated error is under a quarter of a
// code. The same bits on every instruction set and number of threads.
//
// The error of a pixel is estimated from four parts of its samples, each a stratified set by
// itself: three quarters of the standard deviation of their means, which few parts may put too low,
// and no less than what such a set errs where an edge divides the range of light that its samples
// found.
#pragma once

#include "base/jobs.h"
#include "base/result.h"
#include "image/image.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "trace/look.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace scanout::trace {

struct Reference {
    image::Image image;
    std::vector<Vec3> light;  // of each pixel: linear, mixed with the background
    std::vector<float> error; // of each pixel: standard error, codes, of the worst channel
    std::uint64_t samples = 0;
    double mean_error() const;  // root of the mean square: the reference's own noise, codes
    std::size_t unsure() const; // pixels whose estimate is a quarter of a code or more
};

inline constexpr std::uint32_t kFewestSamples = 16, kMostSamples = 4096; // a pixel
inline constexpr std::uint32_t kSamplesOnceMore = 1024; // of a pixel that has a hard neighbour
inline constexpr double kErrorWanted = 0.25;            // codes

// How much is spent on a pixel that is hard. Fewer samples leave more noise, which the errors say.
struct Effort {
    std::uint32_t most_samples = kMostSamples; // a power of two from kFewestSamples to kMostSamples
    // An estimate of every pixel before the hard ones are settled, for those who watch: it costs
    // kFewestSamples samples more of each of these.
    bool estimate_first = false;
};

// progress(fraction) is called by the calling thread alone. Fails where the look names what there
// is not, and where memory does not suffice. Lines and points of the scene are left out.
Result<Reference> render(const scene::Scene& scene, const scene::View& view, const Look& look,
                         Jobs& jobs, const std::function<void(double)>& progress = {},
                         const Effort& effort = {});

} // namespace scanout::trace
