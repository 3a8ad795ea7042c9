// Two renderers of one scene, for frames of two plans in turn. Each keeps its plan's buffers, so
// that a frame is a steady one; which of the two has the luckier place in memory is chance, so the
// timer lets them change plans.
#pragma once

#include "frame/plan/plan.h"
#include "frame/renderer.h"
#include "measure/paired.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace scanout::measure {

class RendererPair {
public:
    // What is named outlives it.
    RendererPair(const scene::Scene& scene, const scene::View& view, Jobs& jobs)
        : scene_(scene), view_(view),
          jobs_(jobs), renderers_{frame::Renderer(jobs), frame::Renderer(jobs)} {}
    RendererPair(const RendererPair&) = delete;
    RendererPair& operator=(const RendererPair&) = delete;

    frame::Renderer& a() { return renderers_[a_]; }
    frame::Renderer& b() { return renderers_[1 - a_]; }
    // Of a frame of plan a over one of plan b, which outlive the timer as the pair does. The first
    // frames, which make room, are drawn before.
    PairedTimer timer(const frame::FramePlan& a, const frame::FramePlan& b, double seconds);
    // What a finished timer found; keeps the costs of its frames of plan a.
    Price finish(const PairedTimer& timer);
    // Medians of all that were kept, where all timers had the same plan a; nothing before any.
    std::optional<Cost> cost_of_a() const;

private:
    Cost frame(frame::Renderer& renderer, const frame::FramePlan& plan);
    const scene::Scene& scene_;
    const scene::View& view_;
    Jobs& jobs_;
    std::array<frame::Renderer, 2> renderers_;
    std::size_t a_ = 0; // whose is plan a
    std::vector<Cost> costs_of_a_;
};

} // namespace scanout::measure
