// The frame plan: from options and facts about the scene to the stages that run. A pure function,
// tested without drawing a pixel; it runs nothing that the scene does not call for.
#pragma once

#include "base/result.h"
#include "frame/options.h"
#include "scene/scene.h"
#include "shade/stage.h"

#include <string>
#include <vector>

namespace scanout::frame {

// Justified by the data, counted once when a model is loaded.
struct SceneFacts {
    std::size_t triangles = 0, lines = 0, points = 0;
    std::size_t textured_triangles = 0; // material has a readable map_Kd, and the mesh has uvs
    std::size_t specular_triangles = 0; // material has a highlight
    bool vertex_colours = false;
};
SceneFacts facts(const scene::Scene& scene);

struct FramePlan {
    FrameOptions options;
    // The stages of a block, in order: interpolation first, reflection last.
    std::vector<const shade::Stage*> stages;
    shade::Attributes attributes; // what has to be fetched for a block
    std::vector<std::string>
        reasons; // one line a decision: "texture bilinear: 5856 of 5856 triangles ..."
};

// Fails (Exit::usage) when the options name a technique or a size that does not exist.
Result<FramePlan> plan(const FrameOptions& options, const SceneFacts& facts);

} // namespace scanout::frame
