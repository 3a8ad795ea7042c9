// The nodes of the default scene, walked: which mesh is drawn where. Khronos 2021, 3.5.
#pragma once

#include "base/result.h"
#include "base/warnings.h"
#include "io/gltf/accessor.h"

#include <string>
#include <vector>

namespace scanout::io::gltf {

struct Draw {
    Index node = -1, mesh = -1;
    DMat4 matrix{1}; // the mesh's coordinates -> the file's
};

struct SceneNodes {
    std::vector<Draw> draws;  // in the order of the file: a node, then its children
    std::vector<DMat4> world; // of each node of the document: its coordinates -> the file's
};

// Without a scene every node that is no child is a root. A cycle, or a node with two parents, is an
// error (Exit::unreadable) that names it.
Result<SceneNodes> walk_nodes(const Document& document, Accessors& accessors, Budget& budget,
                              const std::string& path, Warnings& warnings);

} // namespace scanout::io::gltf
