#include "measure/points.h"

#include "base/check.h"
#include "base/stopwatch.h"
#include "image/compare.h"
#include "image/flip.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace scanout::measure {

std::string options_of(const std::vector<Rung>& rungs) {
    std::string text;
    for (const Rung& rung : rungs)
        text += fmt::format("{}--{} {}", text.empty() ? "" : " ", frame::option_of(rung.axis),
                            rung.technique);
    return text;
}

Points::Points(const scene::Scene& scene, frame::SceneFacts facts, const scene::View& view,
               const frame::FrameOptions& options, Jobs& jobs, const image::Image& reference)
    : scene_(scene), facts_(std::move(facts)), view_(view), options_(options), jobs_(jobs),
      reference_(reference), renderers_(scene, view_, jobs) {}

Result<std::unique_ptr<Points>> Points::create(const scene::Scene& scene, frame::SceneFacts facts,
                                               const scene::View& view,
                                               const frame::FrameOptions& options, Jobs& jobs,
                                               const image::Image& reference) {
    std::unique_ptr<Points> points(
        new Points(scene, std::move(facts), view, options, jobs, reference));
    TRY_VOID(points->at({}));
    Point& own = points->points_.front();
    own.price = equal_by_construction();
    return points;
}

Result<frame::FramePlan> Points::plan(const frame::FrameOptions& options) const {
    return frame::plan(options, facts_, view_);
}

Result<std::size_t> Points::at(const std::vector<Rung>& rungs) {
    frame::FrameOptions options = options_;
    for (const Rung& rung : rungs)
        CHECK(frame::ask(options, rung.axis, rung.technique));
    TRY(frame::FramePlan planned, plan(options));
    const auto alike = std::find_if(points_.begin(), points_.end(), [&](const Point& p) {
        return frame::draws_alike(p.plan, planned);
    });
    if (alike != points_.end()) return static_cast<std::size_t>(alike - points_.begin());
    const Stopwatch watch;
    const image::Image& picture = renderers_.b().render(scene_, view_, planned);
    Point point;
    point.first_ms = watch.milliseconds();
    point.rungs = rungs;
    if (has_errors()) point.error = image::metrics(reference_, picture);
    point.plan = std::move(planned);
    points_.push_back(std::move(point));
    return points_.size() - 1;
}

bool Points::time_more(std::size_t point, double seconds) {
    Point& p = points_[point];
    if (p.price && cost()) return true;
    if (!timer_ || timed_ != point) {
        timer_.emplace(renderers_.timer(points_.front().plan, p.plan, seconds));
        timed_ = point;
    }
    timer_->step();
    if (!timer_->finished()) return false;
    const Price price = -renderers_.finish(*timer_);
    timer_.reset();
    if (!p.price) p.price = price; // that of the first point is known before its cost
    return true;
}

Points::Saving Points::saving(const frame::FramePlan& without, double seconds) {
    if (frame::draws_alike(points_.front().plan, without)) return {equal_by_construction(), 0};
    const image::Difference d =
        image::compare(renderers_.a().render(scene_, view_, points_.front().plan),
                       renderers_.b().render(scene_, view_, without));
    PairedTimer timer = renderers_.timer(points_.front().plan, without, seconds);
    while (!timer.finished())
        timer.step();
    return {renderers_.finish(timer), d.differing_pixels};
}

image::Image Points::drawn(std::size_t point) {
    return renderers_.b().render(scene_, view_, points_[point].plan);
}

void Points::look_at(const std::vector<std::size_t>& points) {
    const auto at_once = static_cast<std::size_t>(jobs_.threads());
    for (std::size_t first = 0; first < points.size(); first += at_once) {
        std::vector<image::Image> pictures;
        for (std::size_t i = first; i < std::min(first + at_once, points.size()); ++i)
            pictures.push_back(drawn(points[i]));
        jobs_.for_each(static_cast<int>(pictures.size()), [&](int i, int) {
            const auto k = static_cast<std::size_t>(i);
            points_[points[first + k]].mean_flip = image::mean_flip(reference_, pictures[k]);
        });
    }
}

} // namespace scanout::measure
