// Facts about a view of a scene, found before drawing: everything that a plan reads of the view
// except minification. They seldom change while a model turns; while they stay the same, so does
// the plan (temporal coherence: plan_cache.h).
#pragma once

#include "frame/facts/back_faces.h"
#include "frame/facts/facts.h"
#include "frame/options.h"
#include "raster/culling/cull.h"
#include "scene/view.h"

#include <array>
#include <limits>

namespace scanout::frame {

// Facts about a light that is not black.
struct LightFacts {
    bool reaches = true;           // some of it falls on the model
    bool shadows_disjoint = true;  // no component casts a shadow on another
    bool only_front_faces = false; // its shadow map needs no back faces
    // The sides of all faces that lie within closed components, outside of which it stands.
    raster::Facing inner = raster::Facing::any;
    friend bool operator==(const LightFacts&, const LightFacts&) = default;
};

struct ViewFacts {
    bool in_view = true; // some of the model may be seen; if not, the other facts are not found
    bool orthographic = false;
    bool inside = false; // the eye may be inside of a closed part
    BackFaces backs = BackFaces::none;
    // Reversed depths between which is drawn, where the caller gives a near or a far plane.
    float farthest = -std::numeric_limits<float>::infinity(),
          nearest = std::numeric_limits<float>::infinity();
    double reach = 0;                                   // depth_reach, where --depth asks for it
    std::array<LightFacts, scene::kMaxLights> lights{}; // of the options' lights
    friend bool operator==(const ViewFacts&, const ViewFacts&) = default;
};
// How many times as far as the near plane the model ends, or the caller's far plane is; without
// perspective 0.
double depth_reach(const scene::View& view);
// There are at most scene::kMaxLights.
ViewFacts view_facts(const FrameOptions& options, const SceneFacts& facts, const scene::View& view);

} // namespace scanout::frame
