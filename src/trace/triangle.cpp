#include "trace/triangle.h"

#include <cmath>
#include <utility>

namespace scanout::trace {

RayTest::RayTest(const Ray& ray) : from_(ray.from) {
    const DVec3 size = glm::abs(ray.way);
    z_ = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    x_ = (z_ + 1) % 3;
    y_ = (x_ + 1) % 3;
    if (ray.way[z_] < 0) std::swap(x_, y_); // keeps the winding
    shear_x_ = ray.way[x_] / ray.way[z_];
    shear_y_ = ray.way[y_] / ray.way[z_];
    shear_z_ = 1 / ray.way[z_];
}

Hit RayTest::meets(const Corners& corners, std::uint32_t triangle) const {
    // The ray becomes the z axis.
    double x[3], y[3], z[3];
    for (std::size_t i = 0; i < 3; ++i) {
        const DVec3 p = corners[i] - from_;
        x[i] = p[x_] - shear_x_ * p[z_];
        y[i] = p[y_] - shear_y_ * p[z_];
        z[i] = shear_z_ * p[z_];
    }
    // Opposite each corner; of a shared edge the same number, with the other sign.
    const double a = x[2] * y[1] - y[2] * x[1], b = x[0] * y[2] - y[0] * x[2],
                 c = x[1] * y[0] - y[1] * x[0];
    if ((a < 0 || b < 0 || c < 0) && (a > 0 || b > 0 || c > 0)) return {};
    const double sum = (a + b) + c;
    if (sum == 0) return {}; // seen edge on
    const double t = ((a * z[0] + b * z[1]) + c * z[2]) / sum;
    if (!std::isfinite(t)) return {};
    return {t, triangle, {a / sum, b / sum, c / sum}};
}

} // namespace scanout::trace
