// --budget and --max-error: the rungs that meet them, from measurements of this machine. A
// measurement is kept (frontier_cache.h) and made anew where it does not hold any more.
#pragma once

#include "app/frontier/cache.h"
#include "app/options/settings.h"
#include "base/jobs.h"
#include "base/result.h"
#include "frame/facts/facts.h"
#include "measure/known_frontier.h"
#include "scene/scene.h"
#include "scene/view.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::app {

// The axes whose rungs may be chosen: those that the command line does not name.
std::vector<std::string> free_axes(const Settings& settings);

// What is to be drawn within the limits.
struct BudgetTask {
    const scene::Scene& scene;
    const frame::SceneFacts& facts;
    const scene::View& view;
    const frame::FrameOptions& options;
    std::vector<std::string> axes; // free_axes()
    Jobs& jobs;
    int max_memory_mb = 0; // that the reference may take; 0: what is available
    std::function<void(std::string_view doing, double fraction)> progress = {};
    std::function<bool()> stop = {}; // asked often while all is measured; true gives up
    // What a frame takes now, of CPU time, ms; empty: it is timed.
    std::function<double(const frame::FramePlan&)> time_now = {};
};

struct Chosen {
    measure::KnownPoint point;
    measure::Choice choice;
    measure::Limits limits;
    std::string date; // of the measurement
    bool cached = false;
    std::string instead; // where no point meets the limits: what there is, and what to do
    std::vector<std::string> notes; // warnings, a line each
};

// A measurement holds while frames of the chosen rungs take, of CPU time, what it says within this
// factor. In 12 runs beside other programs that differed by at most 1.2, wall time by up to 6.
inline constexpr double kTimeHolds = 1.5;

// Whether one of three tries of the point takes that long now: a busy machine slows some moments
// down.
bool still_holds(const BudgetTask& task, const measure::KnownPoint& point);

// `cache`: null, nothing is remembered. Fails (Exit::usage) where there is no reference of the
// picture, and where it is stopped.
Result<Chosen> choose_rungs(const BudgetTask& task, const measure::Limits& limits,
                            const FrontierCache* cache);

// The user's own cache; a note where it cannot be used.
Result<Chosen> choose_rungs(const BudgetTask& task, const measure::Limits& limits);

// The warning where nothing could be chosen: "--budget: no rungs are chosen: ", and why. What is
// asked for is drawn then.
std::string none_chosen(const measure::Limits& limits, const Error& why);

// "chosen for 16 ms: --aa samples_4: 12.1 ms, 0.8 codes RMSE; measured 2026-11-29, cached"
std::string to_text(const Chosen& chosen);

} // namespace scanout::app
