// The Fourier transform against the sum that defines it, in libm's sines; and the laws that hold of
// it: Parseval's, sines, shifts, the way back.
#include "signal/fourier.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

#include <gtest/gtest.h>

namespace scanout::signal {
namespace {

using Values = std::vector<Complex>;

Values any_values(int length, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    Values values(static_cast<std::size_t>(length));
    for (Complex& value : values) {
        value.re = unit(random);
        value.im = unit(random);
    }
    return values;
}

Values by_definition(const Values& f) {
    const std::size_t n = f.size();
    Values out(n);
    for (std::size_t k = 0; k < n; ++k) {
        std::complex<double> sum = 0;
        for (std::size_t i = 0; i < n; ++i)
            sum += std::complex<double>(f[i].re, f[i].im) *
                   std::polar(1.0,
                              -2 * M_PI * static_cast<double>(k * i % n) / static_cast<double>(n));
        out[k] = {sum.real(), sum.imag()};
    }
    return out;
}

double largest_gap(const Values& a, const Values& b) {
    double gap = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        gap = std::max(gap, std::hypot(a[i].re - b[i].re, a[i].im - b[i].im));
    return gap;
}

double energy(const Values& values) {
    double sum = 0;
    for (const Complex& v : values)
        sum += v.re * v.re + v.im * v.im;
    return sum;
}

std::vector<int> some_lengths() {
    std::vector<int> lengths = {64, 97, 100, 127, 128, 129, 255, 256, 360, 511, 512, 641};
    for (int n = 1; n <= 40; ++n)
        lengths.push_back(n);
    return lengths;
}

TEST(Fourier, OfAnyLengthIsTheSumThatDefinesIt) {
    std::vector<Complex> scratch;
    for (const int n : some_lengths()) {
        Values values = any_values(n, static_cast<unsigned>(n));
        const Values expected = by_definition(values);
        Fourier(n).forward(values, scratch);
        ASSERT_LT(largest_gap(values, expected), 2e-13 * n) << n;
    }
}

TEST(Fourier, LeadsBackAndKeepsTheEnergyAsParsevalSays) {
    std::vector<Complex> scratch;
    for (const int n : some_lengths()) {
        const Values before = any_values(n, static_cast<unsigned>(1000 + n));
        Values values = before;
        const Fourier fourier(n);
        fourier.forward(values, scratch);
        ASSERT_NEAR(energy(values) / n, energy(before), 1e-12 * energy(before)) << n;
        fourier.inverse(values, scratch);
        ASSERT_LT(largest_gap(values, before), 1e-14 * (n + 10)) << n;
    }
}

TEST(Fourier, OfASineIsTwoSpikes) {
    for (const int n : {16, 45, 101}) {
        Values values(static_cast<std::size_t>(n));
        for (int i = 0; i < n; ++i)
            values[static_cast<std::size_t>(i)].re = 3 * std::sin(2 * M_PI * 5 * i / n);
        std::vector<Complex> scratch;
        Fourier(n).forward(values, scratch);
        for (int k = 0; k < n; ++k) {
            const Complex v = values[static_cast<std::size_t>(k)];
            const double expected = k == 5 ? -1.5 * n : k == n - 5 ? 1.5 * n : 0;
            EXPECT_NEAR(v.im, expected, 1e-11) << n << " " << k;
            EXPECT_NEAR(v.re, 0, 1e-11) << n << " " << k;
        }
    }
}

TEST(Spectrum, OfAPlaneTransformsRowsAndColumnsAndLeadsBack) {
    constexpr int kWidth = 37, kHeight = 20;
    image::Plane plane(kWidth, kHeight);
    const Values random = any_values(kWidth * kHeight, 7);
    for (std::size_t i = 0; i < plane.value.size(); ++i)
        plane.value[i] = random[i].re;
    Jobs jobs(2);
    double last = 0;
    const Spectrum s = spectrum_of(plane, jobs, [&](double share) {
        EXPECT_GT(share, last);
        last = share;
    });
    EXPECT_EQ(last, 1);
    for (const auto& [kx, ky] : {std::pair{0, 0}, {1, 0}, {0, 1}, {5, 7}, {36, 19}, {18, 10}}) {
        std::complex<double> sum = 0;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x)
                sum +=
                    plane.at(x, y) * std::polar(1.0, -2 * M_PI *
                                                         (static_cast<double>(kx * x) / kWidth +
                                                          static_cast<double>(ky * y) / kHeight));
        EXPECT_NEAR(s.at(kx, ky).re, sum.real(), 1e-10);
        EXPECT_NEAR(s.at(kx, ky).im, sum.imag(), 1e-10);
    }
    const image::Plane back = plane_of(s, jobs);
    for (std::size_t i = 0; i < plane.value.size(); ++i)
        ASSERT_NEAR(back.value[i], plane.value[i], 1e-13);
}

TEST(Spectrum, HasTheSameBitsForEveryNumberOfThreads) {
    image::Plane plane(150, 70);
    const Values random = any_values(150 * 70, 9);
    for (std::size_t i = 0; i < plane.value.size(); ++i)
        plane.value[i] = random[i].re;
    Jobs one(1);
    const Spectrum expected = spectrum_of(plane, one);
    for (const int threads : {2, 3, 7}) {
        Jobs jobs(threads);
        const Spectrum got = spectrum_of(plane, jobs);
        for (std::size_t i = 0; i < got.value.size(); ++i) {
            ASSERT_EQ(got.value[i].re, expected.value[i].re);
            ASSERT_EQ(got.value[i].im, expected.value[i].im);
        }
    }
}

} // namespace
} // namespace scanout::signal
