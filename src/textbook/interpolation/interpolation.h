// The values of a triangle's pixels from those of its corners: a method each. What a method needs
// to know of a triangle it works out once.
#pragma once

#include "textbook/methods.h"
#include "textbook/triangle.h"

#include <functional>

namespace scanout::textbook {

using Emit = std::function<void(int x, int y, const Values& values)>;
// Gives the values of the pixels x0 <= x < x1 of a line.
using Interpolator = std::function<void(int y, int x0, int x1, const Emit& emit)>;
using InterpolationMethod = Interpolator (*)(const Triangle& triangle);

#define TEXTBOOK_DECLARE(name, blurb) Interpolator interpolate_##name(const Triangle& triangle);
TEXTBOOK_INTERPOLATION(TEXTBOOK_DECLARE)
#undef TEXTBOOK_DECLARE
InterpolationMethod interpolation_method(Interpolation interpolation);

using Weights = std::array<double, 3>;
Values weighted(const Triangle& triangle, const Weights& weights);
// Of a method that gives each pixel its weights: of(x, y).
template <class Of>
Interpolator by_weights(const Triangle& triangle, Of of) {
    return [triangle, of](int y, int x0, int x1, const Emit& emit) {
        for (int x = x0; x < x1; ++x)
            emit(x, y, weighted(triangle, of(x, y)));
    };
}

} // namespace scanout::textbook
