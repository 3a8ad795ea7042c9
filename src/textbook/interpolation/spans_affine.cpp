// Values stepped down both edges and along the line [Compendium 3.2.4].
#include "textbook/interpolation/spans.h"

namespace scanout::textbook {

Interpolator interpolate_spans_affine(const Triangle& t) {
    return [spans = Spans(t, false)](int y, int x0, int x1, const Emit& emit) mutable {
        spans.line(y, x0, x1, [&](int x, const Step& at) { emit(x, y, at.values); });
    };
}

} // namespace scanout::textbook
