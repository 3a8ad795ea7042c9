// How a plan is built: row by row, in parts that each decide one kind of thing. Shared by the files
// plan*.cpp; everyone else wants frame/plan/plan.h.
#pragma once

#include "frame/facts/view_facts.h"
#include "frame/plan/plan.h"
#include "rows.h"

#include <string>
#include <string_view>

namespace scanout::frame {

Error no_such_technique(std::string_view axis, const std::string& asked);

// The row of an axis that the user asked for by name, or the automatic choice.
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

    // A row of an effect that is decided (see above); its techniques may be those of an axis.
    bool effect(std::string name, std::string_view technique, bool needed, std::string because,
                std::string_view axis = {});
    // Notes what was chosen on an axis that is no effect: its own option decides.
    void choice(std::string axis, std::string_view technique, const std::string& asked,
                std::string because, bool needed = true);
    void stage(const shade::Stage& stage);
    // A stage that another one calls; it reads `needs` of every lane.
    void called(const shade::Stage& stage, shade::Attributes needs);

private:
    const FrameOptions& options_;
    FramePlan& plan_;
};

// Sizes and counts that are possible.
Result<void> check_numbers(const FrameOptions& options);
// A plan of options that are checked. All of it but what plan_filter decides; nothing but these
// facts is asked of the view.
Result<FramePlan> plan_without_filter(const FrameOptions& options, const SceneFacts& facts,
                                      const ViewFacts& view);
// How the maps that the plan's stages read are filtered in a view, and which textures have mipmaps.
// Allocates nothing in a plan that was such a one before.
void plan_filter(FramePlan& plan, const SceneFacts& facts, const scene::View& view);

// map_Kd, or what is computed in its place.
Result<void> plan_texture(Planner& planner, FramePlan& plan, const SceneFacts& facts);
// Some light is not black; whether it reaches anything is another question.
bool some_light_shines(const FrameOptions& options);
// Does the user have physical materials reflect by Ks and Ns, as the others do?
bool by_ks_alone(const FramePlan& plan);
inline constexpr const char* kNoLight = "no light shines";
// Some light comes from a side. Ambient light alone is the same however a surface is turned.
bool has_directed_light(const FramePlan& plan); // after plan_light
inline constexpr const char* kNoDirection = "no light comes from a side: normals do not matter";
// Lights, sides, reflection, and how often they are evaluated.
Result<void> plan_light(Planner& planner, FramePlan& plan, const SceneFacts& facts,
                        const ViewFacts& view);
// The other maps, and light of the surfaces' own; after the light and the highlights are decided.
void plan_maps(Planner& planner, FramePlan& plan, const SceneFacts& facts);
// Which materials are cut out or blended, and how alpha is found.
Result<void> plan_transparency(Planner& planner, FramePlan& plan, const SceneFacts& facts);
// How what the stages read is read: where coordinates come from, and edges; after all that reads a
// map is decided.
Result<void> plan_sampling(Planner& planner, FramePlan& plan, const SceneFacts& facts);
// --blend none shows the nearest surface whole: as opaque ones are shown, and drawn as these, where
// the nearest is seen, and a pixel shows no more than its own samples.
bool blends_nothing(const FrameOptions& options);
// What is blended throws no shadow: what comes through it would have to be tinted.
void plan_casters(FramePlan& plan, const SceneFacts& facts);
// Which surfaces are seen, and how they are mixed: choices of the user's.
Result<void> plan_merging(Planner& planner, FramePlan& plan, const SceneFacts& facts);
// Marks in a buffer of their own. Where they are all that is shown, the second takes everything
// else out of a plan that is whole.
Result<void> plan_stencil(Planner& planner, FramePlan& plan, const SceneFacts& facts);
void plan_counts(FramePlan& plan);
// Is there light above 1, and what becomes of it? Highlights alone do not count: MTL means them to
// burn out, and a curve would dim all else for their sake.
Result<void> plan_tone(const FrameOptions& options, const SceneFacts& facts, Planner& planner,
                       FramePlan& plan);
// How edges are smoothed.
Result<void> plan_edges(const FrameOptions& options, const SceneFacts& facts, Planner& planner,
                        FramePlan& plan);
// From light to codes.
Result<void> plan_output(const FrameOptions& options, const SceneFacts& facts, Planner& planner,
                         FramePlan& plan);

} // namespace scanout::frame
