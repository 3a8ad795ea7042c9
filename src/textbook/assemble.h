// From a mesh to triangles on the screen: vertices through the projection, faces cut, divided, and
// those left out that show the wrong side. [Compendium 9], [Primer 1], [SoftwareGraphics].
#pragma once

#include "scene/scene.h"
#include "scene/view.h"
#include "textbook/projection.h"
#include "textbook/render.h"

#include <vector>

namespace scanout::textbook {

// In the order of the file.
std::vector<Triangle> assemble(const geom::Mesh& mesh, const scene::View& view, const Look& look,
                               const Parts& parts);

} // namespace scanout::textbook
