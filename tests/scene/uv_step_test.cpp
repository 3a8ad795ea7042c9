#include "scene/uv_step.h"

#include <gtest/gtest.h>

namespace scanout::scene {
namespace {

Material with_map(const Vec3& scale, bool clamp = false) {
    Material material;
    material.map_diffuse.edit().texture = 0;
    material.map_diffuse.edit().scale = scale;
    if (clamp)
        material.map_diffuse.edit().wrap_u = material.map_diffuse.edit().wrap_v = Wrap::clamp;
    return material;
}

TEST(UvStep, IsAnEvenNumberOfRepeatsOfEveryMap) {
    Material two = with_map(Vec3(0.3F, 1, 1));
    two.map_bump.edit().texture = 1;
    two.map_bump.edit().scale = Vec3(0.25F, 3, 1);
    Material not_read = with_map(Vec3(1));
    not_read.map_specular.edit().scale = Vec3(0.3F);
    const std::vector<DVec2> steps = uv_steps({{},
                                               with_map(Vec3(1)),
                                               with_map(Vec3(0.3F, -2.5F, 1)),
                                               two,
                                               not_read,
                                               with_map(Vec3(1), true),
                                               with_map(Vec3(1.41421356F, 1e-4F, 1)),
                                               with_map(Vec3(0, 7, 1))});
    const std::vector<DVec2> expected = {{2, 2}, {2, 2}, {20, 4}, {40, 2},
                                         {2, 2}, {0, 0}, {0, 0},  {2, 2}};
    EXPECT_EQ(steps, expected);
}

} // namespace
} // namespace scanout::scene
