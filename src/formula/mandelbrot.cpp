// The Mandelbrot set (Mandelbrot 1980): how many times z becomes z z + c before it is far away;
// points that stay are black. Between whole numbers by the logarithm of how far it went.
#include "formula/height_field.h"
#include "formula/makers.h"
#include "image/heat_map.h"
#include "math/transcendental.h"

#include <algorithm>

namespace scanout::formula {
namespace {

constexpr double kFar = 256; // |z|

// From 0, at once, to 1, never.
double stays(double re, double im, int iterations) {
    double x = 0, y = 0;
    for (int i = 0; i < iterations; ++i) {
        const double xx = x * x, yy = y * y;
        if (xx + yy > kFar * kFar) {
            const double smooth = std::max(i + 1 - log2(log2(xx + yy) / 2), 0.0);
            return std::min(log2(1 + smooth) / log2(2.0 + iterations), 1.0);
        }
        y = 2 * (x * y) + im;
        x = (xx - yy) + re;
    }
    return 1;
}

// The whole set, with square pixels, around -0.75.
image::Plane times(const Wanted& wanted, Jobs& jobs, const Progress& progress) {
    image::Plane out(wanted.width, wanted.height);
    const double pixel = 2.5 / std::min(wanted.width * 2.5 / 3, double(wanted.height));
    const int rows_a_round = 8 * jobs.threads();
    for (int first = 0; first < wanted.height; first += rows_a_round) {
        jobs.for_each(std::min(rows_a_round, wanted.height - first), [&](int row, int /*worker*/) {
            const int y = first + row;
            for (int x = 0; x < wanted.width; ++x)
                out.at(x, y) = stays(-0.75 + pixel * (x + 0.5 - wanted.width / 2.0),
                                     pixel * (wanted.height / 2.0 - (y + 0.5)), wanted.detail);
        });
        if (progress) progress(std::min(1.0, (first + rows_a_round) / double(wanted.height)));
    }
    return out;
}

} // namespace

image::Image mandelbrot_picture(const Wanted& wanted, Jobs& jobs, const Progress& progress) {
    const image::Plane plane = times(wanted, jobs, progress);
    image::Image out(wanted.width, wanted.height);
    for (std::size_t i = 0; i < plane.value.size(); ++i)
        out.pixels()[i] =
            plane.value[i] < 1 ? image::heat_colour(plane.value[i]) : image::Rgba8{0, 0, 0, 255};
    return out;
}

geom::PolygonMesh mandelbrot_model(const Wanted& wanted, Jobs& jobs, const Progress& progress) {
    return surface_of(times(wanted, jobs, progress), 0.5);
}

} // namespace scanout::formula
