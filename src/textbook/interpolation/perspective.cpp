// C = z (l0 C0/z0 + l1 C1/z1 + l2 C2/z2), 1/z = l0/z0 + l1/z1 + l2/z2 [SoftwareGraphics],
// [Compendium 5.4]: value/w and 1/w are linear on the screen, the value is not.
#include "textbook/interpolation/interpolation.h"

namespace scanout::textbook {

Interpolator interpolate_perspective(const Triangle& t) {
    return by_weights(t, [t, p = points_of(t)](int x, int y) {
        const Weights l = barycentric(p, x, y);
        const Weights over_w = {l[0] / t.corner[0].w, l[1] / t.corner[1].w, l[2] / t.corner[2].w};
        const double sum = over_w[0] + over_w[1] + over_w[2]; // 1/w of the pixel
        if (!(sum > 0)) return l; // a pixel outside of the triangle, beyond its horizon
        return Weights{over_w[0] / sum, over_w[1] / sum, over_w[2] / sum};
    });
}

} // namespace scanout::textbook
