#include "platform/tty/sixel_within.h"

#include "math/srgb.h"
#include "platform/tty/sixel.h"

#include <algorithm>

namespace scanout::tty {
namespace {

// Each square of `side` pixels is their average in linear light; what is cut off is smaller.
image::Image in_squares(const image::Image& image, int side) {
    image::Image squares(image.width(), image.height());
    for (int y0 = 0; y0 < image.height(); y0 += side)
        for (int x0 = 0; x0 < image.width(); x0 += side) {
            const int x1 = std::min(x0 + side, image.width());
            const int y1 = std::min(y0 + side, image.height());
            double r = 0, g = 0, b = 0;
            for (int y = y0; y < y1; ++y)
                for (int x = x0; x < x1; ++x) {
                    const image::Rgba8 p = image.at(x, y);
                    r += srgb_decode(p.r);
                    g += srgb_decode(p.g);
                    b += srgb_decode(p.b);
                }
            const double count = static_cast<double>(x1 - x0) * (y1 - y0);
            const auto encoded = [&](double sum) {
                return srgb_encode(static_cast<float>(sum / count));
            };
            const image::Rgba8 mean{encoded(r), encoded(g), encoded(b), 255};
            for (int y = y0; y < y1; ++y)
                for (int x = x0; x < x1; ++x)
                    squares.at(x, y) = mean;
        }
    return squares;
}

} // namespace

std::string sixel_within(const image::Image& image, int most_colours, std::size_t bytes) {
    std::string picture = sixel_picture(image, most_colours);
    for (int colours = most_colours; picture.size() > bytes && colours > 4;)
        picture = sixel_picture(image, colours /= 2);
    // A run of one colour takes 3 or 4 bytes, however long it is.
    for (int side = 8; picture.size() > bytes && side < 2 * std::max(image.width(), image.height());
         side *= 2)
        picture = sixel_picture(in_squares(image, side), std::min(most_colours, 16));
    return picture;
}

} // namespace scanout::tty
