// The discrete Fourier transform of any length, and of a plane of numbers: a picture as a sum of
// waves. Powers of two by halving (Cooley and Tukey 1965), other lengths as a convolution of a
// power of two (Bluestein 1970). In double, by our own sines, in one order: the same bits on every
// machine and for every number of threads, which libraries that plan by measuring do not promise.
#pragma once

#include "base/jobs.h"
#include "image/plane.h"
#include "signal/progress.h"

#include <span>
#include <vector>

namespace scanout::signal {

struct Complex {
    double re = 0, im = 0;
    friend Complex operator+(Complex a, Complex b) { return {a.re + b.re, a.im + b.im}; }
    friend Complex operator-(Complex a, Complex b) { return {a.re - b.re, a.im - b.im}; }
    friend Complex operator*(Complex a, Complex b) {
        return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
    }
    friend Complex operator*(Complex a, double s) { return {a.re * s, a.im * s}; }
};
inline Complex conjugate(Complex a) {
    return {a.re, -a.im};
}

// The transform of one length, for many sequences.
class Fourier {
public:
    explicit Fourier(int length); // at least 1
    int length() const { return length_; }

    // F(k) = sum over n of f(n) exp(-2 pi i k n / length), in place. `scratch` is sized as needed.
    void forward(std::span<Complex> values, std::vector<Complex>& scratch) const;
    // Its inverse, 1 / length included.
    void inverse(std::span<Complex> values, std::vector<Complex>& scratch) const;

private:
    void halving(std::span<Complex> values) const; // of power_ values
    int length_, power_;                           // power_: a power of two, length_ if it is one
    std::vector<Complex> turns_;                   // exp(-2 pi i k / power_), half a turn
    std::vector<Complex> chirp_, chirp_spectrum_;  // of Bluestein's convolution; else empty
};

// A plane's spectrum: frequency (0, 0) first; those beyond the middle are negative.
struct Spectrum {
    int width = 0, height = 0;
    std::vector<Complex> value; // rows
    Complex& at(int x, int y) {
        return value[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x)];
    }
    const Complex& at(int x, int y) const { return const_cast<Spectrum*>(this)->at(x, y); }
};

Spectrum spectrum_of(const image::Plane& plane, Jobs& jobs, const Progress& progress = {});
// The real part of what has this spectrum.
image::Plane plane_of(Spectrum spectrum, Jobs& jobs, const Progress& progress = {});

} // namespace scanout::signal
