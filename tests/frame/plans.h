// Plans of facts and options, and what they run by name.
#pragma once

#include "frame/plan/plan.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::frame {

inline std::vector<std::string> stages(const FramePlan& plan) {
    std::vector<std::string> names;
    for (const shade::Stage* stage : plan.stages)
        names.push_back(std::string(stage->card.axis) + " " + std::string(stage->card.name));
    return names;
}

inline std::vector<std::string> techniques(const FramePlan& plan) {
    std::vector<std::string> names;
    for (const Technique* technique : plan.techniques)
        names.push_back(std::string(technique->axis) + " " + std::string(technique->name));
    return names;
}

inline FramePlan plan_of(const SceneFacts& facts, const FrameOptions& options = {}) {
    auto result = plan(options, facts);
    EXPECT_TRUE(result) << result.error().what;
    return result.value_or(FramePlan());
}

} // namespace scanout::frame
