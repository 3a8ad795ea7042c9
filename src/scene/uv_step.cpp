#include "scene/uv_step.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace scanout::scene {
namespace {

constexpr int kMost = 1000;

// The least number that the factor makes an even number of repeats: 20 of 0.3. 0: none.
int step_of(float scale) {
    if (scale == 0) return 2;
    for (int step = 1; step <= kMost; ++step) {
        const double repeats = step * std::abs(double{scale}) / 2, whole = std::round(repeats);
        // The factor is a decimal number, rounded to a float.
        if (whole > 0 && std::abs(repeats - whole) <= repeats * 0x1p-23) return step;
    }
    return 0;
}

// The least that is a multiple of both; 0: none.
int common(int a, int b) {
    const int both = a == 0 || b == 0 ? 0 : std::lcm(a, b);
    return both > kMost ? 0 : both;
}

} // namespace

std::vector<DVec2> uv_steps(const std::vector<Material>& materials) {
    std::vector<DVec2> steps;
    for (const Material& material : materials) {
        int x = 2, y = 2;
        for (const NamedMap& row : kTextureMaps) {
            const TextureMap& m = material.*row.map;
            if (m.texture < 0) continue;
            x = m.wrap_u == Wrap::clamp ? 0 : common(x, step_of(m.scale.x));
            y = m.wrap_v == Wrap::clamp ? 0 : common(y, step_of(m.scale.y));
        }
        steps.emplace_back(x, y);
    }
    return steps;
}

} // namespace scanout::scene
