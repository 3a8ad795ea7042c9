// The ambient and diffuse part that the reflection models share.
#pragma once

#include "shade/stage.h"

namespace scanout::shade::reflection {

// Sets b.colour; lines and points get their plain albedo.
inline void diffuse(Block& b, const FrameState& frame) {
    for (int i = 0; i < b.count; ++i) {
        float light[3] = {scene::kAmbient, scene::kAmbient, scene::kAmbient};
        if (b.lit) {
            for (const scene::Light& l : frame.lights) {
                const float cosine = (b.normal[0][i] * l.towards.x + b.normal[1][i] * l.towards.y) +
                                     b.normal[2][i] * l.towards.z;
                const float facing = cosine > 0 ? cosine : 0.0F;
                light[0] += l.colour.x * facing;
                light[1] += l.colour.y * facing;
                light[2] += l.colour.z * facing;
            }
        } else {
            light[0] = light[1] = light[2] = 1.0F;
        }
        for (int c = 0; c < 3; ++c)
            b.colour[c][i] = b.albedo[c][i] * light[c];
    }
}

} // namespace scanout::shade::reflection
