// Later faces of the file over earlier ones: what is seen before anything is done about hidden
// surfaces [Compendium 6], and what [SoftwareGraphics] does.
#include "textbook/hidden/hidden.h"

namespace scanout::textbook {

void hidden_drawing_order(const HiddenTask& task, const Shade& shade) {
    for (const Triangle& t : task.triangles)
        fill_in_picture(task, t, [&](int y, int x0, int x1) { shade(t, y, x0, x1); });
}

} // namespace scanout::textbook
