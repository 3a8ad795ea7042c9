#include "app/picture/render_run.h"

#include "app/files.h"
#include "app/frontier/measurement.h"
#include "app/message.h"
#include "app/moving/moment.h"
#include "app/options/textbook_options.h"
#include "app/overlay/overlay.h"
#include "app/picture/picture.h"
#include "app/picture/reference.h"
#include "app/progress_bar.h"
#include "base/stopwatch.h"
#include "frame/blank_picture.h"
#include "frame/plan/ignored_options.h"
#include "image/hash.h"
#include "trace/render.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace scanout::app {

RenderRun::RenderRun(const Settings& settings, PictureFormat format, const LoadedModel& model,
                     const scene::CameraOptions& camera, PictureOutput* output, Jobs& jobs)
    : settings_(settings), format_(format), scene_(&model.scene), camera_(camera),
      plan_(frame::facts(*scene_, settings.frame.shadow_plane)), options_(settings.frame),
      jobs_(jobs), renderer_(jobs), output_(output) {}

// Over the finished picture, as the viewer draws it.
image::Image RenderRun::with_measured(const image::Image& picture, const scene::View& view) const {
    image::Image drawn = picture;
    Overlay overlay;
    overlay.measured =
        measured_marks(settings_.measured, view, scene_->mesh, picture.width(), picture.height());
    overlay.message = fmt::format("{}", fmt::join(measured_text(settings_.measured), "\n"));
    draw_overlay(drawn, overlay);
    return drawn;
}

void RenderRun::use(const LoadedModel& model) {
    scene_ = &model.scene;
    plan_ = frame::PlanCache(frame::facts(*scene_, settings_.frame.shadow_plane));
}

Result<void> RenderRun::draw(int index, RunReport& report) {
    scene::Pose pose;
    if (settings_.turntable > 0)
        pose.yaw = scene::wrap_angle(std::int64_t{scene::kFullTurn} * index / settings_.turntable);
    const double seconds = seconds_of(settings_, index);
    const Moment now = moment_of(settings_, camera_, seconds);
    put_lights(settings_, seconds, options_.lights);
    TRY(const scene::View view, scene::make_view(scene_->mesh, now.model, pose, now.camera, {},
                                                 options_.width, options_.height));
    TRY(const frame::FramePlan* const plan, plan_.plan(options_, view));
    if (first_) tell(*plan, report);
    if (settings_.reference) return draw_reference(index, view, *plan, report);
    if (settings_.renderer) return draw_textbook(index, view, *plan, report);
    const image::Image *picture = nullptr, *shown = nullptr;
    image::Image measured;
    for (int repeat = 0; repeat < settings_.frames; ++repeat) {
        picture = shown = &renderer_.render(*scene_, view, *plan);
        if (!settings_.measured.empty()) shown = &(measured = with_measured(*picture, view));
        if (settings_.json)
            report.frames.push_back({index, hash_of(*shown), picture->width(), picture->height(),
                                     renderer_.stats(), covered_pixels(*picture)});
    }
    tell_if_blank(view, *plan, *picture, renderer_.stats(), report);
    return finish(*shown, index, report);
}

Result<void> RenderRun::draw_textbook(int index, const scene::View& view,
                                      const frame::FramePlan& plan, RunReport& report) {
    if (first_) warn(left_out_of_textbook(plan, *scene_), settings_, report.warnings);
    const textbook::Look look = textbook_look_of(plan);
    const textbook::Parts parts = textbook::parts_of(*settings_.renderer, settings_.parts);
    textbook::Picture made;
    frame::FrameStats stats;
    for (int repeat = 0; repeat < settings_.frames; ++repeat) {
        const Stopwatch watch;
        made = textbook::render(*scene_, view, look, parts);
        stats.total_ms = watch.milliseconds();
        stats.triangles_submitted = made.submitted;
        stats.triangles_drawn = made.drawn;
        if (settings_.json)
            report.frames.push_back({index, hash_of(made.image), look.width, look.height, stats,
                                     covered_pixels(made.image)});
    }
    tell_if_blank(view, plan, made.image, stats, report);
    if (!settings_.measured.empty()) made.image = with_measured(made.image, view);
    return finish(made.image, index, report);
}

