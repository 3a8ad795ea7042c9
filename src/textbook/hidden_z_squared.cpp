// A z-buffer of z' = z z over w = z [Compendium 6.2]: after the division the distance again, and
// bent by cuts before it like hidden_z_linear.cpp.
#include "textbook/hidden.h"

namespace scanout::textbook {

void hidden_z_squared(const HiddenTask& task, const Shade& shade) {
    z_buffer(task, depth_in_space, shade);
}

} // namespace scanout::textbook
