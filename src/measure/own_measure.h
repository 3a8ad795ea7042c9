// An axis's own measure, beside the picture's RMSE: what the axis is about, in its own unit, where
// errors of other axes do not hide it.
#pragma once

#include "base/jobs.h"
#include "frame/facts/facts.h"
#include "frame/options.h"
#include "frame/renderer.h"
#include "image/image.h"
#include "measure/ladder.h"
#include "measure/oracle.h"
#include "scene/scene.h"
#include "scene/view.h"

#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace scanout::measure {

struct OwnMeasure {
    std::string_view axis;
    std::string_view what; // "edges off by"
    std::string_view unit; // "pixels"
};
// Of each axis that has one; null of others.
const OwnMeasure* own_measure(std::string_view axis);

// Measures the pictures of one view. What is named outlives it; the reference has the picture's
// size.
class OwnMeasurer {
public:
    OwnMeasurer(const scene::Scene& scene, const frame::SceneFacts& facts, const scene::View& view,
                Jobs& jobs, const Oracle& oracle, const image::Image& reference);
    ~OwnMeasurer();
    // Of the frame with these options; nothing where the axis has no measure of its own, the view
    // has nothing that it could be measured of, or the plan refuses.
    std::optional<double> measure(std::string_view axis, const frame::FrameOptions& options);

private:
    struct Row;
    static const Row kRows[];
    friend const OwnMeasure* own_measure(std::string_view axis);

    std::optional<double> edges(const frame::FrameOptions& options);
    std::optional<double> depths(const frame::FrameOptions& options);
    std::optional<double> texels(const frame::FrameOptions& options);
    std::optional<double> shadows(const frame::FrameOptions& options);
    std::optional<double> codes_inside(const frame::FrameOptions& options);
    std::optional<double> codes_at_edges(const frame::FrameOptions& options);
    std::optional<double> codes_seen_through(const frame::FrameOptions& options);

    std::optional<double> codes_of_squares(const frame::FrameOptions& options);

    struct Drawn {
        image::Image picture;
        frame::Visibility visibility;
        shade::LinearPicture linear;
    };
    // At full size whatever the options say: what is measured by the sample must have the pixels of
    // the reference. A smaller frame's error is the axis render_scale's.
    std::optional<Drawn> draw(const scene::Scene& scene, const frame::SceneFacts& facts,
                              frame::FrameOptions options);
    std::optional<Drawn> draw(const frame::FrameOptions& options) {
        return draw(scene_, facts_, options);
    }
    std::optional<double> codes(const frame::FrameOptions& options, std::vector<float>& mask,
                                float counts, float (*ask)(const Oracle&, int x, int y));
    // Fills the list with the answer for each pixel, once.
    const std::vector<float>& answers(std::vector<float>& kept,
                                      float (*ask)(const Oracle&, int x, int y));
    template <class F>
    void for_pixels(F f) const; // f(x, y, number)

    const scene::Scene& scene_;
    const frame::SceneFacts& facts_;
    scene::View view_;
    Jobs& jobs_;
    const Oracle& oracle_;
    const image::Image& reference_;
    frame::Renderer renderer_;
    std::vector<float> covered_, inside_, seen_through_, lit_;
    struct Ramp; // a scene that shows u and v
    std::unique_ptr<Ramp> ramp_;
};

// Of all rungs of these ladders that were drawn, until `stop` says so; options: what is asked for.
void measure_own(std::vector<Ladder>& ladders, const frame::FrameOptions& options,
                 OwnMeasurer& measurer, const std::function<bool()>& stop);

} // namespace scanout::measure
