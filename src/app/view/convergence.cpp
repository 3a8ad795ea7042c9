#include "app/view/convergence.h"

#include "base/check.h"
#include "base/float_environment.h"

#include <new>
#include <system_error>
#include <utility>

namespace scanout::app {

void Convergence::begin(const scene::Scene& scene, const scene::View& view, const trace::Look& look,
                        const trace::Effort& effort) {
    CHECK(can_begin());
    stop(); // waits for nothing
    wanted_ = true;
    cancelled_ = built_ = false;
    const auto build = [this, &scene, view, look, effort] {
        const FloatEnvironment plain;
        try {
            result_ = trace::Progressive::create(scene, view, look, effort, &cancelled_);
        } catch (const std::bad_alloc&) {
            result_ = fail(Exit::unreadable, "the reference does not fit into memory");
        }
        if (cancelled_) result_ = nullptr; // nobody takes it
        built_ = true;
        built_.notify_all();
    };
    try {
        thread_ = std::thread(build);
    } catch (const std::system_error&) {
        refusal_ = "no thread can be made for the reference";
    }
}

void Convergence::refuse(std::string why) {
    cancel();
    refusal_ = std::move(why);
}

void Convergence::cancel() {
    cancelled_ = true;
    wanted_ = false;
    reference_.reset();
    refusal_.clear();
    if (built_) end_thread();
}

void Convergence::stop() {
    cancel();
    end_thread();
}

// Waits for it, and lets go of what it built.
void Convergence::end_thread() {
    if (thread_.joinable()) thread_.join();
    result_ = nullptr;
}

void Convergence::take_built() {
    if (!wanted_ || !thread_.joinable() || !built_) return;
    thread_.join();
    if (result_)
        reference_ = std::move(*result_);
    else
        refusal_ = result_.error().what;
    result_ = nullptr;
}

void Convergence::step(Jobs& jobs, Time until) {
    take_built();
    if (reference_ != nullptr) reference_->step(jobs, until);
}

void Convergence::finish(Jobs& jobs) {
    if (building()) built_.wait(false);
    step(jobs, Time::max());
}

} // namespace scanout::app
