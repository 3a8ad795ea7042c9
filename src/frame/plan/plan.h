// The frame plan: from options and facts about the scene to the stages that run. A pure function,
// tested without drawing a pixel; it runs nothing that the scene does not call for.
#pragma once

#include "base/result.h"
#include "frame/anti_aliasing.h"
#include "frame/edges.h"
#include "frame/facts/facts.h"
#include "frame/options.h"
#include "frame/stencil.h"
#include "image/convolution.h"
#include "raster/culling/cull.h"
#include "shade/ambient_occlusion.h"
#include "shade/colour_by.h"
#include "shade/resolve/output.h"
#include "shade/stage.h"
#include "shade/transparency.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::frame {

// One row of the plan: what runs, and the fact that decides it.
struct Decision {
    std::string effect;         // "texture", "highlight", "shadow" ...
    std::string technique;      // "bilinear"; "on" where there is only one; "off"
    std::string because;        // "30 of 40 triangles have a readable map_Kd"
    bool needed = false;        // the scene calls for it; of a choice: it makes a difference
    bool forced = false;        // the user decided
    bool choice = false;        // an axis with an option of its own, not an effect
    std::string_view axis = {}; // of an effect: that of its techniques; empty where it has only one
    bool on() const { return technique != "off"; }
    friend bool operator==(const Decision&, const Decision&) = default;
};
std::string to_string(const Decision& decision); // "texture bilinear: 30 of 40 ..."

// Alpha test and blending.
struct TransparencyPlan {
    std::vector<raster::AlphaMode>
        alpha_modes; // of the default material, then of each; empty: all opaque
    std::vector<shade::MaterialAlpha> alpha;      // as many
    const shade::Transparency* cut_out = nullptr; // null where no triangle wants it
    const shade::Transparency* blended = nullptr;
    const shade::Blend* blend = nullptr;
    bool opaque_blended = false; // forced on where nothing calls for it: what is blended is opaque
    std::vector<const shade::Stage*> stages; // find alpha where a map has it
    shade::Attributes attributes;            // what they read
    const shade::Filter* filter = nullptr;
    friend bool operator==(const TransparencyPlan&, const TransparencyPlan&) = default;
};

// Shadow casters, and the technique of their shadows.
struct ShadowPlan {
    // Of the frame's stages; null: there is no pass either.
    const shade::ShadowStage* stage = nullptr;
    ShadowPlane plane; // on which projected shadows fall
    // Of the default material, then of each: opaque, cut_out (in maps with its holes) or nothing.
    // Empty: all cast whole shadows.
    std::vector<raster::AlphaMode> casters;
    // By light of the plan: the faces that its shadow maps are drawn of.
    std::vector<raster::Facing> in_maps;
    // Likewise: the sides of faces that lie within closed components (LightFacts::inner).
    std::vector<raster::Facing> inner;
    friend bool operator==(const ShadowPlan&, const ShadowPlan&) = default;
};

// The lengths that an annotation shows, in the file's unit; empty: none.
std::string size_text(Annotation annotation, const DVec3& box_size);

// What is drawn over the shading, to show how the model is built.
struct AnnotationPlan {
    const Edges* edges = nullptr; // null: none
    double edge_angle = 0;        // degrees, of feature edges
    Annotations annotations;
    bool any() const { return edges != nullptr || !annotations.empty(); }
    friend bool operator==(const AnnotationPlan&, const AnnotationPlan&) = default;
};

struct FramePlan {
    FrameOptions options; // its size is what is drawn, which is enlarged where it is less:
    int shown_width = 0, shown_height = 0; // of the picture
    bool is_enlarged() const {
        return shown_width != options.width || shown_height != options.height;
    }
    // Every technique that runs, in the order in which it was decided; no other one does. The usual
    // culling, depth and depth test, and one-sided light are not named.
    std::vector<const Technique*> techniques;
    // The stages of a block, in order: interpolation, maps, lights, shadow, shading, emission,
    // exposure, tone.
    std::vector<const shade::Stage*> stages;
    shade::Attributes attributes;                    // what the stages read of each item
    const shade::Filter* filter = nullptr;           // how maps are read; null where none is
    std::vector<scene::Light> lights;                // those that reach something
    const AntiAliasing* aa = nullptr;                // how edges are smoothed
    shade::Output output;                            // from light to codes
    const image::Convolution* convolution = nullptr; // of the finished picture; null: none
    float exposure = 1;                              // what light is multiplied by
    float white = 1;                                 // the light that a tone curve makes 1
    TransparencyPlan transparency;
    const Stencil* stencil = nullptr; // null: there is no buffer of marks either
    AnnotationPlan annotations;
    const shade::ColourBy* colours = nullptr; // what colours say in place of light; null: light
    // 1: its back faces are left out; of the default material, then of each. Empty: options.cull
    // holds for all.
    std::vector<std::uint8_t> one_sided;
    raster::DepthRule depth_rule; // which of several surfaces is visible
    // How each kind of surface reflects: what the shading stage calls.
    std::array<const shade::Stage*, scene::kSurfaces> reflection{};
    // As in MaterialSet: 1 where maps leave no highlight, whatever the material says. Empty:
    // nowhere.
    std::vector<std::uint8_t> matt;
    bool physical = false; // some material says roughness or metalness
    // Where light is not evaluated at pixels: the light stages that run over vertices or faces.
    std::vector<const shade::Stage*> vertex_lights;
    bool vertex_normals = false;
    shade::Sides sides = shade::Sides::eye;
    ShadowPlan shadow;
    const shade::AmbientOcclusion* occlusion = nullptr; // null: none, and no pass either
    std::optional<std::int32_t> only_material;          // of all that is drawn, which is triangles
    std::vector<shade::MipUse> mips;       // the textures that have mipmaps in this frame
    std::optional<shade::Wrap> wrap;       // of all textures; else as each map says
    const shade::Source* source = nullptr; // what map_Kd is instead of its picture
    bool mapped = false;                   // u and v are made, not the model's
    bool lacks_uv = false; // no map is read, for the model has no coordinates and none are made
    std::vector<Decision> decisions; // one for each effect and axis, in a fixed order

    const Decision* decision(std::string_view effect) const; // null where there is none
    friend bool operator==(const FramePlan&, const FramePlan&) = default;
};

// The same stages run on the same data, whatever was asked for and why it was decided: pictures are
// equal to the bit, and a frame of one takes as long as a frame of the other.
bool draws_alike(const FramePlan& a, const FramePlan& b);

// The materials that call for an effect of SceneFacts::materials_of, as the plan has them reflect;
// null where the facts do not say.
const MaterialSet* materials_calling(const SceneFacts& facts, const FramePlan& plan,
                                     std::string_view effect);

// Fails (Exit::usage) when the options name a technique or a size that does not exist. Without a
// view, nothing counts as far away.
Result<FramePlan> plan(const FrameOptions& options, const SceneFacts& facts,
                       const scene::View& view = {});

} // namespace scanout::frame
