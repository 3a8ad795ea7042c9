// Ways to draw one picture, each a point of error against time: what it errs against the reference
// and what it takes more than the picture as it is asked for. Two ways that run the same stages are
// one point.
#pragma once

#include "base/jobs.h"
#include "base/result.h"
#include "frame/plan/plan.h"
#include "image/metrics.h"
#include "measure/paired.h"
#include "measure/renderer_pair.h"
#include "scene/scene.h"
#include "scene/view.h"

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::measure {

// A technique on an axis, instead of the one that is asked for.
struct Rung {
    std::string_view axis, technique;
    friend bool operator==(const Rung&, const Rung&) = default;
};

// "--aa samples_4 --texture trilinear": what to add to the command line; "" for nothing.
std::string options_of(const std::vector<Rung>& rungs);

struct Point {
    std::vector<Rung> rungs; // that differ from what is asked for; empty: as asked for
    frame::FramePlan plan;
    double first_ms = 0; // of wall time: its first frame, which also made room
    image::Metrics error;
    std::optional<float> mean_flip;
    std::optional<Price> price; // over the point as asked for
    std::string options() const { return options_of(rungs); }
};

class Points {
public:
    // The first point is the picture as asked for. Everything that is named outlives it; the
    // reference has the size that the options ask for, or is empty: then errors are not known, and
    // stay 0. Fails like frame::plan.
    static Result<std::unique_ptr<Points>> create(const scene::Scene& scene,
                                                  frame::SceneFacts facts, const scene::View& view,
                                                  const frame::FrameOptions& options, Jobs& jobs,
                                                  const image::Image& reference);

    const std::deque<Point>& all() const { return points_; }
    const Point& operator[](std::size_t point) const { return points_[point]; }
    // Draws and compares, unless a point draws alike already. Fails like frame::plan.
    Result<std::size_t> at(const std::vector<Rung>& rungs);
    // Two frames of the point and two of the first one, in turn, until both are timed; true then.
    bool time_more(std::size_t point, double seconds);
    // What another plan takes less than the first point, and the pixels in which they differ.
    struct Saving {
        Price price;
        std::int64_t pixels = 0;
    };
    Saving saving(const frame::FramePlan& without, double seconds);
    // FLIP, of many at once: it takes about a microsecond a pixel.
    void look_at(const std::vector<std::size_t>& points);

    image::Image drawn(std::size_t point); // once more
    Result<frame::FramePlan> plan(const frame::FrameOptions& options) const;
    const frame::FrameOptions& options() const { return options_; }
    bool has_errors() const { return !reference_.pixels().empty(); }
    // Of the point as asked for: medians of all its timed frames; nothing before any.
    std::optional<Cost> cost() const { return renderers_.cost_of_a(); }

private:
    Points(const scene::Scene& scene, frame::SceneFacts facts, const scene::View& view,
           const frame::FrameOptions& options, Jobs& jobs, const image::Image& reference);

    const scene::Scene& scene_;
    frame::SceneFacts facts_;
    scene::View view_;
    frame::FrameOptions options_;
    Jobs& jobs_;
    const image::Image& reference_;
    RendererPair renderers_;           // of the first point, and of the others
    std::deque<Point> points_;         // stay where they are: timer_ names them
    std::size_t timed_ = 0;            // the point that timer_ times
    std::optional<PairedTimer> timer_; // until it is finished
};

} // namespace scanout::measure
