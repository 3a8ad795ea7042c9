// Tests that run on every SIMD target that this CPU has.
#pragma once

#include "simd/targets.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::test {

inline std::vector<std::string> supported_targets() {
    std::vector<std::string> names;
    for (const simd::Target& target : simd::targets())
        if (target.supported) names.push_back(target.name);
    return names;
}

// Calls work(name) with kernels running on that target, for each; then the best target is back.
template <class Work>
void on_every_target(Work work) {
    for (const std::string& name : supported_targets()) {
        SCOPED_TRACE(name);
        ASSERT_TRUE(simd::choose_target(name));
        work(name);
        if (testing::Test::HasFatalFailure()) break;
    }
    ASSERT_TRUE(simd::choose_target("auto"));
}

} // namespace scanout::test
