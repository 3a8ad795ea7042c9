// The search for the frontier, a few frames at a time: for whoever has other things to do in
// between, such as the viewer. measure::frontier() is the same without a pause.
#pragma once

#include "measure/frontier.h"
#include "measure/frontier_walk.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace scanout::measure {

class FrontierSearch {
public:
    // Scene, jobs and reference outlive it; how.progress and how.stop are not asked. Fails like
    // frame::plan.
    static Result<std::unique_ptr<FrontierSearch>>
    create(const scene::Scene& scene, frame::SceneFacts facts, const scene::View& view,
           const frame::FrameOptions& options, Jobs& jobs, const image::Image& reference,
           FrontierOptions how);

    bool finished() const { return phase_ == Phase::finished; }
    // Draws a configuration for the first time, or four frames more of one that is timed. Effects,
    // and FLIP at the end, take longer; FrontierOptions leaves them out.
    void step();
    // The next step is the last: what is measured by now counts.
    void stop();
    double fraction() const { return fraction_; } // of the work that is done, about
    Frontier take() { return std::move(found_); } // once it is finished

private:
    // A rung of an axis on the way up: what it costs and errs beside the other axes' defaults.
    struct Step {
        std::string_view technique;
        std::size_t point = 0;
    };
    struct Way {
        std::string_view axis;
        std::vector<Step> steps;
        std::size_t at = 0;
    };
    // A step up that was measured.
    struct Candidate {
        std::size_t way = 0, at = 0, point = 0;
    };
    enum class Phase { ladders, effects, rung_times, climb, walk, end, finished };

    FrontierSearch(Frontier found, FrontierOptions how);
    void work();
    bool is_late(double share);
    void draw_rung();
    void drop_undrawn();
    void begin_times();
    void price_effect();
    void begin_rung_times();
    void time_rung();
    void begin_climb();
    void list_steps_up();
    void try_step_up();
    void take_best_step();
    void begin_walk();
    void look_around();
    void end();

    bool as_good(const Step& s, const Step& r) const;
    bool replaces(const Step& s, const Step& r) const;
    bool is_as_asked(std::size_t point) const;
    Way way_up(const Ladder& ladder) const;
    std::vector<Rung> shortest(std::vector<Rung> rungs) const;
    FrontierWalk::Place place() const; // of the climb
    std::optional<std::size_t> drawn(const FrontierWalk::Place& place);
    void time(const FrontierWalk::Place& place, std::size_t point);
    TimedError timed_error(std::size_t point) const;
    double gain_of(std::size_t from, std::size_t to) const;
    void draw_frontier();
    void look();

    Frontier found_;
    FrontierOptions how_;
    Phase phase_ = Phase::ladders;
    double fraction_ = 0;
    double spent_ms_ = 0;              // on drawing the ladders; after that, on all that follows
    std::optional<std::size_t> timed_; // the point that is being timed
    std::optional<FrontierWalk::Place> place_; // its own, for the walk
    std::optional<FrontierWalk> walk_;
    std::size_t next_ = 0;           // of what the phase goes through
    std::vector<std::size_t> order_; // in which rungs are timed
    std::size_t ends_ = 0;           // how many of these are ends of axes
    // The climb: where it stands, the steps up from there that are left to try, and those that are
    // worth taking.
    std::vector<Way> ways_;
    std::size_t now_ = 0, all_steps_ = 0, steps_taken_ = 0;
    std::vector<Candidate> untried_, tried_;
};

} // namespace scanout::measure
