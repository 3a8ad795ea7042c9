#include "signal/synthesis.h"

#include "base/check.h"
#include "signal/grow.h"

#include <algorithm>

namespace scanout::signal {

int greatest_window(const image::Image& sample) {
    return std::min(sample.width(), sample.height());
}

int default_window(const image::Image& sample, SynthesisBy by) {
    const int most = greatest_window(sample);
    if (by == SynthesisBy::patch) return std::clamp(most / 4, std::min(8, most), most);
    return std::min(11, most - (most + 1) % 2);
}

image::Image synthesised(const image::Image& sample, const Synthesis& how, Jobs& jobs,
                         const Progress& progress) {
    CHECK(how.window >= kLeastWindow && how.window <= greatest_window(sample));
    return how.by == SynthesisBy::pixel ? grown_by_pixel(sample, how, jobs, progress)
                                        : quilted(sample, how, jobs, progress);
}

} // namespace scanout::signal
