#include "app/view/motion_levels.h"

#include "frame/render_scale.h"
#include "rows.h"

#include <algorithm>
#include <iterator>

namespace scanout::app {
namespace {

double pixels_of(const frame::RenderScale& scale) {
    const double side = static_cast<double>(scale.numerator) / scale.denominator;
    return side * side;
}

} // namespace

std::vector<MotionLevel> motion_levels(const frame::FrameOptions& options, bool may_thin,
                                       bool may_scale) {
    constexpr double kOneSample = 0.6; // of a frame of four
    std::vector<MotionLevel> levels = {{"", false, 1}};
    const bool thins = may_thin && options.samples > 1 && frame::is_auto(options.aa);
    if (thins) levels.push_back({"", true, kOneSample});
    if (!may_scale) return levels;
    const double rest = levels.back().share;
    const auto& rows = frame::render_scale::kRows; // cheapest first
    const double own = pixels_of(
        row_or(rows, frame::asked_for(options, "render_scale"), frame::render_scale::full));
    std::for_each(std::rbegin(rows), std::rend(rows), [&](const frame::RenderScale* row) {
        if (pixels_of(*row) < own)
            levels.push_back({row->card.name, thins, rest * pixels_of(*row) / own});
    });
    return levels;
}

} // namespace scanout::app
