// Builds a plan row by row: what the parts of plan() share. plan.cpp decides about light and
// transparency, plan_textures.cpp about textures.
#pragma once

#include "base/check.h"
#include "frame/plan.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

namespace scanout::frame {

// What the user asked for on an axis, or the automatic choice; fails where the axis has no such
// technique.
Result<std::string> choose(std::string_view axis, const std::string& asked,
                           std::string_view automatic);

class Planner {
public:
    Planner(const FrameOptions& options, FramePlan& plan) : options_(options), plan_(plan) {}

    // Decides an effect: on when the scene needs it, unless the user forces it. Returns whether.
    bool effect(std::string name, std::string technique, bool needed, std::string because) {
        const auto forced = options_.effects.find(name);
        const bool is_forced = forced != options_.effects.end();
        const bool on = is_forced ? forced->second : needed;
        plan_.decisions.push_back({std::move(name), on ? std::move(technique) : "off",
                                   std::move(because), needed, is_forced && on != needed, false});
        return on;
    }
    // Notes what was chosen on an axis that is no effect: its own option decides.
    void choice(std::string axis, std::string technique, const std::string& asked,
                std::string because, bool needed = true) {
        plan_.decisions.push_back({std::move(axis), std::move(technique), std::move(because),
                                   needed, asked != "auto", true});
    }
    void stage(std::string_view axis, std::string_view name) {
        const shade::Stage* found = shade::find_stage(axis, name);
        CHECK(found != nullptr);
        plan_.stages.push_back(found);
        plan_.techniques.push_back(&found->card);
        plan_.attributes = plan_.attributes | found->needs;
    }
    // A stage that another one calls; it reads `needs` of every lane.
    const shade::Stage* called(std::string_view axis, std::string_view name,
                               shade::Attributes needs) {
        const shade::Stage* found = shade::find_stage(axis, name);
        CHECK(found != nullptr);
        plan_.techniques.push_back(&found->card);
        plan_.attributes = plan_.attributes | needs;
        return found;
    }
    // For the stages that find colours, for those that find alpha, or both.
    void filter(const shade::Filter& filter, bool colour, bool alpha) {
        for (Decision& decision : plan_.decisions)
            if (decision.effect == "texture" && decision.on())
                decision.technique = filter.card.name;
        if (colour) {
            plan_.filter = &filter;
            plan_.attributes = plan_.attributes | filter.needs;
        }
        if (alpha) {
            plan_.transparency.filter = &filter;
            plan_.transparency.attributes = plan_.transparency.attributes | filter.needs;
        }
        const auto first_map = std::find_if(plan_.techniques.begin(), plan_.techniques.end(),
                                            [](const Technique* t) { return t->axis == "map"; });
        plan_.techniques.insert(first_map, &filter.card); // in the order of techniques.h
    }

private:
    const FrameOptions& options_;
    FramePlan& plan_;
};

// map_Kd, or what is computed in its place.
Result<void> plan_texture(Planner& planner, FramePlan& plan, const SceneFacts& facts);
// The other maps, and light of the surfaces' own; after the light and the highlights are decided.
void plan_maps(Planner& planner, FramePlan& plan, const SceneFacts& facts);
// How what the stages read is read: where coordinates come from, filter, mipmaps, edges; after all
// that reads a map is decided.
Result<void> plan_sampling(Planner& planner, FramePlan& plan, const SceneFacts& facts,
                           const scene::View& view);

} // namespace scanout::frame
