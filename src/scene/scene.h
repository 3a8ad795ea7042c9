// A scene to draw: one mesh with its materials and textures, and the counts of its file.
#pragma once

#include "geom/mesh.h"
#include "scene/material.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace scanout::scene {

// Counts of the model's file, for reports.
struct ModelCounts {
    std::size_t vertices = 0; // v statements (OBJ), 3 a facet (STL)
    std::size_t faces = 0;    // polygons that are drawn, with any number of corners
    std::size_t triangles = 0;
    std::size_t lines = 0; // line elements (polylines)
    std::size_t points = 0;
    std::size_t skipped = 0; // statements or facets that could not be used
    std::uint64_t bytes = 0; // the model's file, its material files, and its decoded textures
};

// How a plane cut the mesh (scene/section.h).
struct SceneSection {
    std::string plane;                          // as the command line says it
    bool cuts = false;                          // some of the model lies in front of it
    bool empty = false;                         // all does
    std::size_t triangles = 0;                  // before the cut
    std::size_t removed = 0, cut = 0, caps = 0; // likewise triangles
    std::size_t edges = 0, open_edges = 0;      // of the cut; those that bound no cap
    friend bool operator==(const SceneSection&, const SceneSection&) = default;
};

struct Scene {
    std::string path;
    geom::Mesh mesh;
    std::vector<Material> materials;
    // Of what the file gives no material; io::load makes it unnamed_material().
    Material unnamed;
    std::vector<Texture> textures;
    ModelCounts counts;
    std::vector<std::string> cameras;    // that the file describes, one line each; none is used
    std::vector<std::string> animations; // that the file has, by name
    // A moment of an animation is drawn, framed by the mesh's box, which holds all moments of it.
    bool animated = false;
    // Renderers may cache data of a scene while this stays the same; 0: they cache nothing. Two
    // loaded scenes never share one.
    std::uint64_t revision = 0;
    // Of data of the mesh, which a section replaces.
    std::uint64_t mesh_revision() const { return revision == 0 ? 0 : revision << 32 | cuts; }
    std::uint64_t cuts = 0;
    std::optional<SceneSection> section; // none: the mesh is whole
};

} // namespace scanout::scene
