// A z-buffer of the distance itself, brought to -1 .. 1 [ClipSpace 4.2]: linear in
// space, and so not on the screen; times w it is a square of z, and a cut before the division gives
// the cut's corners a wrong depth.
#include "textbook/hidden/hidden.h"

namespace scanout::textbook {

double clip_depth_z_linear(double distance, double w, double n, double f) {
    return (2 * distance - (f + n)) / (f - n) * w;
}

void hidden_z_linear(const HiddenTask& task, const Shade& shade) {
    z_buffer(task, depth_in_space, shade);
}

} // namespace scanout::textbook
