// Pictures of what the picture on show errs, from the reference as far as it is known. All pictures
// have the reference's size.
#pragma once

#include "image/image.h"
#include "trace/progressive.h"

#include <optional>

namespace scanout::app {

// The root mean square error of red, green and blue, codes, over the pixels of which the reference
// knows something; nothing before there is one. Rows are known in an order that makes the first of
// them stand for all.
struct ErrorFigures {
    double drawn = 0;      // of the picture as it was drawn
    double converging = 0; // of converging()
};
std::optional<ErrorFigures> error_figures(const image::Image& drawn,
                                          const trace::Progressive& reference);

// The drawn picture, with the pixels of the reference where they have their final colour: each
// pixel changes once, and no noise is ever seen.
void converging(const image::Image& drawn, const trace::Progressive& reference, image::Image& out);

// The largest difference of a channel, as in image/heat_map.h. A pixel of which nothing is known
// shows what is known above it.
void error_map(const image::Image& drawn, const trace::Progressive& reference, image::Image& out);

// The reference from column `x` on, instead of what `out` holds there. A pixel of which nothing is
// known shows what is known above it.
void lay_reference(const trace::Progressive& reference, int x, image::Image& out);

} // namespace scanout::app
