// What shadows leave of a picture's light.
#pragma once

#include "support/scenes.h"

#include <string>
#include <vector>

namespace scanout::test {

inline scene::Light lamp(scene::LightKind kind) {
    scene::Light light = light_of(kind, 0.9);
    light.casts = true;
    return light;
}

// The share of its light that every pixel keeps, by the picture with shadows and that without; -1
// where there is none to lose.
inline std::vector<double> shares(Shot s, const std::string& technique) {
    shade::LinearPicture with, without;
    s.options.shadow = technique;
    s.options.effects["shadow"] = true; // where the plan sees no need for it, too
    draw(s, {.linear = &with});
    s.options.effects["shadow"] = false;
    draw(s, {.linear = &without});
    std::vector<double> share;
    for (std::size_t i = 0; i < with.pixel.size(); ++i)
        share.push_back(without.pixel[i][0] > 0x1p-12F
                            ? static_cast<double>(with.pixel[i][0] / without.pixel[i][0])
                            : -1);
    return share;
}

} // namespace scanout::test
