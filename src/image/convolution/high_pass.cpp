// High-pass: shows the part that a low-pass removes, edges and noise, as brightness; flat parts are
// black.
#include "image/colour.h"
#include "image/convolution.h"
#include "math/srgb.h"

#include <algorithm>

namespace scanout::image {

void high_pass(Plane& plane, Plane& low, Plane& between) {
    low.resize(plane.width, plane.height);
    std::copy(plane.value.begin(), plane.value.end(), low.value.begin());
    low_pass(low, between);
    for (std::size_t i = 0; i < plane.value.size(); ++i)
        plane.value[i] -= low.value[i];
}

namespace convolution {
namespace {

void keep_rest(Image& picture, std::vector<Plane>& planes) {
    planes.resize(3 + 2); // light times alpha; two for one's low-pass
    for (Plane& plane : planes)
        plane.resize(picture.width(), picture.height());
    for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
        const Rgba8& p = picture.pixels()[i];
        const DVec3 light = linear_light(p) * (p.a / 255.0);
        for (std::size_t c = 0; c < 3; ++c)
            planes[c].value[i] = light[static_cast<int>(c)];
    }
    for (std::size_t c = 0; c < 3; ++c)
        image::high_pass(planes[c], planes[3], planes[4]);
    for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
        const auto code = [&](std::size_t c) {
            const double value = planes[c].value[i];
            return srgb_encode(static_cast<float>(value < 0 ? -value : value));
        };
        picture.pixels()[i] = {code(0), code(1), code(2), 255};
    }
}

} // namespace

extern const Convolution high_pass;
constinit const Convolution high_pass{{.axis = "convolution",
                                       .name = "high_pass",
                                       .blurb = "shows what a low-pass takes away: edges",
                                       .source = "Burt and Adelson 1983",
                                       .kind = Kind::model},
                                      keep_rest,
                                      3 + 2};

} // namespace convolution
} // namespace scanout::image
