#include "frame/kept_plan.h"

#include "frame/planner.h"

#include <algorithm>

namespace scanout::frame {
namespace {

// A turning model shows one of its few sets of facts after another, again and again.
constexpr std::size_t kMaxKept = 16;

} // namespace

Result<const FramePlan*> KeptPlan::find(const ViewFacts& view) {
    const auto kept =
        std::find_if(kept_.begin(), kept_.end(), [&](const Kept& k) { return k.view == view; });
    if (kept != kept_.end()) return &kept->plan;
    TRY(FramePlan plan, plan_without_filter(options_, facts_, view));
    if (kept_.size() == kMaxKept) kept_.clear();
    kept_.push_back({view, std::move(plan)});
    return &kept_.back().plan;
}

Result<const FramePlan*> KeptPlan::plan(const FrameOptions& options, const scene::View& view) {
    TRY_VOID(check_numbers(options));
    if (!(options == options_)) {
        options_ = options;
        kept_.clear();
    }
    TRY(const FramePlan* const kept, find(view_facts(options, facts_, view)));
    plan_ = *kept; // into the room that it has
    plan_filter(plan_, facts_, view);
    return &plan_;
}

} // namespace scanout::frame
