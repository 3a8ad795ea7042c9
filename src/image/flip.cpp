#include "image/flip.h"

#include "base/check.h"
#include "image/colour.h"
#include "image/plane.h"
#include "math/transcendental.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace scanout::image {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kLog2E = 1.44269504088896340736;

// The paper's constants: the exponent of colour differences, where the map's bend stands, the
// width of features in degrees, the exponent of feature differences.
constexpr double kColourExponent = 0.7, kBendFrom = 0.4, kBendTo = 0.95;
constexpr double kFeatureWidth = 0.082, kFeatureExponent = 0.5;

double exponential(double x) {
    return exp2(x * kLog2E);
}

// --- colour: the detail that the eye resolves at this distance, in L*a*b* with Hunt's effect

// The opponent space of Johnson and Fairchild: luminance, red-green, blue-yellow.
DVec3 to_opponent(const DVec3& linear) {
    const DVec3 t = to_xyz(linear) / kWhite;
    return {116 * t.y - 16, 500 * (t.x - t.y), 200 * (t.y - t.z)};
}
DVec3 from_opponent(const DVec3& c) {
    const double y = (c.x + 16) / 116;
    return from_xyz(DVec3(y + c.y / 500, y, y - c.z / 200) * kWhite);
}

// One Gaussian of a contrast sensitivity: a sqrt(pi / b) exp(-(pi x)^2 / b), x in degrees.
struct Sensitivity {
    double a, b;
};
constexpr Sensitivity kLuminance{1, 0.0047}, kRedGreen{1, 0.0053};
constexpr Sensitivity kBlueYellow[2] = {{34.1, 0.04}, {13.5, 0.025}};

int sensitivity_radius() { // three deviations of the widest
    return static_cast<int>(3 * sqrt(kBlueYellow[0].b / (2 * kPi * kPi)) * kPixelsPerDegree) + 1;
}

// The weights along one side, whose product with themselves is the Gaussian. `total` is the sum
// over the square, by which the caller divides.
std::vector<double> side_of(const Sensitivity& s) {
    const int radius = sensitivity_radius();
    std::vector<double> weights;
    for (int i = -radius; i <= radius; ++i) {
        const double x = i / kPixelsPerDegree;
        weights.push_back(sqrt(s.a * sqrt(kPi / s.b)) * exponential(-kPi * kPi * x * x / s.b));
    }
    return weights;
}

double total(const std::vector<double>& weights) {
    double sum = 0;
    for (const double w : weights)
        sum += w;
    return sum;
}

Plane blurred(const Plane& plane, const Sensitivity& sensitivity) {
    std::vector<double> side = side_of(sensitivity);
    const double sum = total(side);
    for (double& w : side)
        w /= sum;
    return convolve(plane, {side, 1}, {side, 1});
}

// The sum of two Gaussians is not separable, each is: mixed by their volumes.
Plane blurred_blue_yellow(const Plane& plane) {
    double volume[2];
    for (int i = 0; i < 2; ++i) {
        const double sum = total(side_of(kBlueYellow[i]));
        volume[i] = sum * sum;
    }
    Plane out = blurred(plane, kBlueYellow[0]);
    const Plane second = blurred(plane, kBlueYellow[1]);
    const double share = volume[1] / (volume[0] + volume[1]);
    for (std::size_t i = 0; i < out.value.size(); ++i)
        out.value[i] += share * (second.value[i] - out.value[i]);
    return out;
}

Lab with_hunt(const DVec3& linear) { // colours look paler in the dark
    const Lab lab = to_lab(linear);
    return {lab.lightness, 0.01 * lab.lightness * lab.a, 0.01 * lab.lightness * lab.b};
}

// HyAB (Abasi, Amani Tehran and Fairchild 2020): city block in lightness, Euclid in a and b.
double distance(const Lab& p, const Lab& q) {
    const double l = p.lightness - q.lightness, a = p.a - q.a, b = p.b - q.b;
    return (l < 0 ? -l : l) + sqrt(a * a + b * b);
}

std::array<Plane, 3> opponents(const Image& image) {
    std::array<Plane, 3> planes;
    for (Plane& plane : planes)
        plane = Plane(image.width(), image.height());
    for (std::size_t i = 0; i < image.pixels().size(); ++i) {
        const DVec3 c = to_opponent(linear_light(image.pixels()[i]));
        for (std::size_t k = 0; k < 3; ++k)
            planes[k].value[i] = c[static_cast<int>(k)];
    }
    return planes;
}

std::vector<Lab> perceived(const std::array<Plane, 3>& opponent) {
    const Plane luminance = blurred(opponent[0], kLuminance);
    const Plane red_green = blurred(opponent[1], kRedGreen);
    const Plane blue_yellow = blurred_blue_yellow(opponent[2]);
    std::vector<Lab> out(luminance.value.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        DVec3 rgb = from_opponent({luminance.value[i], red_green.value[i], blue_yellow.value[i]});
        for (int c = 0; c < 3; ++c)
            rgb[c] = std::clamp(rgb[c], 0.0, 1.0);
        out[i] = with_hunt(rgb);
    }
    return out;
}

// Differences to the power 0.7, the lower 40 % of their range spread over 95 % of the scale.
struct ColourScale {
    double largest = pow(distance(with_hunt({0, 1, 0}), with_hunt({0, 0, 1})), kColourExponent);

