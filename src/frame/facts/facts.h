// Facts about a scene, measured from its data, not taken from the claims of its file. The plan
// decides from them. They are gathered once, when a model is loaded.
#pragma once

#include "frame/facts/alpha_facts.h"
#include "frame/facts/back_faces.h"
#include "frame/facts/minification.h"
#include "frame/facts/shadow_plane.h"
#include "frame/facts/surroundings.h"
#include "frame/options.h"
#include "scene/scene.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::frame {

// Materials by index. Primitives without a material count as one of their own, the last.
using MaterialSet = std::vector<bool>;

struct SceneFacts {
    std::size_t triangles = 0, lines = 0, points = 0;
    DVec3 centre{0};                           // of the mesh, in file units (geom::Mesh)
    int exponent = 0;                          // file units = normalised * 2^exponent
    DVec3 box_size{0};                         // of the bounding box, file units
    double radius = 0.5;                       // of the framing sphere: they place lights
    std::size_t unlit_triangles = 0;           // no light changes their material
    bool all_unlit = false;                    // of those that have an area
    std::size_t one_sided_triangles = 0;       // the back of their material is not seen
    bool all_one_sided = false;                // of those that have an area
    std::vector<std::uint8_t> one_sided;       // 1: of the default material, then of each
    std::size_t specular_triangles = 0;        // material has a highlight, after its maps
    std::size_t physical_triangles = 0;        // their material states a roughness or metalness
    std::optional<std::int32_t> only_material; // of all primitives, where all are triangles
    geom::MeshTopology topology;
    bool uv = false;                                    // some face has texture coordinates
    bool vertex_colours = false, white_colours = false; // there are some; all of them are white
    AlphaFacts alpha;
    // Triangles whose material has the map, and whose map can change a pixel.
    std::array<std::size_t, shade::kMaps> mapped_triangles{};
    shade::MapBits readable_maps = 0;   // some triangle's material has it, with any contents
    std::size_t emitting_triangles = 0; // Ke above 0, and map_Ke not black
    std::vector<TexturedSurface> textured_surfaces;
    // Kd times vertex colour, and the same times map_Kd: no primitive reflects more; at most 1.
    float brightest = 1, brightest_mapped = 1;
    bool black_by_maps = false; // no diffuse reflection: materials with a Kd have a black map
    ShadowPlane shadow_plane;
    Surroundings surroundings; // of lamps
    std::optional<scene::SceneSection> section;

    // The materials that call for an effect, by the effect's name in the plan. `explain` counts
    // the pixels that show one of them.
    using MaterialSets = std::map<std::string, MaterialSet, std::less<>>;
    MaterialSets materials_of;
    // Facts about highlights, map_Ks and map_Ns if physical materials reflect by these, too.
    struct ByKs {
        std::size_t specular_triangles = 0, specular_maps = 0, gloss_maps = 0;
        MaterialSets materials_of;
    } by_ks;
};
// shadow_plane: the user's, in place of the one that is found.
SceneFacts facts(const scene::Scene& scene, const std::optional<FilePlane>& shadow_plane = {});

} // namespace scanout::frame
