#include "signal/frequencies.h"

#include "image/colour.h"
#include "math/srgb.h"
#include "math/transcendental.h"

#include <algorithm>
#include <array>

namespace scanout::signal {
namespace {

// The index of a frequency that is `place` from zero, either way: -n/2 rounded up to below n/2.
int signed_frequency(int index, int length) {
    return index <= (length - 1) / 2 ? index : index - length;
}

double squared(double x) {
    return x * x;
}

// As fractions of Nyquist's frequency, squared.
double squared_frequency(int x, int y, int width, int height) {
    return squared(2.0 * signed_frequency(x, width) / width) +
           squared(2.0 * signed_frequency(y, height) / height);
}

// Part `index` of `count` equal parts of the work.
Progress part_of(const Progress& progress, double index, double count) {
    if (!progress) return {};
    return [&progress, index, count](double share) { progress((index + share) / count); };
}

} // namespace

image::Image spectrum_picture(const image::Image& picture, Jobs& jobs, const Progress& progress) {
    const int width = picture.width(), height = picture.height();
    image::Plane luminance(width, height);
    for (std::size_t i = 0; i < luminance.value.size(); ++i)
        luminance.value[i] = image::to_xyz(image::linear_light(picture.pixels()[i])).y;
    const Spectrum s = spectrum_of(luminance, jobs, progress);
    // Rounding to a code errs by the root of 1/12 code a pixel, and as much in every wave.
    const double pixels = static_cast<double>(width) * height;
    const double noise = squared(1.0 / 255) / 12 * pixels;
    image::Plane strength(width, height);
    double strongest = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Complex wave = s.at(x, y);
            const double power = squared(wave.re) + squared(wave.im);
            // The root of power is strength; twice the logarithm is that of the square.
            const double grey = log2(1 + sqrt(power / noise));
            strength.at((x + width / 2) % width, (y + height / 2) % height) = grey;
            strongest = std::max(strongest, grey);
        }
    image::Image out(width, height);
    for (std::size_t i = 0; i < strength.value.size(); ++i) {
        const double share = strongest > 0 ? strength.value[i] / strongest : 0;
        const auto code = static_cast<std::uint8_t>(255 * share + 0.5);
        out.pixels()[i] = {code, code, code, 255};
    }
    return out;
}

image::Image kept(const image::Image& picture, const Band& band, Jobs& jobs,
                  const Progress& progress) {
    const int width = picture.width(), height = picture.height();
    image::Image out = picture;
    constexpr std::array kChannels = {&image::Rgba8::r, &image::Rgba8::g, &image::Rgba8::b};
    for (std::size_t channel = 0; channel < kChannels.size(); ++channel) {
        std::uint8_t image::Rgba8::*const code = kChannels[channel];
        const double step = 2 * static_cast<double>(channel), steps = 2.0 * kChannels.size();
        image::Plane light(width, height);
        for (std::size_t i = 0; i < light.value.size(); ++i)
            light.value[i] = srgb_decode(picture.pixels()[i].*code);
        Spectrum s = spectrum_of(light, jobs, part_of(progress, step, steps));
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double f = squared_frequency(x, y, width, height);
                if (f < squared(band.low) || f > squared(band.high)) s.at(x, y) = {};
            }
        light = plane_of(std::move(s), jobs, part_of(progress, step + 1, steps));
        const double grey = band.low > 0 ? 0.5 : 0;
        for (std::size_t i = 0; i < light.value.size(); ++i)
            out.pixels()[i].*code = srgb_encode(static_cast<float>(light.value[i] + grey));
    }
    return out;
}

std::int64_t spectrum_bytes(int width, int height) {
    return std::int64_t{width} * height * std::int64_t{sizeof(Complex) + 2 * sizeof(double)};
}

} // namespace scanout::signal
