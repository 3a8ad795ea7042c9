#include "app/view/live_frontier.h"

#include "app/machine.h"
#include "app/options/quick.h"
#include "app/picture/reference.h"

#include <utility>

namespace scanout::app {
namespace {

constexpr double kReferenceShare = 0.3; // of the work, about

} // namespace

void LiveFrontier::begin(Task task) {
    stop();
    task_.emplace(std::move(task));
    convergence_.begin(task_->scene, task_->view, task_->look, {kQuickSamples});
}

void LiveFrontier::stop() {
    search_.reset(); // it refers to the reference
    convergence_.stop();
    found_.reset();
    task_.reset();
}

Result<void> LiveFrontier::begin_search(Jobs& jobs) {
    const image::Image& reference = convergence_.reference()->image();
    TRY_VOID(check_shows_a_difference(task_->scene, reference));
    TRY(search_,
        measure::FrontierSearch::create(task_->scene, task_->facts, task_->view, task_->options,
                                        jobs, reference, quick_search(task_->axes)));
    return {};
}

void LiveFrontier::step(Jobs& jobs, Time until) {
    if (!task_ || found_) return;
    if (search_ == nullptr) {
        convergence_.step(jobs, until);
        if (!convergence_.refusal().empty()) {
            found_ = fail(Exit::unreadable, "{}", convergence_.refusal());
        } else if (convergence_.finished()) {
            if (const Result<void> begun = begin_search(jobs); !begun)
                found_ = tl::unexpected(begun.error());
        }
        return;
    }
    do
        search_->step();
    while (!search_->finished() && std::chrono::steady_clock::now() < until);
    if (!search_->finished()) return;
    const measure::Frontier whole = search_->take();
    found_ = measure::known(whole, today());
    if ((*found_)->points.empty()) found_ = fail(Exit::usage, "nothing could be timed");
}

double LiveFrontier::fraction() const {
    if (search_ != nullptr) return kReferenceShare + (1 - kReferenceShare) * search_->fraction();
    const trace::Progressive* const reference = convergence_.reference();
    return reference != nullptr ? kReferenceShare * reference->share() : 0;
}

std::optional<Result<measure::KnownFrontier>> LiveFrontier::take() {
    if (!found_) return std::nullopt;
    auto found = std::exchange(found_, std::nullopt);
    stop();
    return found;
}

} // namespace scanout::app
