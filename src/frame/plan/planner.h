// Builds a plan row by row, by functions that each decide one kind of thing; plan.cpp calls them in
// order. Shared by the files plan*.cpp; everyone else includes frame/plan/plan.h.
#pragma once

#include "frame/facts/view_facts.h"
#include "frame/plan/plan.h"
#include "rows.h"

#include <string>
#include <string_view>
#include <vector>

namespace scanout::frame {

Error no_such_technique(std::string_view axis, const std::string& asked);

// The row of an axis that the user asked for by name, else the automatic choice.
template <class Row, std::size_t kCount>
Result<const Row*> choose(const Row* const (&rows)[kCount], const std::string& asked,
                          const Row& automatic) {
    const Row* found = is_auto(asked) ? &automatic : find_row(rows, asked);
    if (found == nullptr) return tl::unexpected(no_such_technique(rows[0]->card.axis, asked));
    return found;
}

// Switches an effect's row: on when the scene needs it, unless the user forces it. Returns whether.
bool decide(Decision& row, const FrameOptions& options, std::string_view technique, bool needed);

// Builds a plan row by row.
class Planner {
public:
    Planner(const FrameOptions& options, FramePlan& plan) : options_(options), plan_(plan) {}

    const FrameOptions& asked() const { return options_; }
    // Adds the row of an effect, decided by decide(); its techniques may be the rungs of an axis.
    bool effect(std::string name, std::string_view technique, bool needed, std::string because,
                std::string_view axis = {});
    // Adds the row of an axis that is no effect: the user's option alone decides.
    void choice(std::string axis, std::string_view technique, const std::string& asked,
                std::string because, bool needed = true);
    void stage(const shade::Stage& stage);
    // Adds a stage that another stage calls; it reads `needs` of every item.
    void called(const shade::Stage& stage, shade::Attributes needs);

private:
    const FrameOptions& options_;
    FramePlan& plan_;
};

// Fails where a size or a count is out of range.
Result<void> check_numbers(const FrameOptions& options);
// First phase: the whole plan except the texture filter. The options must have passed
// check_numbers. The plan reads only these facts of the view, so it can be cached by them.
Result<FramePlan> plan_without_filter(const FrameOptions& options, const SceneFacts& facts,
                                      const ViewFacts& view);
// Second phase, each frame: the filter of the maps that the plan's stages read, and the textures
// that have mip levels; the view's minification decides both. Allocates nothing if the plan had
// them before.
void plan_filter(FramePlan& plan, const SceneFacts& facts, const scene::View& view);

// map_Kd, or the computed texture that replaces it.
Result<void> plan_texture(Planner& planner, FramePlan& plan, const SceneFacts& facts);
// Which faces are left out, before it is decided what can be seen: options.cull becomes none or
// back where the materials are of one mind.
void plan_culling(FramePlan& plan, const SceneFacts& facts);
// Why no light shows on anything; null where some does.
const char* why_unlit(const FramePlan& plan, const SceneFacts& facts);
// Depth in steps that may be as long as the model.
bool is_depth_coarse(const FrameOptions& options);
// Some light is not black, whether it reaches the model or not.
bool some_light_shines(const FrameOptions& options);
// Does the user have physical materials reflect by Ks and Ns, as the others do?
bool by_ks_alone(const FramePlan& plan);
inline constexpr const char* kNoLight = "no light shines";
// Some light has a direction, and so a highlight: what comes from everywhere has none.
bool has_directed_light(const FramePlan& plan); // after plan_light
inline constexpr const char* kNoHighlight = "no light that has a direction shines";
// Some light differs by how a surface is turned. Ambient light is the same.
bool normals_matter(const FramePlan& plan); // after plan_light
inline constexpr const char* kNoDirection = "no light comes from a side: normals do not matter";
// Lights, sides, reflection, and how often they are evaluated.
Result<void> plan_light(Planner& planner, FramePlan& plan, const SceneFacts& facts,
                        const ViewFacts& view);
// Shadows: on where a light that shines casts them, and something is hidden from it. By default, a
// light with a size throws soft ones; a point's are sharp, and the filtered map is the cheapest
// that shows no steps. `of_lights`: facts of the plan's lights.
Result<void> plan_shadows(Planner& planner, FramePlan& plan, const SceneFacts& facts,
                          const ViewFacts& view, const std::vector<LightFacts>& of_lights,
                          const shade::Stage& shading);
// Ambient occlusion, which comes only on request.
Result<void> plan_ambient_occlusion(Planner& planner, FramePlan& plan, const SceneFacts& facts,
                                    const ViewFacts& view, const shade::Stage& shading);
// The other maps, and light of the surfaces' own; after the light and the highlights are decided.
void plan_maps(Planner& planner, FramePlan& plan, const SceneFacts& facts);
// Which materials are cut out or blended, and how alpha is found.
Result<void> plan_transparency(Planner& planner, FramePlan& plan, const SceneFacts& facts);
// Texture coordinates and wrap modes; to be called after every stage that reads a map is decided.
Result<void> plan_sampling(Planner& planner, FramePlan& plan, const SceneFacts& facts);
// --blend none draws blended surfaces as opaque ones, where the depth test keeps the nearest and
// the filter of a pixel is its own box.
bool blends_nothing(const FrameOptions& options);
// Shadow casters by material: blended ones cast none, for their shadows would have to be tinted.
void plan_casters(FramePlan& plan, const SceneFacts& facts);
// Depth test, depth format and blending, which the user chooses.
Result<void> plan_merging(Planner& planner, FramePlan& plan, const SceneFacts& facts,
                          const ViewFacts& view);
// The stencil buffer. Where the picture is its counts alone (overdraw), plan_counts takes all else
// out of the finished plan.
Result<void> plan_stencil(Planner& planner, FramePlan& plan, const SceneFacts& facts);
void plan_counts(FramePlan& plan);
// The plane that cut the mesh before.
void plan_section(Planner& planner, const SceneFacts& facts);
// What is drawn over the shading: edges, and annotations.
Result<void> plan_annotations(Planner& planner, FramePlan& plan, const SceneFacts& facts);
// What colours say. Where it is no light, plan_false_colours takes all that lights out of the
// finished plan.
Result<void> plan_colours(Planner& planner, FramePlan& plan, const SceneFacts& facts);
void plan_false_colours(FramePlan& plan);
// Exposure and tone mapping, by whether light exceeds 1. Highlights alone do not count: MTL means
// them to burn out, and a curve would dim all else for their sake.
Result<void> plan_tone(const FrameOptions& options, const SceneFacts& facts, Planner& planner,
                       FramePlan& plan);
// How many pixels are drawn.
Result<void> plan_size(Planner& planner, FramePlan& plan);
// Anti-aliasing.
Result<void> plan_edges(const FrameOptions& options, const SceneFacts& facts, Planner& planner,
                        FramePlan& plan);
// Encoding and dither: from light to codes.
Result<void> plan_output(const FrameOptions& options, const SceneFacts& facts, Planner& planner,
                         FramePlan& plan);

} // namespace scanout::frame
