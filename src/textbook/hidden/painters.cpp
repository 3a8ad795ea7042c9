// The painter's algorithm [Compendium 6.1], [Course 4.3], [Primer 5.3.1]: faces are sorted by their
// distance and drawn from far to near. A face has no one distance; that of its middle is taken.
// Wrong where faces overlap in a ring or cross, and where a near middle belongs to a far part.
#include "textbook/hidden/hidden.h"

#include <algorithm>

namespace scanout::textbook {

void hidden_painters(const HiddenTask& task, const Shade& shade) {
    std::vector<const Triangle*> order;
    order.reserve(task.triangles.size());
    for (const Triangle& t : task.triangles)
        order.push_back(&t);
    std::stable_sort(order.begin(), order.end(), [](const Triangle* a, const Triangle* b) {
        return a->distance_of_middle() > b->distance_of_middle();
    });
    for (const Triangle* t : order)
        fill_in_picture(task, *t, [&](int y, int x0, int x1) { shade(*t, y, x0, x1); });
}

} // namespace scanout::textbook
