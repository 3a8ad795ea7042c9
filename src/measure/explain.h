// Why a frame looks as it does: each effect of its plan with the fact that decided it, its fraction
// of the picture, its price in time and memory, and what would change if it were switched the other
// way: for what is on the error of leaving it out, for what is off the proof that nothing is
// missing.
#pragma once

#include "base/jobs.h"
#include "base/result.h"
#include "frame/plan/plan.h"
#include "image/pixel_format.h"
#include "measure/paired.h"
#include "measure/renderer_pair.h"
#include "scene/scene.h"
#include "scene/view.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace scanout::measure {

// Between two pictures of one size.
struct Change {
    std::int64_t pixels = 0; // that differ
    int largest_code = 0;    // of any channel, 0 to 255
    double mean_flip = 0;    // 0 to 1
    friend bool operator==(const Change&, const Change&) = default;
};

// What the plan would take by itself, and what the technique that runs changes and costs against
// it.
struct Alternative {
    std::string technique;
    Change change;
    std::optional<Price> price;
};

// What turns its back to the eye.
struct FacesAway {
    std::size_t triangles = 0, of = 0; // whatever hides them
    std::int64_t pixels = 0;           // whose nearest surface is one of them
};

struct EffectRow {
    frame::Decision decision;
    // The fraction of the picture's pixels whose nearest surface calls for the effect, 0 to 1;
    // nothing where that is not a matter of the material.
    std::optional<double> pixel_share;
    std::optional<FacesAway> faces_away; // of two_sided where it is on
    std::uint64_t bytes = 0;             // that the effect holds
    // When it is switched the other way, or, on an axis that has no "off", to another technique:
    // what the plan would take by itself where the user names one, else the cheapest; or why it
    // cannot be. Nothing where there is no other.
    std::optional<Change> change;
    std::string compared_with; // the other technique; empty: on or off
    std::string refusal;
    // Of a frame with it over one without (or with the other technique); nothing without times or
    // comparison.
    std::optional<Price> price;
    std::optional<Alternative> automatic; // of an effect whose technique the user names
};

struct Explanation {
    int width = 0, height = 0; // pixels
    double covered_share = 0;  // of the pixels, whose centre shows something
    // The rows that are on and would not be for a grey triangle: none means a plain scene.
    int special = 0;
    std::vector<EffectRow> rows;              // as in the plan
    std::vector<std::string> ignored_options; // what is asked for and cannot be shown, a line each
    std::vector<const Technique*> techniques;
    std::optional<Cost> cost; // of the frame as it is, medians
};

struct ExplainOptions {
    // What is compared: the pictures that such a display shows; else as they are rendered.
    std::optional<image::PixelFormat> display;
    bool times = true;
    double seconds_a_row = 0.25; // of measuring time, about; 2 kPairsAPlace pairs in any case
    std::function<void(double fraction)> progress;
};

// Draws the frame with each effect switched. Fails like frame::plan.
Result<Explanation> explain(const scene::Scene& scene, const scene::View& view,
                            const frame::FrameOptions& options, Jobs& jobs,
                            const ExplainOptions& how = {});

// The same row by row, for whoever has other things to do in between.
class Explainer {
public:
    // The scene outlives it. Fails like frame::plan.
    static Result<std::unique_ptr<Explainer>>
    create(const scene::Scene& scene, frame::SceneFacts facts, const scene::View& view,
           const frame::FrameOptions& options, Jobs& jobs, const ExplainOptions& how = {});
    bool finished() const { return rows_done_ == so_far_.rows.size(); }
    std::size_t rows_done() const { return rows_done_; }
    // Switches the next row's effect, or goes on with its times; draws a few frames.
    void step();
    // All rows; those that step() has not come to yet have neither change nor milliseconds.
    const Explanation& so_far() const { return so_far_; }

private:
    Explainer(const scene::Scene& scene, frame::SceneFacts facts, const scene::View& view,
              const frame::FrameOptions& options, Jobs& jobs, const ExplainOptions& how);
    Result<void> begin();
    Result<void> count_pixels();
    Result<int> special_rows() const;
    std::optional<frame::FrameOptions> switched(EffectRow& row) const;
    std::optional<frame::FrameOptions> automatic(std::string_view axis) const;
    image::Image shown(const image::Image& picture, const frame::FramePlan& plan) const;
    Change change_to(const frame::FramePlan& other);
    void compare_row();
    // A plan whose frames are timed beside those of the plan that is explained.
    struct Timing {
        frame::FramePlan plan;
        std::optional<Price>* price; // where it is to stand
        bool other_costs_more;       // the price is that of the other plan
    };
    void time(const frame::FramePlan& other, std::optional<Price>& price,
              bool other_costs_more = false);
    void step_timing();

    const scene::Scene& scene_;
    scene::View view_;
    frame::FrameOptions options_;
    frame::SceneFacts facts_;
    ExplainOptions how_;
    RendererPair renderers_; // of the plan, and of those that it is compared with
    frame::FramePlan plan_;
    image::Image picture_;
    std::map<std::string, double, std::less<>> shares_;
    FacesAway faces_away_;
    Explanation so_far_;
    std::size_t rows_done_ = 0;
    // Of the row that is being measured: what is left to time, the last one first.
    std::vector<Timing> timings_;
    std::optional<PairedTimer> timer_; // of the last
};

} // namespace scanout::measure
