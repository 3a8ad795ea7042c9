#include "trace/render.h"

#include "trace/progressive.h"

#include <algorithm>

namespace scanout::trace {

std::size_t Reference::unsure() const {
    return static_cast<std::size_t>(
        std::count_if(error.begin(), error.end(), [](float e) { return e >= kErrorWanted; }));
}

Result<Reference> render(const scene::Scene& scene, const scene::View& view, const Look& look,
                         Jobs& jobs, const std::function<void(double)>& progress,
                         const Effort& effort) {
    constexpr std::chrono::milliseconds kStep{50};
    TRY(const std::unique_ptr<Progressive> made, Progressive::create(scene, view, look, effort));
    while (!made->finished()) {
        if (progress) progress(made->share());
        made->step(jobs, std::chrono::steady_clock::now() + kStep);
    }
    return made->take();
}

} // namespace scanout::trace
