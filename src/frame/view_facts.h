// Facts about a view of a scene: what a plan asks of it, but for the size of textures
// (minification.h). They are few cases, found without drawing, and seldom change while a model
// turns: as long as they are the same, so is the plan.
#pragma once

#include "frame/back_faces.h"
#include "frame/facts.h"
#include "frame/options.h"
#include "scene/view.h"

#include <array>

namespace scanout::frame {

// Of a light that is not black.
struct LightFacts {
    bool reaches = true;           // some of it falls on the model
    bool shadows_disjoint = true;  // no component casts a shadow on another
    bool only_front_faces = false; // its shadow map needs no back faces
    friend bool operator==(const LightFacts&, const LightFacts&) = default;
};

struct ViewFacts {
    bool in_view = true; // some of the model may be seen; else the others are not found
    bool orthographic = false;
    bool inside = false; // the eye may be inside of a closed part
    BackFaces backs = BackFaces::none;
    std::array<LightFacts, scene::kMaxLights> lights{}; // of the options' lights
    friend bool operator==(const ViewFacts&, const ViewFacts&) = default;
};
// There are at most scene::kMaxLights.
ViewFacts view_facts(const FrameOptions& options, const SceneFacts& facts, const scene::View& view);

} // namespace scanout::frame