Result<void> RenderRun::draw_reference(int index, const scene::View& view,
                                       const frame::FramePlan& plan, RunReport& report) {
    TRY(const trace::Look look, look_of(plan));
    TRY_VOID(check_reference_fits(*scene_, look.width, look.height, settings_.max_memory_mb));
    if (first_) warn(left_out_of_reference(*scene_), settings_, report.warnings);
    const Stopwatch watch;
    std::optional<ProgressBar> bar(std::in_place, "tracing " + scene_->path, settings_.quiet);
    TRY(trace::Reference made,
        trace::render(*scene_, view, look, jobs_, [&](double fraction) { bar->show(fraction); },
                      {settings_.reference_samples > 0
                           ? static_cast<std::uint32_t>(settings_.reference_samples)
                           : trace::kMostSamples}));
    bar.reset();
    if (!settings_.measured.empty()) made.image = with_measured(made.image, view);
    if (settings_.verbose)
        say(fmt::format("{:.1f} samples a pixel, standard error {:.3f} codes, {} pixels above "
                        "{} codes",
                        static_cast<double>(made.samples) / static_cast<double>(made.error.size()),
                        made.noise, made.unsure(), trace::kErrorWanted));
    if (settings_.json) {
        frame::FrameStats stats;
        stats.total_ms = watch.milliseconds();
        report.frames.push_back({index, hash_of(made.image), made.image.width(),
                                 made.image.height(), stats, covered_pixels(made.image)});
        report.references.push_back({made.samples, made.noise, made.unsure()});
    }
    return finish(made.image, index, report);
}

Result<void> RenderRun::finish(const image::Image& picture, int index, RunReport& report) {
    if (settings_.hash && settings_.json != "-")
        fmt::print("{}\n", image::hash_text(hash_of(picture)));
    if (output_ != nullptr) TRY_VOID(write(picture, index, report));
    first_ = false;
    return {};
}

void RenderRun::tell(const frame::FramePlan& plan, RunReport& report) const {
    if (settings_.verbose)
        for (const frame::Decision& decision : plan.decisions)
            say(to_string(decision));
    // What the annotations measure is nowhere else.
    if (const frame::Decision& d = *plan.decision("annotate"); !settings_.quiet && d.needed)
        say("scanout: " + d.because);
    for (const std::string& line : measured_text(settings_.measured))
        if (!settings_.quiet) say("scanout: " + line);
    warn(frame::ignored_options(plan), settings_, report.warnings);
}
void RenderRun::tell_if_blank(const scene::View& view, const frame::FramePlan& plan,
                              const image::Image& picture, const frame::FrameStats& stats,
                              RunReport& report) {
    const auto why = frame::why_blank(*scene_, view, camera_.up, plan, stats, picture);
    if (!why) return;
    drew_a_blank_ = true;
    if (std::exchange(told_blank_, true)) return; // of several pictures, once
    warn({*why}, settings_, report.warnings);
}

std::uint64_t RenderRun::hash_of(const image::Image& picture) const {
    if (settings_.pixel_format) return image::frame_hash(displayed(picture, settings_));
    return image::frame_hash(picture);
}

std::size_t RenderRun::covered_pixels(const image::Image& picture) const {
    const auto pixels = picture.pixels();
    return static_cast<std::size_t>(
        std::count_if(pixels.begin(), pixels.end(), [&](const image::Rgba8& pixel) {
            return pixel != settings_.frame.background;
        }));
}

Result<void> RenderRun::write(const image::Image& picture, int index, RunReport& report) {
    const Stopwatch watch;
    // What a display shows goes into its bytes and comes out of them unchanged.
    const image::Image* written = &picture;
    image::Image shown;
    if (const auto& display = settings_.pixel_format;
        display && (format_ != PictureFormat::raw || dithers_unasked(settings_, *display))) {
        shown = displayed(picture, settings_);
        written = &shown;
    }
    const double converted_ms = watch.milliseconds();
    TRY(const PictureOutput::Written done, output_->add(*written, index, caption_of(index)));
    if (first_) report.encode_ms = converted_ms + done.encode_ms;
    if (settings_.verbose && !done.path.empty())
        say(fmt::format("wrote {} ({} bytes, {:.1f} ms)", done.path, done.bytes,
                        renderer_.stats().total_ms));
    return {};
}

std::string RenderRun::caption_of(int index) const {
    const std::string name = file_name_of(scene_->path);
    if (settings_.range) return fmt::format("{} {:.4g} s", name, seconds_of(settings_, index));
    if (pictures(settings_) == 1) return name;
    return fmt::format("{} {:.4g} degrees", name, 360.0 * index / pictures(settings_));
}

} // namespace scanout::app
