#include "textbook/hidden.h"

#include <limits>

namespace scanout::textbook {

void z_buffer(const HiddenTask& task, DepthOf depth_of, const Shade& shade) {
    std::vector<double> depths(static_cast<std::size_t>(task.width) *
                                   static_cast<std::size_t>(task.height),
                               std::numeric_limits<double>::infinity());
    for (const Triangle& t : task.triangles)
        fill_in_picture(task, t, [&](int y, int x0, int x1) {
            for (int x = x0; x < x1; ++x) {
                double& there =
                    depths[static_cast<std::size_t>(y) * static_cast<std::size_t>(task.width) +
                           static_cast<std::size_t>(x)];
                const double depth = depth_of(t, x, y);
                if (!(depth < there || (task.equal_passes && depth == there))) continue;
                there = depth;
                shade(t, y, x, x + 1);
            }
        });
}

} // namespace scanout::textbook
