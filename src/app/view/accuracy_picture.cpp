#include "app/view/accuracy_picture.h"

#include "base/check.h"
#include "image/heat_map.h"
#include "math/transcendental.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace scanout::app {
namespace {

using trace::Known;

constexpr image::Rgba8 kUnknown{64, 64, 64, 255};

std::int64_t square_of_difference(const image::Rgba8& p, const image::Rgba8& q) {
    const std::int64_t r = p.r - q.r, g = p.g - q.g, b = p.b - q.b;
    return r * r + g * g + b * b;
}

void check_sizes(const image::Image& picture, const trace::Progressive& reference) {
    CHECK_EQ(picture.width(), reference.image().width());
    CHECK_EQ(picture.height(), reference.image().height());
}

// Sets each pixel from column `x0` on to of(pixel's number) where something is known of it, else to
// what the pixel above was set to; above the first of these nothing changes.
template <class F>
void fill_down(const trace::Progressive& reference, int x0, image::Image& out, F of) {
    const int width = out.width();
    std::vector<std::optional<image::Rgba8>> above(static_cast<std::size_t>(width));
    for (int y = 0; y < out.height(); ++y) {
        const auto row = out.row(y);
        for (int x = x0; x < width; ++x) {
            std::optional<image::Rgba8>& last = above[static_cast<std::size_t>(x)];
            const int pixel = y * width + x;
            if (reference.known(pixel) != Known::nothing)
                last = of(static_cast<std::size_t>(pixel));
            if (last) row[static_cast<std::size_t>(x)] = *last;
        }
    }
}

} // namespace

std::optional<ErrorFigures> error_figures(const image::Image& drawn,
                                          const trace::Progressive& reference) {
    check_sizes(drawn, reference);
    std::int64_t all = 0, open = 0, known = 0;
    const std::size_t count = drawn.pixels().size();
    for (std::size_t i = 0; i < count; ++i) {
        const Known what = reference.known(static_cast<int>(i));
        if (what == Known::nothing) continue;
        const std::int64_t square =
            square_of_difference(drawn.pixels()[i], reference.image().pixels()[i]);
        ++known;
        all += square;
        open += what == Known::final ? 0 : square;
    }
    if (known == 0) return std::nullopt;
    const auto root = [known](std::int64_t sum) {
        return sqrt(static_cast<double>(sum) / (3 * static_cast<double>(known)));
    };
    return ErrorFigures{root(all), root(open)};
}

void converging(const image::Image& drawn, const trace::Progressive& reference, image::Image& out) {
    check_sizes(drawn, reference);
    out = drawn;
    for (std::size_t i = 0; i < out.pixels().size(); ++i)
        if (reference.known(static_cast<int>(i)) == Known::final)
            out.pixels()[i] = reference.image().pixels()[i];
}

void error_map(const image::Image& drawn, const trace::Progressive& reference, image::Image& out) {
    check_sizes(drawn, reference);
    out = image::Image(drawn.width(), drawn.height(), kUnknown);
    const auto& colours = image::colours_of_differences();
    fill_down(reference, 0, out, [&](std::size_t i) {
        return colours[static_cast<std::size_t>(
            image::largest_difference(drawn.pixels()[i], reference.image().pixels()[i]))];
    });
}

void lay_reference(const trace::Progressive& reference, int x, image::Image& out) {
    check_sizes(out, reference);
    fill_down(reference, x, out, [&](std::size_t i) { return reference.image().pixels()[i]; });
}

} // namespace scanout::app