    double operator()(const Lab& p, const Lab& q) const {
        const double d = distance(p, q);
        if (d <= 0) return 0;
        const double powered = pow(d, kColourExponent), bend = kBendFrom * largest;
        const double scaled = powered < bend
                                  ? kBendTo / bend * powered
                                  : kBendTo + (powered - bend) / (largest - bend) * (1 - kBendTo);
        return std::min(scaled, 1.0);
    }
};

// --- features: edges and points in luminance, unfiltered

// A derivative of a Gaussian, its positive and its negative weights each of sum 1.
std::vector<double> balanced(std::vector<double> weights) {
    double positive = 0, negative = 0;
    for (const double w : weights)
        (w > 0 ? positive : negative) += w;
    for (double& w : weights)
        w /= w > 0 ? positive : -negative;
    return weights;
}

struct Features {
    Plane edge, point; // magnitude, for all directions
};

Plane length_of(const Plane& x, const Plane& y) {
    Plane out(x.width, x.height);
    for (std::size_t i = 0; i < out.value.size(); ++i)
        out.value[i] = sqrt(x.value[i] * x.value[i] + y.value[i] * y.value[i]);
    return out;
}

constexpr double kFeatureDeviation = 0.5 * kFeatureWidth * kPixelsPerDegree;
constexpr int feature_radius() {
    return static_cast<int>(3 * kFeatureDeviation) + 1;
}

Features features(Plane luminance) {
    for (double& y : luminance.value)
        y = (y + 16) / 116; // [0, 1]
    constexpr double deviation = kFeatureDeviation;
    constexpr int radius = feature_radius();
    std::vector<double> smooth, slope, bend;
    for (int x = -radius; x <= radius; ++x) {
        const double g = exponential(-(x * x) / (2 * deviation * deviation));
        smooth.push_back(g);
        slope.push_back(-x * g);
        bend.push_back((x * x / (deviation * deviation) - 1) * g);
    }
    const double sum = total(smooth);
    for (double& w : smooth)
        w /= sum;
    slope = balanced(std::move(slope));
    bend = balanced(std::move(bend));
    const Side along{smooth, 1};
    return {
        length_of(convolve(luminance, {slope, 0}, along), convolve(luminance, along, {slope, 0})),
        length_of(convolve(luminance, {bend, 0}, along), convolve(luminance, along, {bend, 0}))};
}

double magnitude_of_difference(double a, double b) {
    return a > b ? a - b : b - a;
}

std::vector<float> map_of_all(const Image& reference, const Image& test) {
    std::vector<float> map(reference.pixels().size());
    const auto opponents_r = opponents(reference), opponents_t = opponents(test);
    const std::vector<Lab> seen_r = perceived(opponents_r), seen_t = perceived(opponents_t);
    const Features features_r = features(opponents_r[0]), features_t = features(opponents_t[0]);
    const ColourScale scale;
    for (std::size_t i = 0; i < map.size(); ++i) {
        const double colour = scale(seen_r[i], seen_t[i]);
        if (colour <= 0) continue; // 0 to a power of at least 0
        const double feature =
            std::max(magnitude_of_difference(features_r.edge.value[i], features_t.edge.value[i]),
                     magnitude_of_difference(features_r.point.value[i], features_t.point.value[i]));
        const double feature_error = std::min(pow(feature / sqrt(2.0), kFeatureExponent), 1.0);
        map[i] = static_cast<float>(pow(colour, 1 - feature_error));
    }
    return map;
}

// The part of the picture where a difference can show, and the part that its filters read: one
// filter radius around pixels that differ, and one radius more. Beyond, the map is 0.
Rect surroundings_of_differences(const Image& reference, const Image& test) {
    Rect box{reference.width(), reference.height(), 0, 0};
    for (int y = 0; y < reference.height(); ++y)
        for (int x = 0; x < reference.width(); ++x) {
            if (reference.at(x, y) == test.at(x, y)) continue;
            box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1),
                   std::max(box.y1, y + 1)};
        }
    const int reach = 2 * std::max(sensitivity_radius(), feature_radius());
    return {std::max(box.x0 - reach, 0), std::max(box.y0 - reach, 0),
            std::min(box.x1 + reach, reference.width()),
            std::min(box.y1 + reach, reference.height())};
}

Image part_of(const Image& image, const Rect& area) {
    Image part(area.width(), area.height());
    for (int y = 0; y < area.height(); ++y)
        for (int x = 0; x < area.width(); ++x)
            part.at(x, y) = image.at(area.x0 + x, area.y0 + y);
    return part;
}

} // namespace

std::vector<float> flip_map(const Image& reference, const Image& test) {
    CHECK(reference.width() == test.width() && reference.height() == test.height());
    std::vector<float> map(reference.pixels().size());
    if (map.empty() || reference == test) return map;
    const Rect area = surroundings_of_differences(reference, test);
    const std::vector<float> part = map_of_all(part_of(reference, area), part_of(test, area));
    const auto width = static_cast<std::size_t>(area.width());
    for (std::size_t y = 0; y < static_cast<std::size_t>(area.height()); ++y)
        std::copy_n(part.begin() + static_cast<std::ptrdiff_t>(y * width), width,
                    map.begin() + static_cast<std::ptrdiff_t>(
                                      (static_cast<std::size_t>(area.y0) + y) *
                                          static_cast<std::size_t>(reference.width()) +
                                      static_cast<std::size_t>(area.x0)));
    return map;
}

float mean_flip(const Image& reference, const Image& test) {
    const std::vector<float> map = flip_map(reference, test);
    double sum = 0;
    for (const float pixel : map)
        sum += double{pixel};
    return map.empty() ? 0.0F : static_cast<float>(sum / static_cast<double>(map.size()));
}

} // namespace scanout::image
