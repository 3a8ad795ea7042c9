// Facts about alpha: which materials are opaque, alpha-tested or blended, by their numbers and the
// texels of their maps. A texture whose alpha is 255 everywhere leaves a material opaque.
#pragma once

#include "scene/scene.h"
#include "shade/transparency.h"

#include <cstdint>
#include <string>
#include <vector>

namespace scanout::frame {

// In ascending order: the product of several factors has the greatest of their kinds, except
// unseen.
enum class AlphaClass : std::uint8_t {
    opaque,  // alpha is 1
    cut_out, // 0 in places, else 1
    blended, // between them somewhere
    unseen   // 0: d 0
};

// Counts of triangles, and of the materials that they have.
struct AlphaFacts {
    std::size_t cut_out_triangles = 0, blended_triangles = 0, unseen_triangles = 0;
    std::size_t cut_out_materials = 0, blended_materials = 0, unseen_materials = 0;
    std::size_t materials = 0;       // that triangles have
    std::size_t blended_by_maps = 0; // blended materials with d 1: a map lets light through
    float min_opacity = 1;           // of blended materials
    // One entry for the default material, then one for each of the scene; opaque where no triangle
    // has it.
    std::vector<AlphaClass> of_material;
    std::vector<shade::MaterialAlpha> maps; // which maps alpha is read from
    std::size_t see_through_triangles() const {
        return cut_out_triangles + blended_triangles + unseen_triangles;
    }
};
AlphaFacts alpha_facts(const scene::Scene& scene);

} // namespace scanout::frame
