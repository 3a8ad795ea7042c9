#include "frame/plan/step_limits.h"

#include <gtest/gtest.h>

namespace scanout::frame {
namespace {

// A map that repeats eight times spans eight times as many texels, so steps may err by an eighth.
TEST(StepLimits, TheScaleOfEachMapThatIsDrawnCounts) {
    FramePlan plan;
    plan.exposure = 1;
    for (const scene::NamedMap& row : scene::kTextureMaps) {
        scene::Scene scene;
        scene.textures.push_back({"a.png", image::Image(64, 16)});
        scene.materials.resize(2);
        const double plain = step_limits(scene, plan).uv;
        EXPECT_EQ(plain, 1.0 / 256 / 64);
        (scene.materials[1].*row.map).edit().scale = {2, -8, 1};
        EXPECT_EQ(step_limits(scene, plan).uv, row.drawn ? plain / 8 : plain) << row.name;
    }
}

} // namespace
} // namespace scanout::frame
