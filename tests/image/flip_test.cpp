// FLIP: its laws, values that follow from the paper by hand, and the paper's equations written out
// plainly (whole kernels, libm) on small pictures.
#include "image/flip.h"
#include "pictures.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace scanout::image {
namespace {

using test::random_picture;

// --- the paper, plainly

using V3 = std::array<double, 3>;
constexpr double kPi = 3.14159265358979323846;

double linear(int code) {
    const double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}
constexpr double kM[3][3] = {{0.4123907993, 0.3575843394, 0.1804807884},
                             {0.2126390059, 0.7151686788, 0.0721923154},
                             {0.0193308187, 0.1191947798, 0.9505321522}};
constexpr double kInverse[3][3] = {{3.2409699419, -1.5373831776, -0.4986107603},
                                   {-0.9692436363, 1.8759675015, 0.0415550574},
                                   {0.0556300797, -0.2039769589, 1.0569715142}};
const V3 kReference = {kM[0][0] + kM[0][1] + kM[0][2], 1.0, kM[2][0] + kM[2][1] + kM[2][2]};

V3 times(const double (&m)[3][3], const V3& v) {
    V3 out{};
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            out[static_cast<std::size_t>(r)] += m[r][c] * v[static_cast<std::size_t>(c)];
    return out;
}
V3 opponent(const Rgba8& p) {
    const V3 xyz = times(kM, {linear(p.r), linear(p.g), linear(p.b)});
    const double x = xyz[0] / kReference[0], y = xyz[1], z = xyz[2] / kReference[2];
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}
V3 hunt_lab(const V3& rgb) {
    const V3 xyz = times(kM, rgb);
    const auto f = [](double t) {
        return t > std::pow(6.0 / 29, 3) ? std::cbrt(t) : t * 841 / 108 + 4.0 / 29;
    };
    const double x = f(xyz[0] / kReference[0]), y = f(xyz[1]), z = f(xyz[2] / kReference[2]);
    const double l = 116 * y - 16;
    return {l, 0.01 * l * 500 * (x - y), 0.01 * l * 200 * (y - z)};
}
double hyab(const V3& p, const V3& q) {
    return std::abs(p[0] - q[0]) + std::hypot(p[1] - q[1], p[2] - q[2]);
}
const Rgba8& clamped(const Image& image, int x, int y) {
    return image.at(std::clamp(x, 0, image.width() - 1), std::clamp(y, 0, image.height() - 1));
}

V3 perceived(const Image& image, int x, int y, double ppd) {
    constexpr double a[3][2] = {{1, 0}, {1, 0}, {34.1, 13.5}};
    constexpr double b[3][2] = {{0.0047, 1e-5}, {0.0053, 1e-5}, {0.04, 0.025}};
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * ppd));
    V3 sum{}, weights{};
    for (int dy = -radius; dy <= radius; ++dy)
        for (int dx = -radius; dx <= radius; ++dx) {
            const V3 c = opponent(clamped(image, x + dx, y + dy));
            const double d2 = (dx * dx + dy * dy) / (ppd * ppd);
            for (std::size_t k = 0; k < 3; ++k) {
                double w = 0;
                for (std::size_t i = 0; i < 2; ++i)
                    w += a[k][i] * std::sqrt(kPi / b[k][i]) * std::exp(-kPi * kPi * d2 / b[k][i]);
                sum[k] += w * c[k];
                weights[k] += w;
            }
        }
    for (std::size_t k = 0; k < 3; ++k)
        sum[k] /= weights[k];
    const double yy = (sum[0] + 16) / 116;
    V3 rgb = times(kInverse,
                   {(yy + sum[1] / 500) * kReference[0], yy, (yy - sum[2] / 200) * kReference[2]});
    for (double& channel : rgb)
        channel = std::clamp(channel, 0.0, 1.0);
    return hunt_lab(rgb);
}

// Strength of edges (order 1) or points (order 2).
double feature(const Image& image, int x, int y, int order, double ppd) {
    const double sd = 0.5 * 0.082 * ppd;
    const int radius = static_cast<int>(std::ceil(3 * sd));
    double sum[2][2] = {}, weight[2] = {}; // [axis][sign]
    for (int dy = -radius; dy <= radius; ++dy)
        for (int dx = -radius; dx <= radius; ++dx) {
            const double g = std::exp(-(dx * dx + dy * dy) / (2 * sd * sd));
            const double lum = (opponent(clamped(image, x + dx, y + dy))[0] + 16) / 116;
            for (int axis = 0; axis < 2; ++axis) {
                const double t = axis == 0 ? dx : dy;
                const double w = order == 1 ? -t * g : (t * t / (sd * sd) - 1) * g;
                sum[axis][w > 0 ? 1 : 0] += w * lum;
                if (axis == 0) weight[w > 0 ? 1 : 0] += std::abs(w);
            }
        }
    double part[2];
    for (int axis = 0; axis < 2; ++axis)
        part[axis] = sum[axis][1] / weight[1] + sum[axis][0] / weight[0];
    return std::hypot(part[0], part[1]);
}

