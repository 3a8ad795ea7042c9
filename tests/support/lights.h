// The plain key and fill as a frame sees them, for tests that ask for the formula.
#pragma once

#include "scene/light.h"

#include <vector>

namespace scanout::test {

inline const std::vector<scene::ViewLight>& key_and_fill() {
    static const std::vector<scene::ViewLight> lights = [] {
        std::vector<scene::ViewLight> made;
        for (const scene::Light& light : scene::plain_lights())
            if (light.kind == scene::LightKind::directional)
                made.push_back(in_view(light, scene::View(), geom::Mesh()));
        return made;
    }();
    return lights;
}

inline scene::ViewLight directional(const Vec3& towards, const Vec3& colour = Vec3(1)) {
    scene::ViewLight light;
    light.towards = towards;
    light.colour = colour;
    return light;
}

} // namespace scanout::test
