#include "frame/pass/lights.h"

#include "base/check.h"

namespace scanout::frame {

FrameLights::FrameLights(const FramePlan& plan, const scene::View& view, const geom::Mesh& mesh) {
    CHECK(plan.lights.size() <= scene::kMaxLights);
    for (std::size_t i = 0; i < plan.lights.size(); ++i) {
        scene::ViewLight light = in_view(plan.lights[i], view, mesh);
        if (light.kind == scene::LightKind::ambient) {
            ambient_ = ambient_ + light.colour;
            continue;
        }
        if (light.kind == scene::LightKind::hemisphere) {
            hemispheres_[hemisphere_count_++] = light;
            continue;
        }
        light.source = static_cast<std::uint32_t>(i);
        lights_[count_++] = light;
        if (light.kind != scene::LightKind::directional) set_varies(count_ - 1);
    }
}

void FrameLights::set_varies(std::size_t light) {
    CHECK(light < count_);
    varies_[light] = some_varies_ = true;
}

void FrameLights::describe(shade::FrameState& frame) const {
    frame.ambient = ambient_;
    frame.lights = lights();
    frame.hemispheres = {hemispheres_.data(), hemisphere_count_};
    if (some_varies_) frame.varies = {varies_.data(), count_};
}

} // namespace scanout::frame
