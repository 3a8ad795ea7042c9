// The reference made in steps that end when they are told to, for a viewer that must hear its keys
// in between. A first estimate of every pixel can come before the rest. The finished picture is the
// same bit for bit, however the work was cut.
#pragma once

#include "base/jobs.h"
#include "base/result.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "trace/look.h"
#include "trace/render.h"
#include "trace/tracer.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace scanout::trace {

// What is known of a pixel: nothing, an estimate of kFewestSamples samples, or its final colour.
enum class Known : std::uint8_t { nothing, estimate, final };

class Progressive {
public:
    using Time = Tracer::Time;

    // Builds the hierarchy, which may take seconds; another thread may do it. The scene outlives
    // the result; view and look are copied. Fails like render(), and (Exit::usage) soon after
    // `cancelled` becomes true.
    static Result<std::unique_ptr<Progressive>>
    create(const scene::Scene& scene, const scene::View& view, const Look& look,
           const Effort& effort = {}, const std::atomic<bool>* cancelled = nullptr);

    // That its pictures take beside the hierarchy (Bvh::bytes), about.
    static std::uint64_t bytes(int width, int height);

    // Traces until `until`, and little longer: four samples of a pixel, and once in each stage as
    // long as a look at the whole picture takes.
    void step(Jobs& jobs, Time until);
    bool finished() const { return stage_ == Stage::finished; }
    double share() const; // of the work that is done, about

    // The codes of the pixels of which something is known.
    const image::Image& image() const { return made_.image; }
    Known known(int pixel) const { return known_[static_cast<std::size_t>(pixel)]; }
    const Reference& reference() const { return made_; } // once it is finished
    Reference take() { return std::move(made_); }        // the same, once

private:
    // In this order. Where few samples of a pixel may all have missed what a neighbour shows much
    // of (the thin end of a penumbra, the tip of a triangle, an edge that runs on beside it), it is
    // traced once more with many; and so its own neighbours, until none is left.
    enum class Stage : std::uint8_t { estimate, settle, beside_hard_ones, finished };

    Progressive(const scene::View& view, const Look& look, const Effort& effort);
    void begin(Stage stage);
    void put(const PixelSamples& pixel);
    std::vector<int> all_pixels() const;
    // The pixels that are to be traced once more, marked as such; `before`: the stage that ended.
    std::vector<int> beside_hard_ones(Stage before);
    void add_beside(int pixel, std::vector<int>& out); // its neighbours of these, if it is hard
    double noise() const;

    scene::View view_;
    Look look_;
    std::uint32_t most_samples_;
    std::unique_ptr<World> world_; // refers to view_ and look_
    std::unique_ptr<Tracer> tracer_;

    Stage stage_ = Stage::finished;
    std::vector<int> pixels_; // of the stage
    std::atomic<int> next_ = 0;
    std::vector<std::optional<PixelSamples>> begun_; // a job's, where a step ended within a pixel
    std::atomic<int> final_ = 0;                     // pixels
    Reference made_;
    std::vector<std::uint32_t> samples_;        // of each pixel
    std::vector<float> contrast_;               // of what its samples saw, codes
    std::vector<std::array<float, 2>> scatter_; // Scatter
    std::vector<bool> once_more_;               // traced
    std::vector<Known> known_;
};

} // namespace scanout::trace
