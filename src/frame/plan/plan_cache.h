// A cache of plans: returns the result of frame::plan(), but plans and allocates nothing while
// options and view facts equal those of an earlier frame.
#pragma once

#include "frame/facts/view_facts.h"
#include "frame/plan/plan.h"

#include <utility>
#include <vector>

namespace scanout::frame {

class PlanCache {
public:
    explicit PlanCache(SceneFacts facts = {}) : facts_(std::move(facts)) {}
    const SceneFacts& facts() const { return facts_; }

    // Like frame::plan(), its failures as well. The plan stays valid until the next call.
    Result<const FramePlan*> plan(const FrameOptions& options, const scene::View& view);

private:
    struct Entry {
        ViewFacts view;
        FramePlan plan; // without texture filters, which depend on the view
    };
    Result<const FramePlan*> find(const ViewFacts& view);

    SceneFacts facts_;
    FrameOptions options_;
    std::vector<Entry> entries_; // of these options
    FramePlan plan_;
};

} // namespace scanout::frame
