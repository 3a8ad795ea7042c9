// The lights of one frame in view space, as the stages read them.
#pragma once

#include "frame/plan/plan.h"
#include "scene/light.h"
#include "scene/scene.h"
#include "shade/stage.h"

#include <array>
#include <cstddef>
#include <span>

namespace scanout::frame {

class FrameLights {
public:
    FrameLights(const FramePlan& plan, const scene::View& view, const geom::Mesh& mesh);

    // The light differs between pixels although its kind does not make it so: it casts a shadow.
    void set_varies(std::size_t light);
    // Sets the spans of `frame` that point into this object.
    void describe(shade::FrameState& frame) const;
    std::span<const scene::ViewLight> lights() const { return std::span(lights_).first(count_); }

private:
    Vec3 ambient_{0};
    std::array<scene::ViewLight, scene::kMaxLights> lights_; // without those from everywhere
    std::size_t count_ = 0;
    std::array<scene::ViewLight, scene::kMaxLights> hemispheres_;
    std::size_t hemisphere_count_ = 0;
    std::array<bool, scene::kMaxLights> varies_{};
    bool some_varies_ = false;
};

} // namespace scanout::frame
