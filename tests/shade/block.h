// Blocks of lanes filled by the tests themselves, for one stage at a time.
#pragma once

#include "rows.h"
#include "shade/stage.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/targets.h"

#include <algorithm>
#include <cstring>
#include <memory>

#include <gtest/gtest.h>

namespace scanout::shade::test {

using scanout::test::Random;

// A block of 128 lanes, every lane the same white pixel facing the eye.
inline std::unique_ptr<ShadingBlock> new_block(const scene::Material& material) {
    auto b = std::make_unique<ShadingBlock>();
    b->count = kBlockSize;
    b->material = &material;
    b->ambient = Vec3(scene::kAmbient);
    for (int i = 0; i < kPaddedBlock; ++i) {
        for (int k = 0; k < 3; ++k) {
            b->normal[k][i] = k == 2 ? 1.0F : 0.0F;
            b->position[k][i] = k == 2 ? -1.0F : 0.0F;
            b->albedo[k][i] = 1;
            b->colour[k][i] = 0;
        }
        b->ray_x[i] = b->ray_y[i] = b->u[i] = b->v[i] = 0;
        b->x[i] = b->y[i] = 0;
        b->u_x[i] = b->v_x[i] = b->u_y[i] = b->v_y[i] = 0;
    }
    return b;
}

inline const Stage& stage(std::string_view axis, std::string_view name) {
    const Stage* found = find_stage(axis, name);
    EXPECT_NE(found, nullptr) << axis << ' ' << name;
    return *found;
}

// What stages write, of the lanes from first on.
inline bool same_lanes(const ShadingBlock& a, const ShadingBlock& b, int first, int end) {
    const auto same = [&](const float* x, const float* y) {
        return std::memcmp(x + first, y + first,
                           static_cast<std::size_t>(end - first) * sizeof(float)) == 0;
    };
    bool equal = same(a.u, b.u) && same(a.v, b.v) && same(a.u_x, b.u_x) && same(a.v_x, b.v_x) &&
                 same(a.u_y, b.u_y) && same(a.v_y, b.v_y);
    for (int c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < a.light.size(); ++k)
            equal = equal && same(a.light[k].towards[c], b.light[k].towards[c]) &&
                    same(a.light[k].colour[c], b.light[k].colour[c]);
    for (int c = 0; c < 3; ++c)
        equal = equal && same(a.position[c], b.position[c]) && same(a.normal[c], b.normal[c]) &&
                same(a.albedo[c], b.albedo[c]) && same(a.colour[c], b.colour[c]) &&
                same(a.specular[c], b.specular[c]);
    equal = equal && same(a.shininess, b.shininess);
    return equal;
}

// Runs the stage on every target of this CPU: all give the same bits, and write no lane beyond the
// widest register.
inline void run_stage(std::string_view axis, std::string_view name, ShadingBlock& block,
                      const FrameState& frame) {
    const Stage& chosen = axis == "texture" ? stage("map", "diffuse") : stage(axis, name);
    FrameState state = frame;
    if (axis == "texture") state.filter = find_row(shade::texture::kRows, name);
    const ShadingBlock before = block;
    const int touched = std::min((block.count + 15) / 16 * 16, kPaddedBlock);
    std::unique_ptr<ShadingBlock> first;
    scanout::test::on_every_target([&](const std::string&) {
        block = before;
        chosen.run(block, state);
        EXPECT_TRUE(same_lanes(block, before, touched, kPaddedBlock)) << axis << ' ' << name;
        if (first == nullptr) first = std::make_unique<ShadingBlock>(block);
        EXPECT_TRUE(same_lanes(block, *first, 0, block.count)) << axis << ' ' << name;
    });
}

inline FrameState identity_frame() {
    FrameState frame;
    for (int i = 0; i < 3; ++i)
        frame.normal_matrix[i][i] = 1;
    return frame;
}

} // namespace scanout::shade::test
