#include "trace/noise.h"

#include "math/transcendental.h"

#include <algorithm>

namespace scanout::trace {
namespace {

constexpr std::size_t kLevels = 4;
static_assert(kParts == 1 << kLevels);

// Half the difference of two neighbours is what the mean of one of them errs less the error of
// both: of parts, of pairs, of fours, of eights. Sums of squares; there are 8, 4, 2, 1 of them.
std::array<double, kLevels> squares_of_differences(std::array<double, kParts> mean) {
    std::array<double, kLevels> sum{};
    std::size_t count = kParts;
    for (double& squares : sum) {
        count /= 2;
        for (std::size_t i = 0; i < count; ++i) {
            const double half = (mean[2 * i] - mean[2 * i + 1]) / 2;
            squares += half * half;
            mean[i] = (mean[2 * i] + mean[2 * i + 1]) / 2;
        }
    }
    return sum;
}

double to_the_seven_and_a_half(double x) {
    const double square = x * x;
    return square * square * square * x * scanout::sqrt(x);
}

} // namespace

// From level to level the square falls by a factor f that depends on what the pixel shows: a half
// where samples are as good as independent, 2^-1.5 where an edge divides them, a quarter or less
// where all is smooth (Owen 1997). What is still to come after the last level is f^4 / (1 - f) of
// the first one's square. f is not known: each candidate counts by its likelihood, of normal
// differences with the variance that fits best. That is (product of the variances)^(-1/2), and
// the powers of f in it are 0 * 8 + 1 * 4 + 2 * 2 + 3 * 1 = 11.
double standard_error(const std::array<double, kParts>& residual) {
    std::array<double, kLevels> squares = squares_of_differences(residual);
    double all = 0;
    for (const double s : squares)
        all += s;
    if (!(all > 0x1p-500)) return 0;
    double likelihoods = 0, weighted = 0;
    for (const double f : {0.5, 0x1.6a09e667f3bcdp-2, 0.25}) {
        double first = 0, power = 1; // the variance of the first level; f^level
        for (const double s : squares) {
            first += s / all / power / (kParts - 1);
            power *= f;
        }
        const double likelihood =
            1 / (to_the_seven_and_a_half(first) * f * f * f * f * f * scanout::sqrt(f));
        likelihoods += likelihood;
        weighted += likelihood * first * power / (1 - f);
    }
    return scanout::sqrt(all * weighted / likelihoods);
}

Scatter scatter(const std::array<double, kParts>& residual) {
    const std::array<double, kLevels> squares = squares_of_differences(residual);
    return {squares.front() / (kParts / 2), squares.back()};
}

// From parts to halves the square falls by f three times, and goes on to.
double square_of_error(const Scatter& sums) {
    if (!(sums.of_parts > 0x1p-500)) return 0;
    const double f = std::clamp(scanout::cbrt(sums.of_halves / sums.of_parts), 0.125, 0.5);
    return sums.of_halves * f / (1 - f);
}

} // namespace scanout::trace
