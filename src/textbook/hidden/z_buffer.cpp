#include "textbook/hidden/hidden.h"

#include <limits>

namespace scanout::textbook {

void z_buffer(const HiddenTask& task, DepthOf depth_of, const Shade& shade) {
    std::vector<double> depths(static_cast<std::size_t>(task.width) *
                                   static_cast<std::size_t>(task.height),
                               std::numeric_limits<double>::infinity());
    for (const Triangle& t : task.triangles)
        fill_in_picture(task, t, [&](int y, int x0, int x1) {
            double* const row =
                depths.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(task.width);
            const auto passes = [&](int x) {
                const double depth = depth_of(t, x, y);
                if (!(depth < row[x] || (task.equal_passes && depth == row[x]))) return false;
                row[x] = depth;
                return true;
            };
            for_each_run(x0, x1, passes, [&](int from, int end) { shade(t, y, from, end); });
        });
}

} // namespace scanout::textbook
