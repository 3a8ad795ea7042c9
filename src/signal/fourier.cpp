#include "signal/fourier.h"

#include "base/check.h"
#include "math/transcendental.h"

#include <algorithm>
#include <bit>

namespace scanout::signal {
namespace {

// exp(-2 pi i k / n): the angle is reduced in whole numbers, so that no turn is lost.
Complex turn(std::int64_t k, std::int64_t n) {
    const double angle = 360.0 * static_cast<double>(k % n) / static_cast<double>(n);
    return {cos_degrees(angle), -sin_degrees(angle)};
}

} // namespace

Fourier::Fourier(int length) : length_(length) {
    CHECK(length > 0);
    const auto n = static_cast<unsigned>(length);
    power_ = static_cast<int>(std::has_single_bit(n) ? n : std::bit_ceil(2 * n - 1));
    turns_.resize(static_cast<std::size_t>(power_ / 2));
    for (std::size_t k = 0; k < turns_.size(); ++k)
        turns_[k] = turn(static_cast<std::int64_t>(k), power_);
    if (power_ == length_) return;
    // k n = (k^2 + n^2 - (k - n)^2) / 2: the transform is a convolution with a chirp.
    chirp_.resize(n);
    chirp_spectrum_.resize(static_cast<std::size_t>(power_));
    for (std::size_t k = 0; k < n; ++k) {
        const auto wide = static_cast<std::int64_t>(k);
        chirp_[k] = turn(wide * wide % (2 * std::int64_t{length}), 2 * std::int64_t{length});
        chirp_spectrum_[k] = conjugate(chirp_[k]);
        if (k > 0) chirp_spectrum_[chirp_spectrum_.size() - k] = conjugate(chirp_[k]);
    }
    halving(chirp_spectrum_);
}

// The values go into the order of their reversed bits; then pairs, fours, eights are joined.
void Fourier::halving(std::span<Complex> v) const {
    const std::size_t n = v.size();
    for (std::size_t i = 1, reversed = 0; i < n; ++i) {
        std::size_t bit = n / 2;
        for (; (reversed & bit) != 0; bit /= 2)
            reversed ^= bit;
        reversed |= bit;
        if (i < reversed) std::swap(v[i], v[reversed]);
    }
    for (std::size_t half = 1; half < n; half *= 2)
        for (std::size_t first = 0; first < n; first += 2 * half)
            for (std::size_t k = 0; k < half; ++k) {
                const Complex even = v[first + k];
                const Complex odd = v[first + k + half] * turns_[k * (n / (2 * half))];
                v[first + k] = even + odd;
                v[first + k + half] = even - odd;
            }
}

void Fourier::forward(std::span<Complex> values, std::vector<Complex>& scratch) const {
    CHECK(values.size() == static_cast<std::size_t>(length_));
    if (chirp_.empty()) return halving(values);
    scratch.assign(static_cast<std::size_t>(power_), {});
    for (std::size_t k = 0; k < values.size(); ++k)
        scratch[k] = values[k] * chirp_[k];
    halving(scratch);
    for (std::size_t k = 0; k < scratch.size(); ++k) // the conjugate: back by the same way
        scratch[k] = conjugate(scratch[k] * chirp_spectrum_[k]);
    halving(scratch);
    const double scale = 1.0 / power_; // exact
    for (std::size_t k = 0; k < values.size(); ++k)
        values[k] = conjugate(scratch[k]) * scale * chirp_[k];
}

void Fourier::inverse(std::span<Complex> values, std::vector<Complex>& scratch) const {
    for (Complex& value : values)
        value = conjugate(value);
    forward(values, scratch);
    for (Complex& value : values)
        value = {value.re / length_, -value.im / length_};
}

namespace {

// One of the two directions of a line's transform.
using Line = void (Fourier::*)(std::span<Complex>, std::vector<Complex>&) const;

// Every row, then every column. Lines are independent, so that any thread may have any.
void transform(Spectrum& s, Line line, Jobs& jobs, const Progress& progress) {
    constexpr int kBatch = 32; // lines of a worker at a time; columns that are read together
    const Fourier rows(s.width), columns(s.height);
    const auto workers = static_cast<std::size_t>(jobs.threads());
    std::vector<std::vector<Complex>> scratch(workers), held(workers);
    const auto batches_of = [](int lines) { return (lines + kBatch - 1) / kBatch; };
    const double all = batches_of(s.height) + batches_of(s.width);
    const auto in_rounds = [&](int batches, double before, const auto& work) {
        const int round = 4 * jobs.threads();
        for (int first = 0; first < batches; first += round) {
            jobs.for_each(std::min(round, batches - first), [&](int i, int worker) {
                work(first + i, static_cast<std::size_t>(worker));
            });
            if (progress) progress((before + std::min(first + round, batches)) / all);
        }
    };
    in_rounds(batches_of(s.height), 0, [&](int batch, std::size_t worker) {
        for (int y = batch * kBatch; y < std::min((batch + 1) * kBatch, s.height); ++y)
            (rows.*line)({&s.at(0, y), static_cast<std::size_t>(s.width)}, scratch[worker]);
    });
    in_rounds(batches_of(s.width), batches_of(s.height), [&](int batch, std::size_t worker) {
        const int first = batch * kBatch, count = std::min(kBatch, s.width - first);
        const auto height = static_cast<std::size_t>(s.height);
        std::vector<Complex>& lines = held[worker];
        lines.resize(height * static_cast<std::size_t>(count));
        const auto column = [&](int i) {
            return std::span(lines).subspan(height * static_cast<std::size_t>(i), height);
        };
        for (int y = 0; y < s.height; ++y)
            for (int i = 0; i < count; ++i)
                column(i)[static_cast<std::size_t>(y)] = s.at(first + i, y);
        for (int i = 0; i < count; ++i)
            (columns.*line)(column(i), scratch[worker]);
        for (int y = 0; y < s.height; ++y)
            for (int i = 0; i < count; ++i)
                s.at(first + i, y) = column(i)[static_cast<std::size_t>(y)];
    });
}

} // namespace

Spectrum spectrum_of(const image::Plane& plane, Jobs& jobs, const Progress& progress) {
    Spectrum s{plane.width, plane.height, std::vector<Complex>(plane.value.size())};
    for (std::size_t i = 0; i < plane.value.size(); ++i)
        s.value[i].re = plane.value[i];
    if (!s.value.empty()) transform(s, &Fourier::forward, jobs, progress);
    return s;
}

image::Plane plane_of(Spectrum s, Jobs& jobs, const Progress& progress) {
    image::Plane plane(s.width, s.height);
    if (!s.value.empty()) transform(s, &Fourier::inverse, jobs, progress);
    for (std::size_t i = 0; i < plane.value.size(); ++i)
        plane.value[i] = s.value[i].re;
    return plane;
}

} // namespace scanout::signal
