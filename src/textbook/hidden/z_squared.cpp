// A z-buffer of z' = z z over w = z [Compendium 6.2]: after the division the distance again, and
// bent by cuts before it like hidden_z_linear.cpp.
#include "textbook/hidden/hidden.h"

namespace scanout::textbook {

// w is z, but in an orthographic view 1.
double clip_depth_z_squared(double distance, double w) {
    return distance * w;
}

void hidden_z_squared(const HiddenTask& task, const Shade& shade) {
    z_buffer(task, depth_in_space, shade);
}

} // namespace scanout::textbook
