#include "frame/plan/plan_cache.h"

#include "frame/plan/planner.h"

#include <algorithm>

namespace scanout::frame {
namespace {

// A turning model alternates between a few sets of facts.
constexpr std::size_t kMaxEntries = 16;

} // namespace

Result<const FramePlan*> PlanCache::find(const ViewFacts& view) {
    const auto entry = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const Entry& e) { return e.view == view; });
    if (entry != entries_.end()) return &entry->plan;
    TRY(FramePlan plan, plan_without_filter(options_, facts_, view));
    if (entries_.size() == kMaxEntries) entries_.clear();
    entries_.push_back({view, std::move(plan)});
    return &entries_.back().plan;
}

Result<const FramePlan*> PlanCache::plan(const FrameOptions& options, const scene::View& view) {
    TRY_VOID(check_numbers(options));
    if (!(options == options_)) {
        options_ = options;
        entries_.clear();
    }
    TRY(const FramePlan* const entry, find(view_facts(options, facts_, view)));
    plan_ = *entry; // reuses its memory
    plan_filter(plan_, facts_, view);
    return &plan_;
}

} // namespace scanout::frame
