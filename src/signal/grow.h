// The two ways of synthesis (signal/synthesis.h).
#pragma once

#include "signal/synthesis.h"

namespace scanout::signal {

image::Image grown_by_pixel(const image::Image& sample, const Synthesis& how, Jobs& jobs,
                            const Progress& progress);
image::Image quilted(const image::Image& sample, const Synthesis& how, Jobs& jobs,
                     const Progress& progress);

} // namespace scanout::signal
