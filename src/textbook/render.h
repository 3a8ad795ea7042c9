// A textbook renderer, whole: the scene that the production renderer draws, by the methods of the
// documents in plain scalar code [Compendium], [Course], [SoftwareGraphics]. One sample a pixel, at
// its centre; nearest texel; light at every pixel. It includes nothing of raster, shade and frame,
// so that either can be held against the other.
#pragma once

#include "image/image.h"
#include "scene/light.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "textbook/methods.h"

#include <vector>

namespace scanout::textbook {

enum class Left : std::uint8_t { none, backs, fronts }; // faces that are left out

struct Look {
    int width = 0, height = 0;
    image::Rgba8 background{0, 0, 0, 255};
    std::vector<scene::Light> lights;
    Left left = Left::none;
    std::vector<std::uint8_t> one_sided; // 1: backs are left out; the default one first; or empty
    bool two_sided = true;               // normals turn towards the eye
    bool textures = true, vertex_colours = true, highlights = true;
};

struct Picture {
    image::Image image;
    std::size_t submitted = 0, drawn = 0; // triangles of the mesh; on the screen, after cutting
};
Picture render(const scene::Scene& scene, const scene::View& view, const Look& look,
               const Parts& parts);

} // namespace scanout::textbook
