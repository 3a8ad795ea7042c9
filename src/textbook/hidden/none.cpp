// Nothing hides anything: the edges of all faces, each once.
#include "textbook/hidden/hidden.h"

namespace scanout::textbook {

void hidden_none(const HiddenTask& task, const Shade& /*shade*/) {
    for (const Wire& wire : task.wires)
        task.draw_wire(wire);
}

} // namespace scanout::textbook