double plain_flip(const Image& r, const Image& t, int x, int y) {
    const double ppd = kPixelsPerDegree;
    const double largest = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), 0.7);
    const double d = std::pow(hyab(perceived(r, x, y, ppd), perceived(t, x, y, ppd)), 0.7);
    const double bend = 0.4 * largest;
    const double colour = d < bend ? 0.95 / bend * d : 0.95 + (d - bend) / (largest - bend) * 0.05;
    double difference = 0;
    for (const int order : {1, 2})
        difference = std::max(
            difference, std::abs(feature(r, x, y, order, ppd) - feature(t, x, y, order, ppd)));
    return std::pow(colour, 1 - std::pow(difference / std::sqrt(2.0), 0.5));
}

TEST(Flip, IsWhatThePapersEquationsSay) {
    const Image a = random_picture(23, 17, 1, true);
    Image b = a;
    for (int y = 4; y < 12; ++y) // half of it changes, an edge appears
        for (int x = 3; x < 11; ++x)
            b.at(x, y) = {static_cast<std::uint8_t>(10 * x), 200, 40, 255};
    const std::vector<float> got = flip_map(a, b);
    double largest = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            const double expected = plain_flip(a, b, x, y);
            // The matrices above have ten digits, of which the root of a feature's difference
            // near 0 leaves five.
            ASSERT_NEAR(got[static_cast<std::size_t>(y * a.width() + x)], expected, 5e-5)
                << x << ',' << y;
            largest = std::max(largest, expected);
        }
    EXPECT_GT(largest, 0.5);
}

// What is far from every difference is not looked at, and nothing near one is forgotten.
TEST(Flip, IsThatOfTheWholePictureWhereLittleOfItDiffers) {
    const Image a = random_picture(64, 56, 3, true);
    Image b = a;
    b.at(30, 28) = {255, 0, 255, 255};
    b.at(33, 26) = {0, 255, 0, 255};
    const std::vector<float> got = flip_map(a, b);
    int shown = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            const float value = got[static_cast<std::size_t>(y * a.width() + x)];
            const bool far = x < 19 || x > 44 || y < 15 || y > 39;
            const double expected = far ? 0 : plain_flip(a, b, x, y);
            ASSERT_NEAR(value, expected, far ? 0 : 5e-5) << x << ',' << y;
            shown += value > 1e-4F ? 1 : 0;
        }
    EXPECT_GT(shown, 300) << "as far as the filters reach";
}

TEST(Flip, HasTheValuesThatFollowByHand) {
    const auto of = [](Rgba8 a, Rgba8 b) { return mean_flip(Image(40, 30, a), Image(40, 30, b)); };
    // Flat pictures have no features: the colour's part alone is left. The scale's end is green
    // against blue.
    EXPECT_NEAR(of({0, 255, 0, 255}, {0, 0, 255, 255}), 1, 1e-6);
    const double largest = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), 0.7);
    const double bend = 0.4 * largest;
    // Black and white lie 100 apart: 100^0.7 = 25.12, and largest = 41.28.
    EXPECT_NEAR(largest, 41.28, 0.01);
    const double black_white = std::pow(100, 0.7);
    EXPECT_NEAR(of({0, 0, 0, 255}, {255, 255, 255, 255}),
                0.95 + (black_white - bend) / (largest - bend) * 0.05, 1e-6);
    // Greys one code apart, on the steep part.
    const double grey = hyab(hunt_lab({linear(128), linear(128), linear(128)}),
                             hunt_lab({linear(129), linear(129), linear(129)}));
    EXPECT_NEAR(of({128, 128, 128, 255}, {129, 129, 129, 255}), 0.95 / bend * std::pow(grey, 0.7),
                1e-5);
}

TEST(Flip, IsZeroForEqualPicturesAndSymmetric) {
    for (unsigned seed = 0; seed < 5; ++seed) {
        const Image a = random_picture(31, 20, seed, true);
        const Image b = random_picture(31, 20, seed + 100, true);
        EXPECT_EQ(mean_flip(a, a), 0.0F);
        EXPECT_GT(mean_flip(a, b), 0.0F);
        EXPECT_EQ(flip_map(a, b), flip_map(b, a));
        for (const float value : flip_map(a, b)) {
            EXPECT_GE(value, 0);
            EXPECT_LE(value, 1);
        }
    }
    EXPECT_EQ(mean_flip(Image(), Image()), 0.0F);
}

TEST(Flip, TurnsWithThePicture) {
    const Image a = random_picture(25, 25, 7, true), b = random_picture(25, 25, 8, true);
    const auto turned = [](const Image& image) {
        Image out(image.height(), image.width());
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x)
                out.at(y, x) = image.at(x, y);
        return out;
    };
    EXPECT_NEAR(mean_flip(a, b), mean_flip(turned(a), turned(b)), 1e-6);
}

TEST(Flip, GrowsWithTheDifferenceAndSeesLessOfNoiseThanOfASurface) {
    const Image grey(48, 48, {128, 128, 128, 255});
    float before = 0;
    for (const int step : {1, 4, 16, 64, 127}) {
        const auto code = static_cast<std::uint8_t>(128 + step);
        const float now = mean_flip(grey, Image(48, 48, {code, code, code, 255}));
        EXPECT_GT(now, before);
        before = now;
    }
    // Blue-yellow noise of single pixels is finer than the eye resolves; as a surface it is seen.
    Image noise = grey;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 48; ++x)
            noise.at(x, y).b = (x + y) % 2 == 0 ? 158 : 98;
    EXPECT_LT(mean_flip(grey, noise), mean_flip(grey, Image(48, 48, {128, 128, 158, 255})) / 2);
}

} // namespace
} // namespace scanout::image
