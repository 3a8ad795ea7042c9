// interpolate_spans_perspective.cpp as the document has it first [Compendium 11.4]: the first line
// takes the vertex's own values, wherever between two lines it lies, and so the last one goes
// beyond the edge, t > 1: spikes.
#include "textbook/interpolation/spans.h"

namespace scanout::textbook {

Interpolator interpolate_spans_from_vertex(const Triangle& t) {
    return [spans = Spans(t, true, BeginsAt::vertex)](int y, int x0, int x1,
                                                      const Emit& emit) mutable {
        spans.line(y, x0, x1, [&](int x, const Step& at) {
            Values values = at.values;
            for (double& v : values)
                v /= at.one_over_w;
            emit(x, y, values);
        });
    };
}

} // namespace scanout::textbook
