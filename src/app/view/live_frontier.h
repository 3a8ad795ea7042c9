// The frontier of the picture on show, measured while nothing else happens: first the reference,
// then the search, a few frames at a time.
#pragma once

#include "app/view/convergence.h"
#include "measure/frontier_search.h"
#include "measure/known_frontier.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace scanout::app {

class LiveFrontier {
public:
    using Time = Convergence::Time;

    // What is measured. The scene outlives the next stop().
    struct Task {
        const scene::Scene& scene;
        frame::SceneFacts facts;
        scene::View view;
        frame::FrameOptions options;
        std::vector<std::string> axes; // whose rungs may be chosen
        trace::Look look;              // look_of_rungs()
    };
    void begin(Task task);
    void stop();

    bool running() const { return task_.has_value(); }
    // It has to wait for a thread.
    bool building() const { return convergence_.building(); }
    // Goes on until `until`, and a few frames longer.
    void step(Jobs& jobs, Time until);
    double fraction() const; // of the work, about
    // Once, when it is finished: the frontier, or why there is none.
    std::optional<Result<measure::KnownFrontier>> take();

private:
    Result<void> begin_search(Jobs& jobs);

    std::optional<Task> task_;
    Convergence convergence_;
    std::unique_ptr<measure::FrontierSearch> search_;
    std::optional<Result<measure::KnownFrontier>> found_;
};

} // namespace scanout::app
