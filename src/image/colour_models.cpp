#include "image/colour_models.h"

#include "math/srgb.h"
#include "math/transcendental.h"

#include <algorithm>

namespace scanout::image {
namespace {

// IEC 1999's curve, odd, so that light outside of the gamut has a place.
double linear_of(double encoded) {
    return encoded < 0 ? -linear_light_of_srgb(-encoded) : linear_light_of_srgb(encoded);
}
double encoded_of(double linear) {
    const double x = linear < 0 ? -linear : linear;
    const double y = x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055;
    return linear < 0 ? -y : y;
}
DVec3 to_linear(const DVec3& rgb) {
    return {linear_of(rgb.x), linear_of(rgb.y), linear_of(rgb.z)};
}
DVec3 to_encoded(const DVec3& linear) {
    return {encoded_of(linear.x), encoded_of(linear.y), encoded_of(linear.z)};
}

DVec3 codes(const DVec3& rgb) {
    return rgb * 255.0;
}
DVec3 of_codes(const DVec3& values) {
    return values / 255.0;
}

DVec3 complement(const DVec3& v) {
    return DVec3(1) - v;
}

DVec3 hsv_of(const DVec3& rgb) {
    const Hsv hsv = to_hsv(rgb);
    return {hsv.hue, hsv.saturation, hsv.value};
}
DVec3 of_hsv(const DVec3& v) {
    return from_hsv({v.x, v.y, v.z});
}

// Both hues are the same; lightness is the middle of the greatest and the least channel.
DVec3 hsl_of(const DVec3& rgb) {
    const double high = std::max({rgb.x, rgb.y, rgb.z}), low = std::min({rgb.x, rgb.y, rgb.z});
    const double lightness = (high + low) / 2, room = std::min(lightness, 1 - lightness);
    return {to_hsv(rgb).hue, room > 0 ? (high - lightness) / room : 0, lightness};
}
DVec3 of_hsl(const DVec3& v) {
    const double value = v.z + v.y * std::min(v.z, 1 - v.z);
    return from_hsv({v.x, value > 0 ? 2 * (1 - v.z / value) : 0, value});
}

// Luma's weights are those of ITU-R BT.601; a difference of 1 is 255 / 2 from the middle, 128.
constexpr double kRed = 0.299, kBlue = 0.114, kGreen = 1 - kRed - kBlue;
DVec3 ycbcr_of(const DVec3& rgb) {
    const double luma = (kRed * rgb.x + kGreen * rgb.y) + kBlue * rgb.z;
    return {255 * luma, 128 + 255 * (rgb.z - luma) / (2 * (1 - kBlue)),
            128 + 255 * (rgb.x - luma) / (2 * (1 - kRed))};
}
DVec3 of_ycbcr(const DVec3& v) {
    const double luma = v.x / 255;
    const double blue = luma + 2 * (1 - kBlue) * (v.y - 128) / 255;
    const double red = luma + 2 * (1 - kRed) * (v.z - 128) / 255;
    return {red, (luma - kRed * red - kBlue * blue) / kGreen, blue};
}

DVec3 xyz_of(const DVec3& rgb) {
    return to_xyz(to_linear(rgb));
}
DVec3 of_xyz(const DVec3& v) {
    return to_encoded(from_xyz(v));
}

DVec3 lab_of(const DVec3& rgb) {
    const Lab lab = to_lab(to_linear(rgb));
    return {lab.lightness, lab.a, lab.b};
}
DVec3 of_lab(const DVec3& v) {
    return to_encoded(from_lab({v.x, v.y, v.z}));
}

using Components = std::array<ColourComponent, 3>;
constexpr Components hue_and(std::string_view last) {
    return {{{"hue", 0, 360}, {"saturation", 0, 1}, {last, 0, 1}}};
}

constinit const std::array<ColourModel, 8> kModels{
    {{"rgb",
      {{{"red", 0, 255}, {"green", 0, 255}, {"blue", 0, 255}}},
      "codes of a screen (sRGB)",
      codes,
      of_codes},
     {"linear",
      {{{"red", 0, 1}, {"green", 0, 1}, {"blue", 0, 1}}},
      "shares of light",
      to_linear,
      to_encoded},
     {"cmy",
      {{{"cyan", 0, 1}, {"magenta", 0, 1}, {"yellow", 0, 1}}},
      "what a code lacks of white",
      complement,
      complement},
     {"hsv", hue_and("value"), "hue in degrees, saturation, value", hsv_of, of_hsv},
     {"hsl", hue_and("lightness"), "hue in degrees, saturation, lightness", hsl_of, of_hsl},
     {"ycbcr",
      {{{"y", 0, 255}, {"cb", 0, 255.5}, {"cr", 0, 255.5}}},
      "luma and differences to blue and red, as in JPEG",
      ycbcr_of,
      of_ycbcr},
     {"xyz",
      {{{"x", 0, 0.9505}, {"y", 0, 1}, {"z", 0, 1.0891}}},
      "CIE XYZ, white has y 1",
      xyz_of,
      of_xyz},
     {"lab",
      {{{"l", 0, 100}, {"a", -128, 127}, {"b", -128, 127}}},
      "CIELAB, white is D65",
      lab_of,
      of_lab}}};

} // namespace

std::span<const ColourModel> colour_models() {
    return kModels;
}

const ColourModel* find_colour_model(std::string_view name) {
    const auto* const found = std::find_if(kModels.begin(), kModels.end(),
                                           [&](const ColourModel& m) { return m.name == name; });
    return found == kModels.end() ? nullptr : found;
}

std::array<Image, 3> channels_of(const Image& picture, const ColourModel& model, Jobs& jobs,
                                 const std::function<void(double)>& progress) {
    const int width = picture.width(), height = picture.height();
    std::array<Image, 3> out;
    for (Image& channel : out)
        channel = Image::unwritten(width, height);
    const int rows_a_round = 32 * jobs.threads();
    for (int first = 0; first < height; first += rows_a_round) {
        const int rows = std::min(rows_a_round, height - first);
        jobs.for_each(rows, [&](int row, int /*worker*/) {
            const int y = first + row;
            for (int x = 0; x < width; ++x) {
                const Rgba8& p = picture.at(x, y);
                const DVec3 values = model.of_rgb(of_codes(DVec3(p.r, p.g, p.b)));
                for (std::size_t i = 0; i < out.size(); ++i) {
                    const ColourComponent& c = model.components[i];
                    const double share = (values[static_cast<int>(i)] - c.low) / (c.high - c.low);
                    const auto code =
                        static_cast<std::uint8_t>(255 * std::clamp(share, 0.0, 1.0) + 0.5);
                    out[i].at(x, y) = {code, code, code, p.a};
                }
            }
        });
        if (progress) progress(static_cast<double>(first + rows) / height);
    }
    return out;
}

} // namespace scanout::image
