// The smallest mesh there is to look at.
#pragma once

#include "geom/mesh.h"

namespace scanout::test {

inline geom::Mesh triangle_mesh() {
    geom::Mesh mesh;
    mesh.position = {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0)};
    mesh.normal.assign(3, Vec3(0, 0, 1));
    mesh.index = {0, 1, 2};
    mesh.material = {-1};
    mesh.face = {0};
    mesh.radius = 1;
    return mesh;
}

} // namespace scanout::test
