// The lights of one frame, in view space: what the stages read of them.
#pragma once

#include "frame/plan.h"
#include "scene/light.h"
#include "scene/scene.h"
#include "shade/stage.h"

#include <array>
#include <vector>

namespace scanout::frame {

class FrameLights {
public:
    FrameLights(const FramePlan& plan, const scene::View& view, const geom::Mesh& mesh);

    // The light differs from lane to lane for another reason than its kind: a shadow.
    void set_varies(std::size_t light);
    // What points into this object.
    void describe(shade::FrameState& frame) const;
    const std::vector<scene::ViewLight>& lights() const { return lights_; }

private:
    Vec3 ambient_{0};
    std::vector<scene::ViewLight> lights_; // without the ambient ones
    std::array<bool, scene::kMostLights> varies_{};
    bool some_varies_ = false;
};

} // namespace scanout::frame
