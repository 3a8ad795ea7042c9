// A viewer of one triangle, without a display.
#pragma once

#include "app/view/viewer.h"
#include "triangle_mesh.h"

namespace scanout::app {

using Id = ActionId;

struct Bench {
    explicit Bench(const Settings& settings = {}) : viewer(settings, 640, 480, 3) {}
    Effect act(Id id, std::array<int, 3> numbers = {}) {
        return viewer.apply({id, numbers, {}, false}, &mesh);
    }
    const Look& look() const { return viewer.state().look; }
    scene::View view() const { return *viewer.view(mesh); }
    geom::Mesh mesh = test::triangle_mesh();
    Viewer viewer;
};

} // namespace scanout::app
