#include "measure/frame_time.h"

#include "base/stopwatch.h"
#include "frame/renderer.h"

#include <vector>

namespace scanout::measure {

Cost frame_cost(const scene::Scene& scene, const scene::View& view, const frame::FramePlan& plan,
                Jobs& jobs, double seconds) {
    constexpr std::size_t kFewest = 3;
    frame::Renderer renderer(jobs);
    renderer.render(scene, view, plan);
    const Stopwatch watch;
    std::vector<Cost> frames;
    while (frames.size() < kFewest || watch.milliseconds() < seconds * 1000)
        frames.push_back(cost_of(jobs, [&] { renderer.render(scene, view, plan); }));
    return medians(frames);
}

} // namespace scanout::measure
