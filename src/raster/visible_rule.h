// Which of the surfaces that cover a sample is seen there: how their depths are compared, and in
// which format they are kept. As a rule the greatest reversed depth in a float, at a tie the lower
// id; everything else is a choice of the user's, and takes a way of its own through the kernels.
// With every rule the choice is the same in whatever order primitives are drawn: the tests are
// those of a depth buffer that is drawn into in the order of ids. "Not equal" is not among them:
// what it shows is a matter of all that was drawn before, not of two surfaces.
#pragma once

#include "base/technique.h"

#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace scanout::raster {

// In the order of techniques.h.
enum class DepthTest : std::uint8_t {
    equal,
    always,
    never,
    less,
    less_equal,
    greater_equal,
    greater
};

struct VisibleRule {
    DepthTest test = DepthTest::greater;
    // Kept as 1 - depth: a float, or a whole number of `steps` where that is not 0.
    bool standard = false;
    double steps = 0;

    bool usual() const { return test == DepthTest::greater && !standard; }

    // The least step that is told apart, near the eye.
    double step() const { return !standard ? 0 : (steps > 0 ? 1 / steps : 0x1p-24); }
    // A depth as it is kept: turned round again, so that greater is nearer whatever the format.
    float kept(float depth) const {
        if (!standard) return depth;
        const double turned = 1.0 - double{depth};
        constexpr double kWhole = 0x1.8p52; // x + kWhole - kWhole is x, rounded to a whole number
        const double stored = steps > 0 ? (turned * steps + kWhole - kWhole) / steps
                                        : double{static_cast<float>(turned)};
        return static_cast<float>(1.0 - stored);
    }
    // Does a depth that is kept so show before another one, or before nothing (kNoPrimitive)?
    bool shows(float depth, std::uint32_t id, float old, std::uint32_t old_id) const {
        const bool empty = old_id == std::numeric_limits<std::uint32_t>::max();
        const bool tie = depth == old;
        switch (test) {
        case DepthTest::equal:
            return !empty && tie && id > old_id;
        case DepthTest::always:
            return empty || id > old_id;
        case DepthTest::never:
            return false;
        case DepthTest::less:
            return empty || depth < old || (tie && id < old_id);
        case DepthTest::less_equal:
            return empty || depth < old || (tie && id > old_id);
        case DepthTest::greater_equal:
            return empty || depth > old || (tie && id > old_id);
        case DepthTest::greater:
            break;
        }
        return depth > old || (tie && id < old_id);
    }
};

struct DepthTestRow {
    Technique card;
    DepthTest test;
};
struct DepthFormatRow {
    Technique card;
    bool standard;
    double steps;
};

// In the order of techniques.h; null where there is no such name.
std::span<const DepthTestRow* const> depth_tests();
std::span<const DepthFormatRow* const> depth_formats();
const DepthTestRow* find_depth_test(std::string_view name);
const DepthFormatRow* find_depth_format(std::string_view name);

} // namespace scanout::raster
