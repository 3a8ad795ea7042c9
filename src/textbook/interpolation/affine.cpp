// Barycentric on the screen [Compendium 3.2], [SoftwareGraphics]. Where w differs between the
// corners, textures bend [Compendium 5.3].
#include "textbook/interpolation/interpolation.h"

namespace scanout::textbook {

Interpolator interpolate_affine(const Triangle& t) {
    return by_weights(t, [p = points_of(t)](int x, int y) { return barycentric(p, x, y); });
}

} // namespace scanout::textbook
