// The depth rule: how depths are compared at a sample, and in which format they are stored. By
// default the greatest reversed depth in a float, at a tie the lower id; any other rule is an
// option of the user's with kernels of its own. Every rule but one gives the same result in
// whatever order primitives are drawn: that of a depth buffer that is drawn in the order of ids.
// Not so "not equal": its result depends on all that was drawn before, not on two surfaces, so it
// is drawn in that order.
#pragma once

#include "base/technique.h"

#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace scanout::raster {

// In the order of techniques.h. By their usual names, of depths that are less where they are
// nearer.
enum class DepthTest : std::uint8_t {
    equal,
    not_equal,
    always,
    never,
    greater,
    greater_equal,
    less_equal,
    less
};

struct DepthRule {
    DepthTest test = DepthTest::less;
    // Stored as 1 - depth: a float, or a multiple of 1 / steps where that is not 0.
    bool standard = false;
    double steps = 0;
    // Above 0: the steps are of the distance, from the near plane's to this many times that.
    double reach = 0;
    // What the caller cuts off passes no test: stored depths beyond these.
    float farthest = -std::numeric_limits<float>::infinity(),
          nearest = std::numeric_limits<float>::infinity();
    friend bool operator==(const DepthRule&, const DepthRule&) = default;

    bool cuts() const {
        return farthest > -std::numeric_limits<float>::infinity() ||
               nearest < std::numeric_limits<float>::infinity();
    }
    bool is_default() const { return test == DepthTest::less && !standard && !cuts(); }

    bool wants_order() const { return test == DepthTest::not_equal; }

    // The smallest step between stored depths, near the eye; of even steps of the distance, that of
    // depths about this one.
    double step(double depth) const {
        if (!standard) return 0;
        const double one = steps > 0 ? 1 / steps : 0x1p-24;
        return reach > 0 ? depth * depth * (reach - 1) * one : one;
    }
    // A depth after storing: converted back, so that greater is nearer whatever the format.
    float stored(float depth) const {
        if (!standard) return depth;
        constexpr double kWhole = 0x1.8p52; // x + kWhole - kWhole is x, rounded to a whole number
        if (reach > 0) {
            double share = (1.0 / double{depth} - 1.0) / (reach - 1.0); // of the way
            share = share > 0 ? share : 0;
            share = share < 1 ? share : 1;
            const double kept = (share * steps + kWhole - kWhole) / steps;
            return static_cast<float>(1.0 / (1.0 + kept * (reach - 1.0)));
        }
        const double standard_depth = 1.0 - double{depth};
        const double stored = steps > 0 ? (standard_depth * steps + kWhole - kWhole) / steps
                                        : double{static_cast<float>(standard_depth)};
        return static_cast<float>(1.0 - stored);
    }
    // Does a stored depth, where greater is nearer, pass the test against another one, or against
    // an empty sample (kNoPrimitive)?
    bool passes(float depth, std::uint32_t id, float old, std::uint32_t old_id) const {
        if (!(depth >= farthest && depth <= nearest)) return false;
        const bool empty = old_id == std::numeric_limits<std::uint32_t>::max();
        const bool tie = depth == old;
        switch (test) {
        case DepthTest::equal:
            return !empty && tie && id > old_id;
        case DepthTest::not_equal:
            return empty || !tie;
        case DepthTest::always:
            return empty || id > old_id;
        case DepthTest::never:
            return false;
        case DepthTest::greater:
            return empty || depth < old || (tie && id < old_id);
        case DepthTest::greater_equal:
            return empty || depth < old || (tie && id > old_id);
        case DepthTest::less_equal:
            return empty || depth > old || (tie && id > old_id);
        case DepthTest::less:
            break;
        }
        return depth > old || (tie && id < old_id);
    }
};

struct DepthTestRow {
    Technique card;
    DepthTest test;
    bool compares = true; // which depth is greater
    bool shows = true;    // something, where the buffer starts empty
};
struct DepthFormatRow {
    Technique card;
    bool standard;
    double steps;
    bool linear = false; // steps of the distance, where there is perspective
};

} // namespace scanout::raster
