// The session's part in the rungs that , and . choose: the frontier they step on is looked up in
// the cache, else measured while nothing else happens, for the view in which it was first asked
// for.
#include "app/frontier/budget.h"
#include "app/frontier/key.h"
#include "app/overlay/text_block.h"
#include "app/picture/reference.h"
#include "app/view/view_session.h"
#include "scene/content.h"

#include <algorithm>
#include <utility>

namespace scanout::app {

PictureKey ViewSession::key() const {
    PictureKey key = picture_key(viewer_.state().look, slot_.generation());
    key.width = viewer_.width();
    key.height = viewer_.height();
    if (rungs_.frontier() != nullptr) key.rung = static_cast<int>(rungs_.at());
    return key;
}

double ViewSession::budget_ms() const {
    return settings_.limits.wall_ms.value_or(1000 /
                                             std::max(parts_.display.info().refresh_hz, 1.0));
}

const measure::KnownPoint* ViewSession::chosen_point() const {
    if (rungs_.point() != nullptr) return rungs_.point();
    return chosen_ ? &chosen_->point : nullptr;
}

// Where every run has to show the same, nothing is measured.
void ViewSession::step_rung(int by) {
    if (steady_ || slot_.model() == nullptr) return;
    if (!rungs_.step(by))
        show_message(by < 0 ? "no rungs are quicker" : "no rungs are more accurate", kMessageSteps);
    set_motion_levels();
}

// Nothing else is to be done, and the picture is such that it can be timed.
bool ViewSession::wants_frontier_step() {
    return rungs_.wants_frontier() && slot_.model() != nullptr && !blank_ && !lost_ &&
           parts_.display.ready() && level_ == 0 && !viewer_.turning() && !next_change() &&
           !wants_row() && !wants_frame();
}

Result<void> ViewSession::measure_frontier() {
    constexpr std::chrono::milliseconds kStep{8};
    if (!frontier_.running()) return begin_frontier();
    frontier_.step(parts_.jobs, std::chrono::steady_clock::now() + kStep);
    auto found = frontier_.take();
    if (!found) return {};
    if (!*found) {
        refuse_frontier(found->error().what);
        return {};
    }
    const Result<FrontierCache> cache = FrontierCache::of_user();
    const Result<void> kept =
        cache ? cache->keep(frontier_key_, **found) : tl::unexpected(cache.error());
    if (!kept) print_warnings({kept.error().what + "; it is measured anew each time"}, settings_);
    put_frontier(*std::move(*found));
    return {};
}

Result<void> ViewSession::begin_frontier() {
    const scene::Scene& scene = slot_.model()->scene;
    TRY(const scene::View view, viewer_.view(*slot_.mesh()));
    frontier_of_ = picture_key(viewer_.state().look, slot_.generation());
    frame::FrameOptions options;
    put_asked_frame_options(options);
    BudgetTask task{scene, slot_.facts(), view, options, free_axes(settings_), parts_.jobs};
    task.time_now = parts_.time_now;
    frontier_key_ =
        frontier_key(scene::content_hash(scene), view, options, task.axes, parts_.jobs.threads());
    if (const Result<FrontierCache> cache = FrontierCache::of_user())
        if (auto known = cache->find(frontier_key_))
            if (still_holds(task, known->points[RungStepper::start(*known, budget_ms())])) {
                put_frontier(*std::move(known));
                return {};
            }
    const Result<trace::Look> look =
        look_of_rungs(scene, slot_.facts(), view, options, settings_.max_memory_mb);
    if (!look) {
        refuse_frontier(look.error().what);
        return {};
    }
    print_warnings(left_out_of_reference(scene), settings_);
    frontier_.begin({scene, slot_.facts(), view, options, task.axes, *look});
    return {};
}

void ViewSession::refuse_frontier(const std::string& why) {
    refuse("no frontier: " + why);
    rungs_.give_up();
}

void ViewSession::put_frontier(measure::KnownFrontier frontier) {
    rungs_.put(std::move(frontier), budget_ms());
    set_motion_levels();
}

FrontierPanel ViewSession::frontier_panel() const {
    FrontierPanel panel;
    const measure::KnownPoint* const point = rungs_.point();
    if (point == nullptr) {
        const int percent = static_cast<int>(frontier_.fraction() * 100);
        panel.lines = {rungs_.wants_frontier() ? fmt::format("frontier: measuring, {} %", percent)
                                               : "frontier: none"};
        return panel;
    }
    const measure::KnownFrontier& frontier = *rungs_.frontier();
    const std::size_t letters = letters_across(viewer_.width(), viewer_.height()) / 2;
    panel.lines =
        broken_into_lines(fmt::format("{} of {}: {}", rungs_.at() + 1, frontier.points.size(),
                                      point->rungs.empty() ? "as asked for" : point->options()),
                          letters);
    panel.lines.push_back(
        fmt::format("{:.2f} ms  {:.2f} codes RMSE", point->wall_ms, point->error));
    panel.lines.push_back("measured " + frontier.date);
    if (frontier_of_ != picture_key(viewer_.state().look, slot_.generation()))
        panel.lines.push_back("for another view or light");
    for (const measure::KnownPoint& p : frontier.points)
        panel.points.push_back({p.wall_ms, p.error});
    panel.at = rungs_.at();
    return panel;
}

} // namespace scanout::app
