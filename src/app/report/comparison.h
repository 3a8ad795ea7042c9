// What scanout compare measures between two pictures, and whether they count as the same.
#pragma once

#include "app/options/settings.h"
#include "image/compare.h"
#include "image/image.h"
#include "image/metrics.h"

#include <optional>
#include <string_view>

namespace scanout::app {

struct Comparison {
    image::Difference difference;
    // Of pictures of one size. The last two take the longest: nothing where nobody asks.
    image::Metrics metrics;
    float flip = 0;
    std::optional<double> ssim;
    double figure(Metric metric) const;
    // Within --limit of the metric, or --max-diff and --max-pixels.
    bool same(const Settings& settings) const;
};

Comparison comparison(const image::Image& expected, const image::Image& got,
                      const Settings& settings);

std::string_view text_of(Metric metric);
bool more_is_better(Metric metric); // the more, the less the pictures differ

} // namespace scanout::app
