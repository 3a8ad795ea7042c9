#include "image/metrics.h"

#include "base/check.h"
#include "image/plane.h"
#include "math/srgb.h"
#include "math/transcendental.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <vector>

namespace scanout::image {
namespace {

constexpr int kWindowRadius = 5;
constexpr double kWindowDeviation = 1.5; // pixels

std::vector<double> window_side() {
    constexpr double kLog2E = 1.44269504088896340736;
    std::vector<double> weight;
    double sum = 0;
    for (int i = -kWindowRadius; i <= kWindowRadius; ++i) {
        weight.push_back(exp2(-i * i / (2 * kWindowDeviation * kWindowDeviation) * kLog2E));
        sum += weight.back();
    }
    for (double& w : weight)
        w /= sum;
    return weight;
}

Plane luma(const Image& image) {
    Plane plane(image.width(), image.height());
    for (std::size_t i = 0; i < plane.value.size(); ++i) {
        const Rgba8& p = image.pixels()[i];
        plane.value[i] = (0.299 * p.r + 0.587 * p.g) + 0.114 * p.b;
    }
    return plane;
}

Plane product(const Plane& a, const Plane& b) {
    Plane plane(a.width, a.height);
    for (std::size_t i = 0; i < plane.value.size(); ++i)
        plane.value[i] = a.value[i] * b.value[i];
    return plane;
}

// Of one window, from its means, variances and covariance.
double similarity(double mean_a, double mean_b, double variance_a, double variance_b,
                  double covariance) {
    constexpr double kC1 = (0.01 * 255) * (0.01 * 255), kC2 = (0.03 * 255) * (0.03 * 255);
    return (2 * mean_a * mean_b + kC1) * (2 * covariance + kC2) /
           ((mean_a * mean_a + mean_b * mean_b + kC1) * (variance_a + variance_b + kC2));
}

// The code of a channel over a background of light 0 or 1.
std::uint8_t shown(std::uint8_t code, std::uint8_t alpha, float background) {
    if (alpha == 255) return code;
    const float opacity = static_cast<float>(alpha) / 255;
    return srgb_encode(srgb_decode(code) * opacity + background * (1 - opacity));
}

void check_sizes(const Image& a, const Image& b) {
    CHECK(a.width() == b.width() && a.height() == b.height());
}

} // namespace

Metrics metrics(const Image& reference, const Image& test) {
    check_sizes(reference, test);
    Metrics m;
    double codes = 0, light = 0;
    std::size_t off = 0;
    for (std::size_t i = 0; i < reference.pixels().size(); ++i) {
        const Rgba8 &p = reference.pixels()[i], &q = test.pixels()[i];
        if (p == q) continue;
        int largest = 0;
        const auto add = [&](std::uint8_t of_p, std::uint8_t of_q) {
            std::uint8_t a = shown(of_p, p.a, 0), b = shown(of_q, q.a, 0);
            if (p.a != 255 || q.a != 255) {
                const std::uint8_t white_a = shown(of_p, p.a, 1), white_b = shown(of_q, q.a, 1);
                if (std::abs(white_a - white_b) > std::abs(a - b)) {
                    a = white_a;
                    b = white_b;
                }
            }
            const int difference = std::abs(a - b);
            const double of_light = double{srgb_decode(a)} - double{srgb_decode(b)};
            largest = std::max(largest, difference);
            codes += static_cast<double>(difference * difference);
            light += of_light * of_light;
        };
        add(p.r, q.r);
        add(p.g, q.g);
        add(p.b, q.b);
        m.max_codes = std::max(m.max_codes, largest);
        off += largest > 1 ? 1 : 0;
    }
    const auto pixels = static_cast<double>(std::max<std::size_t>(reference.pixels().size(), 1));
    m.rmse_codes = sqrt(codes / (3 * pixels));
    m.rmse = sqrt(light / (3 * pixels));
    m.share_off = static_cast<double>(off) / pixels;
    return m;
}

double psnr(double rmse) {
    constexpr double kLog2Of10 = 3.32192809488736234787;
    if (rmse <= 0) return std::numeric_limits<double>::infinity();
    return -20 * log2(rmse) / kLog2Of10;
}

std::vector<double> ssim_map(const Image& reference, const Image& test) {
    check_sizes(reference, test);
    const std::vector<double> weight = window_side();
    const Side side{weight, 1};
    const auto mean = [&](const Plane& plane) { return convolve(plane, side, side); };
    const Plane a = luma(reference), b = luma(test);
    const Plane mean_a = mean(a), mean_b = mean(b), mean_aa = mean(product(a, a)),
                mean_bb = mean(product(b, b)), mean_ab = mean(product(a, b));
    std::vector<double> map;
    map.reserve(reference.pixels().size());
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            const double p = mean_a.at(x, y), q = mean_b.at(x, y);
            map.push_back(similarity(p, q, mean_aa.at(x, y) - p * p, mean_bb.at(x, y) - q * q,
                                     mean_ab.at(x, y) - p * q));
        }
    return map;
}

double ssim(const Image& reference, const Image& test) {
    if (reference.pixels().empty()) return 1;
    const std::vector<double> map = ssim_map(reference, test);
    const auto margin = [](int size) { return size > 2 * kWindowRadius ? kWindowRadius : 0; };
    const int width = reference.width(), height = reference.height(), left = margin(width),
              top = margin(height);
    double sum = 0;
    for (int y = top; y < height - top; ++y)
        for (int x = left; x < width - left; ++x)
            sum += map[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                       static_cast<std::size_t>(x)];
    return sum / (static_cast<double>(width - 2 * left) * (height - 2 * top));
}

} // namespace scanout::image
