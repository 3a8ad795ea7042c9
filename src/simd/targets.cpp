#include "simd/targets.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdint>

#include <hwy/highway.h>
#include <hwy/nanobenchmark.h>
#include <hwy/targets.h>

// Highway's shared library measures its benchmark timer whenever it is loaded, by the instruction
// rdtscp: where a processor or a virtual machine has none, the program would end before main.
// Nothing here uses that timer, so this definition, which the dynamic linker finds first, measures
// nothing.
std::uint64_t hwy::platform::TimerResolution() {
    return 1;
}

namespace scanout::simd {
namespace {

// Compiled in. Highway numbers better targets lower.
constexpr std::int64_t kCompiled = HWY_TARGETS;

std::string name_of(std::int64_t target) {
    std::string name = hwy::TargetName(target);
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return name;
}

// The targets that the CPU has, whichever was chosen before.
std::int64_t supported_by_cpu() {
    static const std::int64_t found = [] {
        hwy::SetSupportedTargetsForTest(0);
        return hwy::SupportedTargets() & kCompiled;
    }();
    return found;
}

std::int64_t& choice() { // one bit
    static std::int64_t target = supported_by_cpu() & -supported_by_cpu();
    return target;
}

} // namespace

std::vector<Target> targets() {
    std::vector<Target> all;
    for (auto rest = static_cast<std::uint64_t>(kCompiled); rest != 0; rest &= rest - 1) {
        const auto target = static_cast<std::int64_t>(rest & (0 - rest));
        all.push_back({name_of(target), (supported_by_cpu() & target) != 0, choice() == target});
    }
    return all;
}

std::string chosen_target() {
    return name_of(choice());
}

bool choose_target(std::string_view name) {
    std::int64_t wanted = 0;
    if (name == "auto") {
        wanted = supported_by_cpu() & -supported_by_cpu();
    } else {
        for (auto rest = static_cast<std::uint64_t>(supported_by_cpu()); rest != 0;
             rest &= rest - 1) {
            const auto target = static_cast<std::int64_t>(rest & (0 - rest));
            if (name_of(target) == name) wanted = target;
        }
    }
    if (wanted == 0) return false;
    choice() = wanted;
    hwy::SetSupportedTargetsForTest(wanted);
    hwy::GetChosenTarget().Update(wanted);
    return true;
}

} // namespace scanout::simd
