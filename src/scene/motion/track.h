// A value that changes over time by keys: numbers at times, and how it gets from each to the next.
// Plain values; sampling allocates nothing. Hermite's curve as glTF's CUBICSPLINE has it
// (Khronos 2021, appendix C); tangents from the neighbours by Catmull and Rom 1974.
#pragma once

#include "base/result.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace scanout::scene {

// step: the last key's value. linear: a straight line. slerp: of rotations, by equal angles, as
// linear means it there.
// spline: a smooth curve through the keys. hermite: likewise, with the tangents that the keys say.
enum class Interpolation : std::uint8_t { step, linear, slerp, spline, hermite };

// How the share u of the time between two keys becomes the share of the way: as it is; u^2, so that
// it starts slowly; 1 - (1 - u)^2, so that it ends slowly; 3 u^2 - 2 u^3, both.
enum class Easing : std::uint8_t { none, in, out, in_out };
double eased(Easing easing, double u); // 0 at 0 and 1 at 1

// t within [0, period), as many periods away; 0 where the period is not above 0.
double wrapped_time(double t, double period);

struct TrackKeys {
    std::size_t width = 1;    // numbers a key
    bool quaternions = false; // x, y, z, w of any length, normalised; width is 4
    Interpolation by = Interpolation::linear;
    bool loops = false;          // after the last key's time it begins again at time 0
    std::vector<double> times;   // seconds, not below 0; of equal ones the later key counts
    std::vector<double> values;  // width a key
    std::vector<double> in, out; // hermite: tangents before and after a key, a second; like values
    std::vector<Easing> easings; // from each key to the next; empty: none
};

// The first key whose time is below that of the key before it, negative or not finite.
std::optional<std::size_t> first_out_of_order(std::span<const double> times);

class Track {
public:
    // Fails (Exit::unreadable, the second half of a line) where there is no key, where times are
    // out of order, and where numbers are missing or not finite.
    static Result<Track> create(TrackKeys keys);

    std::size_t width() const { return keys_.width; }
    double end() const { return keys_.times.back(); } // seconds
    // The value at a time, width() numbers: before the first key its value; after the last one its
    // value, or that of the next round. One key holds always.
    void at(double seconds, std::span<double> out) const;

private:
    explicit Track(TrackKeys keys) : keys_(std::move(keys)) {}
    void find_tangents();
    void between(std::size_t key, double u, std::span<double> out) const;

    TrackKeys keys_; // spline: with the tangents that it comes to
};

} // namespace scanout::scene
