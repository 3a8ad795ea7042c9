// What a reference picture is asked to look like: the choices of a frame's plan that are models or
// filters, not rungs. Whoever has a plan fills it in; nothing here knows plans.
#pragma once

#include "image/image.h"
#include "scene/light.h"
#include "scene/material.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace scanout::trace {

// How much of a material shows what lies behind it, or lets light pass.
enum class Alpha : std::uint8_t { opaque, cut_out, blended, nothing };
// The faces that are left out, by their winding on the screen.
enum class Left : std::uint8_t { none, backs, fronts };
enum class Edges : std::uint8_t { as_the_map_says, repeat, mirror, clamp };

struct MapsRead {
    bool diffuse = false, opacity = false, normal = false, bump = false, specular = false,
         shininess = false, roughness = false, metalness = false, emission = false;
};

struct Look {
    int width = 0, height = 0;
    image::Rgba8 background{0, 0, 0, 255};
    Left left = Left::none;
    std::vector<std::uint8_t> one_sided; // 1: backs are left out; the default one first; or empty
    bool turned_to_eye = true;           // normals: the side of a face that the eye sees is lit

    // Materials. Those of a scene by number, and the default one, where a list has one more, last.
    MapsRead maps;
    Edges edges = Edges::as_the_map_says;
    bool vertex_colours = false, emission = false;
    std::array<std::string, scene::kSurfaces> reflection{"lambert", "blinn_phong", "ggx"};
    std::vector<std::uint8_t> matt; // 1: no highlight, whatever the material says; empty: none
    std::vector<Alpha> alpha;       // the default one first; empty: all are opaque
    double alpha_cut = 0.5;         // the least alpha that a cut-out surface shows

    std::vector<scene::Light> lights;
    double occlusion_radius = 0; // of ambient light, in parts of the model's radius; 0: none
    bool shadows = false;
    std::vector<Alpha> casts; // as alpha: opaque, cut_out or nothing; empty: all cast

    double exposure = 1, white = 1; // what light is multiplied by; what a tone curve makes 1
    std::string tone = "clamp";
    // Of a sample by its distance from the pixel's centre along an axis, up to 1.5 pixels; the
    // product of both axes counts. Empty: the pixel's own box.
    std::function<double(double distance)> filter;
};

} // namespace scanout::trace
