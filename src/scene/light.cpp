#include "scene/light.h"

namespace scanout::scene {

const std::array<Light, 2>& default_lights() {
    // Whole-number directions with whole-number lengths: (-3, 4, 12) / 13 and (6, -2, 9) / 11.
    static const std::array<Light, 2> lights = {{
        {{-3.0F / 13, 4.0F / 13, 12.0F / 13}, Vec3(0.80F)},
        {{6.0F / 11, -2.0F / 11, 9.0F / 11}, Vec3(0.20F)},
    }};
    return lights;
}

} // namespace scanout::scene
