// A high-pass: what a low-pass takes away, edges and noise, as brightness; flat parts are black.
#include "image/colour.h"
#include "image/convolution.h"
#include "math/srgb.h"

#include <array>

namespace scanout::image {

Plane high_pass(const Plane& plane) {
    Plane rest = low_pass(plane);
    for (std::size_t i = 0; i < rest.value.size(); ++i)
        rest.value[i] = plane.value[i] - rest.value[i];
    return rest;
}

namespace convolution {
namespace {

Image rest(const Image& picture) {
    std::array<Plane, 3> planes; // light times alpha
    planes.fill(Plane(picture.width(), picture.height()));
    for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
        const Rgba8& p = picture.pixels()[i];
        const DVec3 light = linear_light(p) * (p.a / 255.0);
        for (std::size_t c = 0; c < 3; ++c)
            planes[c].value[i] = light[static_cast<int>(c)];
    }
    for (Plane& plane : planes)
        plane = high_pass(plane);
    Image out(picture.width(), picture.height());
    for (std::size_t i = 0; i < out.pixels().size(); ++i) {
        const auto code = [&](std::size_t c) {
            const double value = planes[c].value[i];
            return srgb_encode(static_cast<float>(value < 0 ? -value : value));
        };
        out.pixels()[i] = {code(0), code(1), code(2), 255};
    }
    return out;
}

} // namespace

extern const Convolution high_pass;
constinit const Convolution high_pass{{.axis = "convolution",
                                       .name = "high_pass",
                                       .blurb = "shows what a low-pass takes away: edges",
                                       .source = "[C 6], identity less the binomial",
                                       .kind = Kind::model},
                                      rest,
                                      3 + 2}; // two while one is convolved

} // namespace convolution
} // namespace scanout::image
