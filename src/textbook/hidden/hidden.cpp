#include "textbook/hidden/hidden.h"

#include <algorithm>

namespace scanout::textbook {

void fill_in_picture(const HiddenTask& task, const Triangle& triangle, const Span& span) {
    task.fill(points_of(triangle), [&](int y, int x0, int x1) {
        const int from = std::max(x0, 0), to = std::min(x1, task.width);
        if (y >= 0 && y < task.height && from < to) span(y, from, to);
    });
}

double depth_on_screen(const Triangle& t, int x, int y) {
    const auto l = barycentric(points_of(t), x, y);
    return l[0] * t.corner[0].z + l[1] * t.corner[1].z + l[2] * t.corner[2].z;
}

double depth_in_space(const Triangle& t, int x, int y) {
    const auto l = barycentric(points_of(t), x, y);
    double depth = 0, sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        depth += l[i] * t.corner[i].z / t.corner[i].w;
        sum += l[i] / t.corner[i].w;
    }
    return depth / sum;
}

} // namespace scanout::textbook
