#include "measure/renderer_pair.h"

namespace scanout::measure {

Cost RendererPair::frame(frame::Renderer& renderer, const frame::FramePlan& plan) {
    return cost_of(jobs_, [&] { renderer.render(scene_, view_, plan); });
}

PairedTimer RendererPair::timer(const frame::FramePlan& first, const frame::FramePlan& second,
                                double seconds) {
    const auto make_room = [this, &first, &second] {
        a().render(scene_, view_, first);
        b().render(scene_, view_, second);
    };
    make_room();
    return {[this, &first] { return frame(a(), first); },
            [this, &second] { return frame(b(), second); }, seconds,
            [this, make_room] {
                a_ = 1 - a_;
                make_room();
            }};
}

Price RendererPair::finish(const PairedTimer& timer) {
    const std::vector<Cost>& costs = timer.costs_of_a();
    costs_of_a_.insert(costs_of_a_.end(), costs.begin(), costs.end());
    return timer.price();
}

std::optional<Cost> RendererPair::cost_of_a() const {
    if (costs_of_a_.empty()) return std::nullopt;
    return medians(costs_of_a_);
}

} // namespace scanout::measure
