// A reference, made while nothing else happens: its hierarchy by a thread
// of its own, its pixels in steps between two looks at the keys. Nothing exists before it is asked
// for.
#pragma once

#include "base/jobs.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "trace/progressive.h"

#include <atomic>
#include <memory>
#include <string>
#include <thread>

namespace scanout::app {

class Convergence {
public:
    using Time = trace::Progressive::Time;

    // All samples, but an estimate of each pixel first.
    static constexpr trace::Effort kWatched{trace::kMostSamples, true};

    Convergence() = default;
    Convergence(const Convergence&) = delete;
    Convergence& operator=(const Convergence&) = delete;
    ~Convergence() { stop(); }

    // Begins to build. The scene outlives the next stop(). Only when can_begin().
    void begin(const scene::Scene& scene, const scene::View& view, const trace::Look& look,
               const trace::Effort& effort = kWatched);
    // There is no reference, and why.
    void refuse(std::string why);
    // Lets go of what there is, without waiting for a build to end.
    void cancel();
    // The same, and waits: before the scene changes.
    void stop();

    // No thread still works for an earlier one.
    bool can_begin() const { return !thread_.joinable() || built_; }
    // Goes on until `until`, once it is built. Takes the built hierarchy over.
    void step(Jobs& jobs, Time until);
    // The same without an end: until it is finished or refused.
    void finish(Jobs& jobs);

    bool building() const { return wanted_ && thread_.joinable() && !built_; }
    // The reference so far; null until it is built.
    const trace::Progressive* reference() const { return reference_.get(); }
    bool finished() const { return reference_ != nullptr && reference_->finished(); }
    const std::string& refusal() const { return refusal_; } // empty: none

private:
    void take_built();
    void end_thread();

    bool wanted_ = false; // begun, and not let go
    std::thread thread_;
    std::atomic<bool> cancelled_ = false, built_ = false;
    Result<std::unique_ptr<trace::Progressive>> result_; // of the thread, once built_
    std::unique_ptr<trace::Progressive> reference_;
    std::string refusal_;
};

} // namespace scanout::app
