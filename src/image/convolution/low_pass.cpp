// Low-pass: smooths variation within a few pixels away. After rendering it cannot undo aliasing, it
// only blurs it. [Primer 6].
#include "image/colour.h"
#include "image/convolution.h"
#include "math/srgb.h"

#include <array>

namespace scanout::image {

void low_pass(Plane& plane, Plane& between) {
    static constexpr std::array kBinomial = {1 / 16.0, 4 / 16.0, 6 / 16.0, 4 / 16.0, 1 / 16.0};
    convolve(plane, {kBinomial, 1}, {kBinomial, 1}, between);
}

namespace convolution {
namespace {

void smooth(Image& picture, std::vector<Plane>& planes) {
    planes.resize(4 + 1); // light times alpha, and alpha; one between
    for (Plane& plane : planes)
        plane.resize(picture.width(), picture.height());
    for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
        const Rgba8& p = picture.pixels()[i];
        const DVec3 light = linear_light(p) * static_cast<double>(p.a);
        for (std::size_t c = 0; c < 3; ++c)
            planes[c].value[i] = light[static_cast<int>(c)];
        planes[3].value[i] = p.a;
    }
    for (std::size_t c = 0; c < 4; ++c)
        image::low_pass(planes[c], planes[4]);
    for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
        const double alpha = planes[3].value[i];
        const auto code = [&](std::size_t c) {
            return srgb_encode(alpha > 0 ? static_cast<float>(planes[c].value[i] / alpha) : 0.0F);
        };
        picture.pixels()[i] = {code(0), code(1), code(2), static_cast<std::uint8_t>(alpha + 0.5)};
    }
}

} // namespace

extern const Convolution low_pass;
constinit const Convolution low_pass{{.axis = "convolution",
                                      .name = "low_pass",
                                      .blurb = "smooths what varies within 5 x 5 pixels",
                                      .source = "Burt and Adelson 1983",
                                      .kind = Kind::model},
                                     smooth,
                                     4 + 1};

} // namespace convolution
} // namespace scanout::image
