#include "image/colour.h"
#include "image/heat_map.h"
#include "image/metrics.h"
#include "pictures.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::image {
namespace {

using namespace test;

double linear_by_formula(int code) {
    const double x = code / 255.0;
    return x > 0.04045 ? std::pow((x + 0.055) / 1.055, 2.4) : x / 12.92;
}

// Two pixels, all by hand.
TEST(Metrics, AreTheFormulas) {
    Image a(2, 1, {100, 50, 200, 255}), b = a;
    b.at(1, 0) = {101, 52, 190, 255};
    const Metrics m = metrics(a, b);
    EXPECT_NEAR(m.rmse_codes, std::sqrt((1 + 4 + 100) / 6.0), 1e-12);
    const double r = linear_by_formula(101) - linear_by_formula(100),
                 g = linear_by_formula(52) - linear_by_formula(50),
                 blue = linear_by_formula(200) - linear_by_formula(190);
    const double rmse = std::sqrt((r * r + g * g + blue * blue) / 6);
    EXPECT_NEAR(m.rmse, rmse, 1e-7);
    EXPECT_NEAR(psnr(rmse), 10 * std::log10(1 / (rmse * rmse)), 1e-9);
    EXPECT_EQ(m.max_codes, 10);
    EXPECT_EQ(m.share_off, 0.5);
    b.at(1, 0) = {101, 49, 201, 255}; // no more than a code
    EXPECT_EQ(metrics(a, b).share_off, 0);
    EXPECT_EQ(metrics(a, b).max_codes, 1);
}

// A colour that alpha hides is no error; one that it shows in half is half of the light.
TEST(Metrics, CountWhatTransparentPixelsShow) {
    Image a(1, 1), b(1, 1);
    a.at(0, 0) = {255, 0, 0, 0};
    b.at(0, 0) = {0, 200, 90, 0};
    EXPECT_EQ(metrics(a, b).max_codes, 0);
    EXPECT_EQ(metrics(a, b).rmse_codes, 0);
    b.at(0, 0) = {255, 0, 0, 255}; // red over white differs in green and blue, over black in red
    EXPECT_EQ(metrics(a, b).max_codes, 255);
    EXPECT_NEAR(metrics(a, b).rmse, 1, 1e-7);
    a.at(0, 0) = {255, 255, 255, 51};
    b.at(0, 0) = {255, 255, 255, 102}; // light 0.2 and 0.4 over black
    EXPECT_NEAR(metrics(a, b).rmse, 0.2, 0.004);
}

RC_GTEST_PROP(Metrics, AreNothingForEqualPicturesAndSymmetric, ()) {
    const Image a = any_picture(false);
    const Metrics none = metrics(a, a);
    RC_ASSERT(none.rmse == 0 && none.rmse_codes == 0 && none.max_codes == 0 && none.share_off == 0);
    RC_ASSERT(std::isinf(psnr(none.rmse)));
    RC_ASSERT(std::abs(ssim(a, a) - 1) < 1e-12);
    const Image b = random_picture(a.width(), a.height(), 7, false);
    RC_ASSERT(metrics(a, b).rmse == metrics(b, a).rmse && ssim(a, b) == ssim(b, a));
}

// Wang et al. 2004, eq. 13, window by window, sums in plain order; the edge repeats where a side
// is shorter than a window.
double naive_ssim(const Image& a, const Image& b) {
    const int w = a.width(), h = a.height();
    const auto luma = [](const Rgba8& p) { return 0.299 * p.r + 0.587 * p.g + 0.114 * p.b; };
    double sum = 0;
    int windows = 0;
    for (int y = h < 11 ? 0 : 5; y < (h < 11 ? h : h - 5); ++y)
        for (int x = w < 11 ? 0 : 5; x < (w < 11 ? w : w - 5); ++x) {
            double total = 0, ma = 0, mb = 0, va = 0, vb = 0, cov = 0;
            for (int pass = 0; pass < 2; ++pass) // means first
                for (int v = -5; v <= 5; ++v)
                    for (int u = -5; u <= 5; ++u) {
                        const int i = std::clamp(x + u, 0, w - 1), j = std::clamp(y + v, 0, h - 1);
                        const double weight = std::exp(-(u * u + v * v) / (2 * 1.5 * 1.5));
                        const double p = luma(a.at(i, j)), q = luma(b.at(i, j));
                        if (pass == 0) {
                            total += weight;
                            ma += weight * p;
                            mb += weight * q;
                        } else {
                            va += weight / total * (p - ma / total) * (p - ma / total);
                            vb += weight / total * (q - mb / total) * (q - mb / total);
                            cov += weight / total * (p - ma / total) * (q - mb / total);
                        }
                    }
            ma /= total;
            mb /= total;
            const double c1 = 6.5025, c2 = 58.5225;
            sum +=
                (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
            ++windows;
        }
    return sum / windows;
}

TEST(Metrics, SsimIsTheFormulaWindowByWindow) {
    for (const auto& [w, height] : {std::pair(25, 18), std::pair(7, 20), std::pair(1, 1)}) {
        const int width = w;
        const Image a = random_picture(width, height, 1, true);
        Image b = a; // blurred a little, and darker to the right
        for (int y = 0; y < height; ++y)
            for (int x = 1; x < width; ++x) {
                const Rgba8 &p = a.at(x - 1, y), &q = a.at(x, y);
                const auto mix = [&](int s, int t) {
                    return static_cast<std::uint8_t>((s + 3 * t) / 4 * (width - x / 2) / width);
                };
                b.at(x, y) = {mix(p.r, q.r), mix(p.g, q.g), mix(p.b, q.b), 255};
            }
        EXPECT_NEAR(ssim(a, b), naive_ssim(a, b), 1e-9) << width << "x" << height;
        EXPECT_LT(ssim(a, b), width > 1 ? 0.99 : 1.01);
    }
}

double lightness(const Rgba8& colour) {
    return to_lab(linear_light(colour)).lightness;
}

// Eighths differ as much in lightness, to three tenths: a heat map reads in grey as well.
TEST(HeatMap, GetsLighterEvenly) {
    const double whole = lightness(heat_colour(1)) - lightness(heat_colour(0));
    EXPECT_GT(whole, 90);
    for (int i = 0; i < 8; ++i) {
        const double step = lightness(heat_colour((i + 1) / 8.0)) - lightness(heat_colour(i / 8.0));
        EXPECT_NEAR(step * 8 / whole, 1, 0.3) << i;
    }
    for (int i = 0; i < 200; ++i)
        EXPECT_LE(lightness(heat_colour(i / 200.0)), lightness(heat_colour((i + 1) / 200.0)));
    EXPECT_EQ(heat_colour(-1), heat_colour(0));
    EXPECT_EQ(heat_colour(2), heat_colour(1));
}

TEST(HeatMap, ShowsWhereAndHowMuch) {
    const Image a(3, 2, {10, 20, 30, 255});
    Image b = a;
    b.at(1, 1).b = 31;
    b.at(2, 0).r = 13;
    b.at(2, 0).g = 19;
    const Image map = heat_map(a, b);
    EXPECT_EQ(map.at(0, 0), heat_colour(0));
    EXPECT_EQ(map.at(1, 1), heat_colour(1.0 / 8));
    EXPECT_EQ(map.at(2, 0), heat_colour(2.0 / 8)); // 3 codes
    const std::vector<float> values{0, 0.25F, 0.5F, 0.75F, 1, 1};
    EXPECT_EQ(heat_map(3, 2, values).at(0, 1), heat_colour(0.75));
}

} // namespace
} // namespace scanout::image
