// A z-buffer of the pseudo-depth C + D/z [Compendium 7.2], [ClipSpace 4.2]: linear on
// the screen and before the division, so that it is interpolated without one and can be cut.
#include "textbook/hidden/hidden.h"

namespace scanout::textbook {

void hidden_z_pseudo(const HiddenTask& task, const Shade& shade) {
    z_buffer(task, depth_on_screen, shade);
}

} // namespace scanout::textbook
