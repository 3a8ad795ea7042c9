// value/w and 1/w stepped down both edges and along the line, and divided at each pixel
// [Compendium 5.4].
#include "textbook/interpolation/spans.h"

#include <algorithm>

namespace scanout::textbook {

Interpolator interpolate_spans_perspective(const Triangle& t) {
    const double least = std::min({1 / t.corner[0].w, 1 / t.corner[1].w, 1 / t.corner[2].w});
    return [spans = Spans(t, true), least](int y, int x0, int x1, const Emit& emit) mutable {
        spans.line(y, x0, x1, [&](int x, const Step& at) {
            Values values = at.values;
            const double w = 1 / std::max(at.one_over_w, least); // beyond an edge: that of the edge
            for (double& v : values)
                v *= w;
            emit(x, y, values);
        });
    };
}

} // namespace scanout::textbook
