#include "app/view/governor.h"

#include "base/check.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scanout::app {
namespace {

constexpr int kOver = 2;            // frames in a row over the budget
constexpr int kVain = 10;           // the same, before a step down counts as one in vain
constexpr int kHeld = 6;            // frames in a row within it
constexpr int kPatience = 30;       // frames in a row that leave room: half a second at 60 Hz
constexpr int kMostPatience = 1920; // half a minute
constexpr double kRoom = 0.85;      // of the budget: what the level above may be thought to take
constexpr double kNoGain = 0.9;     // of the fixed share: from here on a step down is in vain

} // namespace

Governor::Governor(std::vector<double> shares, double budget_ms)
    : shares_(std::move(shares)), budget_ms_(budget_ms),
      least_(static_cast<int>(shares_.size()) - 1), patience_(kPatience) {
    CHECK(!shares_.empty());
}

double Governor::thought(double ms, int to) const {
    const auto work = [&](int level) { return fixed_ + (1 - fixed_) * share(level); };
    return ms * work(to) / work(level_);
}

void Governor::go(int level, double ms) {
    held_ = level > level_;
    step_ = Step{level_, ms};
    level_ = level;
    frames_ = over_ = within_ = roomy_ = 0;
    quickest_ms_ = INFINITY;
}

// Solves ms / step.ms = (f + (1 - f) s) / (f + (1 - f) s') for the fixed share f.
void Governor::learn(double ms) {
    const double here = share(level_), there = share(step_->from);
    const double top = ms * there - step_->ms * here;
    const double all = step_->ms * (1 - here) - ms * (1 - there);
    if (all != 0) fixed_ = std::clamp(top / all, 0.0, 1.0);
}

void Governor::took(double ms) {
    if (budget_ms_ <= 0 || shares_.size() < 2) return;
    // The first frame of a level also makes room for it.
    if (++frames_ == 1 && step_) return;
    // Soon after a step, before the load is another one. The quickest frame is the least disturbed.
    quickest_ms_ = std::min(quickest_ms_, ms);
    if (step_ && frames_ <= kVain + 1) learn(quickest_ms_);
    const bool within = ms <= budget_ms_;
    least_over_ms_ = within ? 0 : over_ == 0 ? ms : std::min(least_over_ms_, ms);
    over_ = within ? 0 : over_ + 1;
    within_ = within ? within_ + 1 : 0;
    roomy_ = level_ > 0 && thought(ms, level_ - 1) <= kRoom * budget_ms_ ? roomy_ + 1 : 0;
    if (within_ == kHeld && !held_) {
        held_ = true;
        patience_ = kPatience;
    }
    const bool in_vain = step_ && step_->from < level_ && fixed_ > kNoGain;
    if (over_ >= kOver) {
        if (in_vain && over_ >= kVain) {
            least_ = step_->from;
            go(least_, least_over_ms_);
            held_ = true; // it is as good as any
        } else if (!in_vain && level_ < least_) {
            if (!held_) patience_ = std::min(2 * patience_, kMostPatience);
            int to = level_ + 1;
            while (to < least_ && thought(least_over_ms_, to) > budget_ms_)
                ++to;
            go(to, least_over_ms_);
        }
    } else if (roomy_ >= patience_) {
        go(level_ - 1, ms);
    }
}

void Governor::rest() {
    if (!held_) go(level_ + 1, budget_ms_);
    step_.reset();
    held_ = true;
    frames_ = over_ = within_ = roomy_ = 0;
    least_ = static_cast<int>(shares_.size()) - 1;
}

} // namespace scanout::app
