// Convolution: its laws, and the plain sum.
#include "image/plane.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace scanout::image {
namespace {

Plane noise(int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    Plane plane(width, height);
    for (double& v : plane.value)
        v = unit(random);
    return plane;
}

Kernel any_kernel(int width, int height, unsigned seed) {
    const Plane weights = noise(width, height, seed);
    Kernel kernel{width, height, weights.value, 0};
    for (const double w : kernel.weight)
        kernel.gain += w;
    return kernel;
}

// As it is written in books.
double plain_sum(const Plane& p, const Kernel& k, int x, int y) {
    double sum = 0;
    for (int j = 0; j < k.height; ++j)
        for (int i = 0; i < k.width; ++i)
            sum += k.weight[static_cast<std::size_t>(j * k.width + i)] *
                   p.at(std::clamp(x + i - k.width / 2, 0, p.width - 1),
                        std::clamp(y + j - k.height / 2, 0, p.height - 1));
    return sum;
}

TEST(Convolution, IsThePlainSumWithTheEdgeRepeated) {
    for (const auto& [w, h] : {std::pair{1, 1}, {1, 9}, {17, 2}, {20, 13}})
        for (const auto& [kw, kh] : {std::pair{1, 1}, {3, 3}, {5, 1}, {1, 7}, {7, 9}}) {
            const Plane plane = noise(w, h, 1);
            const Kernel kernel = any_kernel(kw, kh, 2);
            const Plane got = convolve(plane, kernel);
            for (int y = 0; y < h; ++y)
                for (int x = 0; x < w; ++x)
                    ASSERT_NEAR(got.at(x, y), plain_sum(plane, kernel, x, y), 1e-12);
        }
}

TEST(Convolution, InTwoPassesIsThatOfTheProduct) {
    const Plane plane = noise(19, 12, 3);
    const Kernel across = any_kernel(7, 1, 4), down = any_kernel(1, 5, 5);
    Kernel product{7, 5, {}, across.gain * down.gain};
    for (const double d : down.weight)
        for (const double a : across.weight)
            product.weight.push_back(a * d);
    const Plane two = convolve(plane, {across.weight, across.gain}, {down.weight, down.gain});
    const Plane one = convolve(plane, product);
    for (std::size_t i = 0; i < one.value.size(); ++i)
        ASSERT_NEAR(two.value[i], one.value[i], 1e-12);
}

TEST(Convolution, KeepsAConstantOrRemovesItToTheBit) {
    // Thirds have no double: their sum is not 1, and a plain sum would show it.
    const std::vector<double> thirds(3, 1.0 / 3), slope = {-0.1, 0.0, 0.1};
    for (const double level : {0.1, 0.7, 1e-9, 12345.678}) {
        Plane flat(9, 5);
        std::fill(flat.value.begin(), flat.value.end(), level);
        EXPECT_EQ(convolve(flat, {thirds, 1}, {thirds, 1}).value, flat.value);
        const Kernel box{3, 3, std::vector<double>(9, 1.0 / 9), 1};
        EXPECT_EQ(convolve(flat, box).value, flat.value);
        EXPECT_EQ(convolve(flat, {slope, 0}, {thirds, 1}).value, std::vector<double>(45, 0.0));
    }
}

TEST(Convolution, IsLinearAndMovesWithThePicture) {
    const Kernel kernel = any_kernel(3, 3, 6);
    const Plane a = noise(12, 12, 7), b = noise(12, 12, 8);
    Plane sum(12, 12), moved(12, 12);
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 12; ++x) {
            sum.at(x, y) = a.at(x, y) + 2 * b.at(x, y);
            moved.at(x, y) = a.at(std::max(x - 2, 0), std::max(y - 1, 0));
        }
    const Plane of_a = convolve(a, kernel), of_b = convolve(b, kernel);
    const Plane of_sum = convolve(sum, kernel), of_moved = convolve(moved, kernel);
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 12; ++x)
            ASSERT_NEAR(of_sum.at(x, y), of_a.at(x, y) + 2 * of_b.at(x, y), 1e-12);
    for (int y = 2; y < 11; ++y) // away from the repeated edge
        for (int x = 3; x < 11; ++x)
            ASSERT_NEAR(of_moved.at(x, y), of_a.at(x - 2, y - 1), 1e-12);
}

} // namespace
} // namespace scanout::image
