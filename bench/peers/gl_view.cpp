#include "bench/peers/gl_view.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

namespace scanout::bench {
namespace {

DMat4 affine(const scene::View& view) {
    DMat4 m(view.linear);
    m[3] = DVec4(view.translation, 1);
    return m;
}

} // namespace

DepthRange depth_range(const scene::View& view, bool inside) {
    if (inside) return {kInsideNear, kInsideFar};
    const double d = view.centre_distance;
    return {std::max(d - 1.05, d * 0.01), d + 1.05};
}

glm::mat4 to_view(const scene::View& view) {
    return glm::mat4(affine(view));
}

glm::mat4 to_clip(const scene::View& view, bool inside) {
    const auto [near, far] = depth_range(view, inside);
    DMat4 projection(0);
    projection[0][0] = 1 / view.half_width;
    projection[1][1] = 1 / view.half_height;
    projection[2][2] = (far + near) / (near - far);
    projection[3][2] = 2 * far * near / (near - far);
    projection[2][3] = -1;
    return glm::mat4(projection * affine(view));
}

glm::mat4 to_light_clip(const scene::View& view) {
    const DVec3 centre = view.translation, light = glm::normalize(kTowardsLight);
    const DMat4 look = glm::lookAt(centre + light * 2.0, centre, DVec3(0, 1, 0));
    return glm::mat4(glm::ortho(-1.0, 1.0, -1.0, 1.0, 1.0, 3.0) * look * affine(view));
}

} // namespace scanout::bench
