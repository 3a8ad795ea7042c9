#include "app/report/comparison.h"

#include "image/flip.h"

#include <array>

namespace scanout::app {

std::string_view text_of(Metric metric) {
    constexpr std::array<std::string_view, 7> kNames = {"none", "rmse", "rmse_codes", "psnr",
                                                        "max",  "flip", "ssim"};
    return kNames[static_cast<std::size_t>(metric)];
}

bool more_is_better(Metric metric) {
    return metric == Metric::psnr || metric == Metric::ssim;
}

double Comparison::figure(Metric metric) const {
    switch (metric) {
    case Metric::rmse:
        return metrics.rmse;
    case Metric::rmse_codes:
        return metrics.rmse_codes;
    case Metric::psnr:
        return image::psnr(metrics.rmse);
    case Metric::max:
        return difference.max_difference;
    case Metric::flip:
        return double{flip};
    case Metric::ssim:
        return ssim.value_or(1);
    case Metric::none:
        break;
    }
    return 0;
}

bool Comparison::same(const Settings& settings) const {
    if (!difference.same_size) return false;
    if (settings.metric == Metric::none) return difference.over_tolerance <= settings.max_pixels;
    if (!settings.limit) return true;
    const double found = figure(settings.metric);
    return more_is_better(settings.metric) ? found >= *settings.limit : found <= *settings.limit;
}

Comparison comparison(const image::Image& expected, const image::Image& got,
                      const Settings& settings) {
    Comparison c;
    c.difference = image::compare(got, expected, settings.max_difference);
    if (!c.difference.same_size) return c;
    const bool all = settings.json.has_value();
    c.metrics = image::metrics(expected, got);
    if (all || settings.metric == Metric::none || settings.metric == Metric::flip)
        c.flip = image::mean_flip(expected, got);
    if (all || settings.metric == Metric::ssim) c.ssim = image::ssim(expected, got);
    return c;
}

} // namespace scanout::app
