// The edges of a mesh on the screen, for --hidden none. Cut at the near plane alone: the sides of
// the screen are the line clips' matter.
#pragma once

#include "textbook/assemble.h"

namespace scanout::textbook {

// Each edge once, whichever faces and vertices share it, in the order of the file.
std::vector<Wire> wires_of(const geom::Mesh& mesh, const scene::View& view, const Look& look,
                           const Parts& parts);

} // namespace scanout::textbook
