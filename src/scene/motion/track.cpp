#include "scene/motion/track.h"

#include "base/check.h"
#include "math/bits.h"
#include "math/double_double.h"
#include "math/quaternion.h"

#include <algorithm>
#include <utility>

namespace scanout::scene {
namespace {

DVec4 quaternion_at(std::span<const double> values, std::size_t key) {
    return {values[4 * key], values[4 * key + 1], values[4 * key + 2], values[4 * key + 3]};
}

void put_quaternion(const DVec4& q, std::span<double> out) {
    for (int i = 0; i < 4; ++i)
        out[static_cast<std::size_t>(i)] = q[i];
}

bool all_finite(std::span<const double> values) {
    return std::all_of(values.begin(), values.end(),
                       [](double value) { return magnitude(value) < kInfinity; });
}

bool uses_tangents(Interpolation by) {
    return by == Interpolation::hermite || by == Interpolation::spline;
}

// Each on the side of the key before it: the shorter way of two that mean the same.
void choose_signs(std::vector<double>& values) {
    for (std::size_t key = 1; key < values.size() / 4; ++key) {
        const DVec4 now = quaternion_at(values, key);
        if (dot4(now, quaternion_at(values, key - 1)) < 0)
            put_quaternion(-now, std::span(values).subspan(4 * key, 4));
    }
}

} // namespace

double eased(Easing easing, double u) {
    switch (easing) {
    case Easing::none:
        return u;
    case Easing::in:
        return u * u;
    case Easing::out:
        return u * (2 - u);
    case Easing::in_out:
        return u * u * (3 - 2 * u);
    }
    return u;
}

double wrapped_time(double t, double period) {
    constexpr double kMostPeriods = 0x1p52; // beyond them no share of a period is left in a double
    if (!(period > 0)) return 0;
    const double quotient = t / period;
    if (!(magnitude(quotient) < kMostPeriods)) return 0;
    const auto periods = static_cast<double>(static_cast<std::int64_t>(quotient));
    const Dd whole = two_product(periods, period);
    double rest = (t - whole.hi) - whole.lo;
    if (rest < 0) rest += period;
    if (rest >= period) rest -= period;
    return rest > 0 ? rest : 0;
}

std::optional<std::size_t> first_out_of_order(std::span<const double> times) {
    for (std::size_t i = 0; i < times.size(); ++i)
        if (!(times[i] >= (i > 0 ? times[i - 1] : 0.0)) || !(times[i] < kInfinity)) return i;
    return std::nullopt;
}

Result<Track> Track::create(TrackKeys keys) {
    const std::size_t count = keys.times.size(), numbers = count * keys.width;
    CHECK(!keys.quaternions || keys.width == 4);
    CHECK(keys.by != Interpolation::slerp || keys.quaternions);
    if (keys.quaternions && keys.by == Interpolation::linear) keys.by = Interpolation::slerp;
    if (count == 0) return fail(Exit::unreadable, "has no keys");
    if (const auto wrong = first_out_of_order(keys.times); wrong && *wrong > 0)
        return fail(Exit::unreadable, "key {} is at {} s, after {} s: times must not go back",
                    *wrong, keys.times[*wrong], keys.times[*wrong - 1]);
    else if (wrong)
        return fail(Exit::unreadable, "key 0 is at {} s: times begin at 0", keys.times[0]);
    if (keys.values.size() != numbers)
        return fail(Exit::unreadable, "has {} numbers for {} keys of {}", keys.values.size(), count,
                    keys.width);
    const bool hermite = keys.by == Interpolation::hermite;
    if (hermite && (keys.in.size() != numbers || keys.out.size() != numbers))
        return fail(Exit::unreadable, "lacks tangents");
    if (!all_finite(keys.values) || (hermite && !(all_finite(keys.in) && all_finite(keys.out))))
        return fail(Exit::unreadable, "has a number that is not finite");
    CHECK(keys.easings.empty() || keys.easings.size() == count);
    if (keys.quaternions)
        for (std::size_t key = 0; key < count; ++key)
            put_quaternion(unit_quaternion(quaternion_at(keys.values, key)),
                           std::span(keys.values).subspan(4 * key, 4));
    Track track(std::move(keys));
    if (track.keys_.by == Interpolation::spline) track.find_tangents();
    return track;
}

// The slope from the key before to the key after. At the ends, and where two keys stand at one
// time, of the side that there is; in a loop the ends' neighbours are beyond each other.
void Track::find_tangents() {
    const std::size_t count = keys_.times.size(), width = keys_.width;
    if (keys_.quaternions) choose_signs(keys_.values);
    keys_.in.assign(count * width, 0);
    keys_.out.assign(count * width, 0);
    // A loop of rotations may come back to minus the quaternion that it began with.
    const bool turned_over = keys_.quaternions && dot4(quaternion_at(keys_.values, 0),
                                                       quaternion_at(keys_.values, count - 1)) < 0;
    const auto step = [&](std::size_t from, std::size_t i) { // from a key to the next
        return keys_.values[(from + 1) * width + i] - keys_.values[from * width + i];
    };
    const auto time = [&](std::size_t from) { return keys_.times[from + 1] - keys_.times[from]; };
    for (std::size_t key = 0; key < count; ++key) {
        const bool around = keys_.loops && count > 1 && (key == 0 || key + 1 == count);
        const std::size_t before = key > 0 ? key - 1 : count - 2;
        const std::size_t after = key + 1 < count ? key : 0;
        const bool has_before = (key > 0 || around) && time(before) > 0;
        const bool has_after = (key + 1 < count || around) && time(after) > 0;
        const double seconds = (has_before ? time(before) : 0) + (has_after ? time(after) : 0);
        if (!(seconds > 0)) continue;
        for (std::size_t i = 0; i < width; ++i) {
            double back = has_before ? step(before, i) : 0;
            double forth = has_after ? step(after, i) : 0;
            if (around && turned_over) (key == 0 ? back : forth) *= -1;
            keys_.in[key * width + i] = keys_.out[key * width + i] = (back + forth) / seconds;
        }
    }
}

void Track::at(double seconds, std::span<double> out) const {
    CHECK_EQ(out.size(), keys_.width);
    const std::vector<double>& times = keys_.times;
    if (keys_.loops && times.back() > 0) seconds = wrapped_time(seconds, times.back());
    const auto next = static_cast<std::size_t>(
        std::upper_bound(times.begin(), times.end(), seconds) - times.begin());
    const std::size_t key = next > 0 ? next - 1 : 0;
    const bool holds = next == 0 || next == times.size() || keys_.by == Interpolation::step;
    const double u = holds ? 0 : (seconds - times[key]) / (times[next] - times[key]);
    if (u == 0) {
        std::copy_n(keys_.values.begin() + static_cast<std::ptrdiff_t>(key * keys_.width),
                    keys_.width, out.begin());
        return;
    }
    between(key, keys_.easings.empty() ? u : eased(keys_.easings[key], u), out);
}

// Between a key and the next, 0 < u <= 1.
void Track::between(std::size_t key, double u, std::span<double> out) const {
    if (keys_.by == Interpolation::slerp)
        return put_quaternion(
            slerp(quaternion_at(keys_.values, key), quaternion_at(keys_.values, key + 1), u), out);
    const std::size_t width = keys_.width;
    const double* const from = keys_.values.data() + key * width;
    const double* const to = from + width;
    if (!uses_tangents(keys_.by)) {
        for (std::size_t i = 0; i < width; ++i)
            out[i] = from[i] + (to[i] - from[i]) * u;
    } else {
        const double seconds = keys_.times[key + 1] - keys_.times[key];
        // Of a constant nothing remains but the constant.
        const double share = u * u * (3 - 2 * u);
        const double leaves = seconds * (u * ((1 - u) * (1 - u)));
        const double arrives = seconds * (u * u * (u - 1));
        const double* const tangent_out = keys_.out.data() + key * width;
        const double* const tangent_in = keys_.in.data() + (key + 1) * width;
        for (std::size_t i = 0; i < width; ++i)
            out[i] = from[i] + ((to[i] - from[i]) * share +
                                (leaves * tangent_out[i] + arrives * tangent_in[i]));
    }
    if (!keys_.quaternions) return;
    put_quaternion(unit_quaternion({out[0], out[1], out[2], out[3]}), out);
}

} // namespace scanout::scene
