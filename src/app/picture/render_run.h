// Draws the pictures of one model, in order, and writes and counts each.
#pragma once

#include "app/model_file.h"
#include "app/options/settings.h"
#include "app/picture/picture_output.h"
#include "app/report/report.h"
#include "base/jobs.h"
#include "frame/plan/plan_cache.h"
#include "frame/renderer.h"

#include <string>

namespace scanout::app {

class RenderRun {
public:
    // output: null where no picture is kept.
    RenderRun(const Settings& settings, PictureFormat format, const LoadedModel& model,
              const scene::CameraOptions& camera, PictureOutput* output, Jobs& jobs);
    RenderRun(const RenderRun&) = delete; // references into it
    RenderRun& operator=(const RenderRun&) = delete;

    // The same model at another moment: it outlives what is drawn of it.
    void use(const LoadedModel& model);
    // Appends to the report what was drawn.
    Result<void> draw(int index, RunReport& report);
    // Was one of the pictures its background everywhere?
    bool drew_a_blank() const { return drew_a_blank_; }

private:
    Result<void> draw_reference(int index, const scene::View& view, const frame::FramePlan& plan,
                                RunReport& report);
    Result<void> draw_textbook(int index, const scene::View& view, const frame::FramePlan& plan,
                               RunReport& report);
    Result<void> finish(const image::Image& picture, int index, RunReport& report);
    image::Image with_measured(const image::Image& picture, const scene::View& view) const;
    void tell(const frame::FramePlan& plan, RunReport& report) const;
    void tell_if_blank(const scene::View& view, const frame::FramePlan& plan,
                       const image::Image& picture, const frame::FrameStats& stats,
                       RunReport& report);
    std::uint64_t hash_of(const image::Image& picture) const;
    std::size_t covered_pixels(const image::Image& picture) const;
    Result<void> write(const image::Image& picture, int index, RunReport& report);

    std::string caption_of(int index) const;

    const Settings& settings_;
    PictureFormat format_;
    const scene::Scene* scene_;
    scene::CameraOptions camera_;
    frame::PlanCache plan_;
    frame::FrameOptions options_; // of the settings, with the lights of the picture's moment
    Jobs& jobs_;
    frame::Renderer renderer_;
    PictureOutput* output_;
    bool first_ = true; // no picture of this model was drawn yet
    bool told_blank_ = false, drew_a_blank_ = false;
};

} // namespace scanout::app
