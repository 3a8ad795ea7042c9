// The reference: a picture by rays in double precision, against which every rung of the renderer is
// measured. It shares no code with raster, shade and frame, and holds nothing back for speed but
// samples: a pixel gets 16 to 4096, stratified, until its estimated error is under a quarter of a
// code. The same bits on every instruction set and number of threads.
//
// The error of a pixel is estimated from sixteen parts of its samples (noise.h), and is no less
// than what may hide between two samples of the range of light that they found. A few samples may
// miss an edge altogether: pixels that saw little beside some that saw much are traced once more,
// of more samples, and so on along the edge.
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
    std::vector<Vec3> light; // of each pixel: linear, mixed with the background
    // Of each pixel, codes, of the worst channel: kMargin standard errors, which bound the real
    // error in nine pixels of ten.
    std::vector<float> error;
    std::uint64_t samples = 0;
    double noise = 0;           // of the whole: root of the mean square of what pixels err, codes
    std::size_t unsure() const; // pixels whose bound is a quarter of a code or more
};

inline constexpr std::uint32_t kFewestSamples = 16, kMostSamples = 4096; // a pixel
inline constexpr std::uint32_t kSamplesOnceMore = 1024; // of a pixel that has a hard neighbour
inline constexpr double kErrorWanted = 0.25;            // codes
inline constexpr double kMargin = 1.5; // an estimate may be too low, and stops the sampling then

// How much is spent on a pixel that is hard. Fewer samples leave more noise, which the errors say.
struct Effort {
    std::uint32_t most_samples = kMostSamples; // a power of two from kFewestSamples to kMostSamples
    // An estimate of every pixel before the hard ones are settled, for those who watch: it costs
    // kFewestSamples samples more of each of these.
    bool estimate_first = false;
    // Pictures of other seeds have other noise, of the same size: so it can be measured.
    int seed = 0;
};

// progress(fraction) is called by the calling thread alone. Fails where the look names what there
// is not, and where memory does not suffice. Lines and points of the scene are left out.
Result<Reference> render(const scene::Scene& scene, const scene::View& view, const Look& look,
                         Jobs& jobs, const std::function<void(double)>& progress = {},
                         const Effort& effort = {});

} // namespace scanout::trace
