// From a mesh to triangles on the screen: vertices through the projection, faces cut, divided, and
// those left out that show the wrong side. [Compendium 9], [Primer 1], [SoftwareGraphics].
#pragma once

#include "scene/scene.h"
#include "scene/view.h"
#include "textbook/projection.h"
#include "textbook/render.h"

#include <vector>

namespace scanout::textbook {

inline DVec3 in_view(const scene::View& view, const Vec3& position) {
    return view.linear * DVec3(position) + view.translation;
}
// With planes from near to beyond the farthest vertex.
Projection projection_of(const geom::Mesh& mesh, const scene::View& view, const Parts& parts);
// Of a face of that material (geom::Mesh::material).
inline bool shows(bool front, const Look& look, std::int32_t material) {
    if (front) return look.left != Left::fronts;
    const auto row = static_cast<std::size_t>(material + 1);
    return look.left != Left::backs && (look.one_sided.empty() || look.one_sided[row] == 0);
}

// In the order of the file.
std::vector<Triangle> assemble(const geom::Mesh& mesh, const scene::View& view, const Look& look,
                               const Parts& parts);

} // namespace scanout::textbook
