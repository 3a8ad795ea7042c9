// Nothing hides anything: the edges of all faces.
#include "textbook/hidden.h"

namespace scanout::textbook {

void hidden_none(const HiddenTask& task, const Shade& /*shade*/) {
    for (const Triangle& t : task.triangles)
        task.edges(t);
}

} // namespace scanout::textbook
