// Blocks of lanes filled by the tests themselves, for one stage at a time.
#pragma once

#include "shade/stage.h"
#include "support/meshes.h"
#include "support/random.h"

#include <algorithm>
#include <memory>

#include <gtest/gtest.h>

namespace scanout::shade::test {

using scanout::test::Random;

// A block of 128 lanes, every lane the same unlit, white pixel facing the eye.
inline std::unique_ptr<Block> new_block(const scene::Material& material) {
    auto b = std::make_unique<Block>();
    b->count = kLanes;
    b->material = &material;
    for (int i = 0; i < kLanes; ++i) {
        for (int k = 0; k < 3; ++k) {
            b->vertex[k][i] = static_cast<std::uint32_t>(k);
            b->area[k][i] = k == 0 ? 1.0F : 0.0F;
            b->inverse_w[k][i] = 1;
            b->facing[k][i] = k == 2 ? 1.0F : 0.0F;
            b->normal[k][i] = k == 2 ? 1.0F : 0.0F;
            b->albedo[k][i] = 1;
        }
        b->ray_x[i] = b->ray_y[i] = b->u[i] = b->v[i] = 0;
    }
    return b;
}

inline const Stage& stage(std::string_view axis, std::string_view name) {
    const Stage* found = find(axis, name);
    EXPECT_NE(found, nullptr) << axis << ' ' << name;
    return *found;
}

inline FrameState identity_frame() {
    FrameState frame;
    for (int i = 0; i < 3; ++i)
        frame.normal_matrix[i][i] = 1;
    return frame;
}

} // namespace scanout::shade::test
