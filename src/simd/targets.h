// The SIMD targets of this program: which there are, which this CPU has, and the choice of one.
// Pictures do not depend on it; only their time does.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::simd {

struct Target {
    std::string name; // avx3, avx2, ssse3, emu128 (plain C++ in lanes of four), neon
    bool supported;   // by this CPU
    bool chosen;      // kernels run on it
};
// Best first.
std::vector<Target> targets();

// Kernels run on this target from the next call on; "auto": the best that the CPU has. False when
// there is no such target or the CPU lacks it. Not while kernels run.
bool choose_target(std::string_view name);

std::string chosen_target();

} // namespace scanout::simd
