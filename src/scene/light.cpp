#include "scene/light.h"

namespace scanout::scene {

const std::array<Light, 2>& default_lights() {
    // Whole-number directions with whole-number lengths: (-2, 3, 6) / 7 and (6, -2, 3) / 7.
    static const std::array<Light, 2> lights = {{
        {{-2.0F / 7, 3.0F / 7, 6.0F / 7}, Vec3(0.80F)},
        {{6.0F / 7, -2.0F / 7, 3.0F / 7}, Vec3(0.15F)},
    }};
    return lights;
}

} // namespace scanout::scene
