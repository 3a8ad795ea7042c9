// scanout render: a model, drawn to files without a display.
#include "app/budget.h"
#include "app/commands.h"
#include "app/files.h"
#include "app/message.h"
#include "app/model_file.h"
#include "app/picture.h"
#include "app/progress_bar.h"
#include "app/reference.h"
#include "app/report.h"
#include "base/check.h"
#include "base/stopwatch.h"
#include "frame/blank_picture.h"
#include "frame/plan/ignored_options.h"
#include "frame/plan/plan_cache.h"
#include "image/hash.h"
#include "simd/targets.h"
#include "trace/render.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <unistd.h>

namespace scanout::app {
namespace {

int pictures(const Settings& s) {
    return std::max(s.turntable, 1);
}

// Everything that can be wrong about the command line is said before the model is read.
Result<PictureFormat> check_render(const Settings& s) {
    if (s.arguments.size() != 1)
        return s.arguments.empty()
                   ? fail(Exit::usage, "name a model to draw, as in `scanout render "
                                       "models/spot/spot.obj -o spot.png`")
                   : fail(Exit::usage, "render draws one model, not {}; run it once for each",
                          fmt::join(s.arguments, " and "));
    if (s.reference && s.frames > 1)
        return fail(Exit::usage, "--frames {} times the renderer; --reference draws once",
                    s.frames);
    if (s.output.empty()) {
        if (s.hash || s.json) return PictureFormat::png;
        return fail(Exit::usage,
                    "where should the picture go? say -o picture.png, or --hash, or --json");
    }
    TRY(const PictureFormat format, picture_format(s.output, s.picture_format));
    if (s.output == "-") {
        if (s.json == "-" || s.hash)
            return fail(Exit::usage, "the picture takes standard output; {}",
                        s.hash ? "give -o FILE with --hash" : "say --json=FILE");
        if (::isatty(STDOUT_FILENO) == 1)
            return fail(Exit::usage,
                        "standard output is a terminal; say -o picture.png, or pipe it on");
        if (pictures(s) > 1 && format == PictureFormat::png)
            return fail(Exit::usage,
                        "several pictures in one stream: say --format ppm, pam or raw");
    } else if (pictures(s) > 1 && !has_number(s.output)) {
        return fail(Exit::usage, "{}: {} pictures want {{n}} in the name, as in turn-{{n}}.png",
                    s.output, pictures(s));
    }
    return format;
}

Result<void> check_files(const Settings& s) {
    for (int index = 0; index < pictures(s); ++index) // whose names differ from each other
        TRY_VOID(check_outputs(s.arguments,
                               {s.json.value_or(""), numbered(s.output, index, pictures(s))}));
    return {};
}

// Draws the pictures of one run, in order, and writes and counts each.
class RenderRun {
public:
    RenderRun(const Settings& settings, PictureFormat format, const LoadedModel& model, Jobs& jobs)
        : settings_(settings), format_(format), scene_(model.scene),
          camera_(camera_of(settings, model)),
          plan_(frame::facts(scene_, settings.frame.shadow_plane)), jobs_(jobs), renderer_(jobs) {}

    Result<void> draw(int index, RunReport& report) {
        scene::Pose pose;
        pose.yaw = scene::wrap_angle(std::int64_t{scene::kFullTurn} * index / pictures(settings_));
        TRY(const scene::View view,
            scene::make_view(scene_.mesh, settings_.model, pose, camera_, {}, settings_.frame.width,
                             settings_.frame.height));
        TRY(const frame::FramePlan* const plan, plan_.plan(settings_.frame, view));
        if (index == 0) tell(*plan, report);
        if (settings_.reference) return draw_reference(index, view, *plan, report);
        const image::Image* picture = nullptr;
        for (int repeat = 0; repeat < settings_.frames; ++repeat) {
            picture = &renderer_.render(scene_, view, *plan);
            if (settings_.json)
                report.frames.push_back({index, hash_of(*picture), picture->width(),
                                         picture->height(), renderer_.stats()});
        }
        if (!told_blank_) tell_if_blank(view, *plan, *picture, report);
        return finish(*picture, index, report);
    }

private:
    Result<void> draw_reference(int index, const scene::View& view, const frame::FramePlan& plan,
                                RunReport& report) {
        TRY(const trace::Look look, look_of(plan));
        TRY_VOID(check_reference_fits(scene_, look.width, look.height, settings_.max_memory_mb));
        if (index == 0) warn(left_out_of_reference(scene_), settings_, report.warnings);
        const Stopwatch watch;
        std::optional<ProgressBar> bar(std::in_place, "tracing " + scene_.path, settings_.quiet);
        TRY(const trace::Reference made,
            trace::render(scene_, view, look, jobs_, [&](double fraction) { bar->show(fraction); },
                          {settings_.reference_samples > 0
                               ? static_cast<std::uint32_t>(settings_.reference_samples)
                               : trace::kMostSamples}));
        bar.reset();
        if (settings_.verbose)
            say(fmt::format("{:.1f} samples a pixel, standard error {:.3f} codes, {} pixels above "
                            "{} codes",
                            static_cast<double>(made.samples) /
                                static_cast<double>(made.error.size()),
                            made.noise, made.unsure(), trace::kErrorWanted));
        if (settings_.json) {
            frame::FrameStats stats;
            stats.total_ms = watch.milliseconds();
            report.frames.push_back(
                {index, hash_of(made.image), made.image.width(), made.image.height(), stats});
            report.references.push_back({made.samples, made.noise, made.unsure()});
        }
        return finish(made.image, index, report);
    }

    Result<void> finish(const image::Image& picture, int index, RunReport& report) {
        if (settings_.hash && settings_.json != "-")
            fmt::print("{}\n", image::hash_text(hash_of(picture)));
        return settings_.output.empty() ? Result<void>() : write(picture, index, report);
    }

    void tell(const frame::FramePlan& plan, RunReport& report) const {
        if (settings_.verbose)
            for (const frame::Decision& decision : plan.decisions)
                say(to_string(decision));
        warn(frame::ignored_options(plan), settings_, report.warnings);
    }
    void tell_if_blank(const scene::View& view, const frame::FramePlan& plan,
                       const image::Image& picture, RunReport& report) {
        const auto why =
            frame::why_blank(scene_, view, camera_.up, plan, renderer_.stats(), picture);
        if (!why) return;
        told_blank_ = true; // of several pictures, once
        warn({*why}, settings_, report.warnings);
    }

    std::uint64_t hash_of(const image::Image& picture) const {
        if (settings_.pixel_format) return image::frame_hash(displayed(picture, settings_));
        return image::frame_hash(picture);
    }

    Result<void> write(const image::Image& picture, int index, RunReport& report) {
        const Stopwatch watch;
        // What a display shows goes into its bytes and comes out of them unchanged.
        const image::Image* written = &picture;
        image::Image shown;
        if (const auto& display = settings_.pixel_format;
            display && (format_ != PictureFormat::raw || dithers_unasked(settings_, *display))) {
            shown = displayed(picture, settings_);
            written = &shown;
        }
        TRY(const image::Bytes bytes, encode(*written, format_, settings_.pixel_format));
        if (index == 0) report.encode_ms = watch.milliseconds();
        const std::string path = numbered(settings_.output, index, pictures(settings_));
        TRY_VOID(write_picture(path, bytes));
        if (settings_.verbose)
            say(fmt::format("wrote {} ({} bytes, {:.1f} ms)", path, bytes.size(),
                            renderer_.stats().total_ms));
        return {};
    }

    const Settings& settings_;
    PictureFormat format_;
    const scene::Scene& scene_;
    scene::CameraOptions camera_;
    frame::PlanCache plan_;
    Jobs& jobs_;
    frame::Renderer renderer_;
    bool told_blank_ = false;
};

// Rungs that meet --budget and --max-error, by the first picture. Where there is nothing to choose
// by, a warning, and the picture is drawn as it is asked for; limits that are missed are an error.
Result<std::optional<Chosen>> choose_for(const Settings& s, const LoadedModel& model, Jobs& jobs,
                                         std::vector<std::string>& warnings) {
    const frame::SceneFacts facts = frame::facts(model.scene, s.frame.shadow_plane);
    TRY(const scene::View view, scene::make_view(model.scene.mesh, s.model, {}, camera_of(s, model),
                                                 {}, s.frame.width, s.frame.height));
    std::string bar_of;
    std::optional<ProgressBar> bar;
    const auto progress = [&](std::string_view doing, double fraction) {
        if (bar_of != doing) bar.emplace(fmt::format("{} {}", doing, model.scene.path), s.quiet);
        bar_of = doing;
        bar->show(fraction);
    };
    Result<Chosen> chosen = choose_rungs(
        {model.scene, facts, view, s.frame, free_axes(s), jobs, s.max_memory_mb, progress},
        s.limits);
    bar.reset();
    if (!chosen) {
        warn({none_chosen(s.limits, chosen.error())}, s, warnings);
        return std::nullopt;
    }
    warn(chosen->notes, s, warnings);
    if (!chosen->choice.met()) return fail(Exit::usage, "{}", chosen->instead);
    if (!s.quiet) say(to_text(*chosen));
    return std::optional(*std::move(chosen));
}

} // namespace

Result<Exit> run_render(const Settings& asked, std::uint64_t start_bytes) {
    Settings settings = asked;
    TRY(const PictureFormat format, check_render(settings));
    TRY_VOID(check_files(settings));
    Jobs jobs(settings.threads);
    TRY(const LoadedModel model,
        load_model_with_messages(settings.arguments.front(), settings, jobs));
    CHECK(simd::choose_target(settings.target)); // read_target let only these through
    RunReport report;
    report.model_path = model.scene.path;
    report.counts = model.scene.counts;
    report.load_ms = model.load_ms;
    report.load_times = model.load_times;
    report.warnings = model.warnings;
    report.start_bytes = start_bytes;
    report.threads = jobs.threads();
    if (settings.limits.any()) {
        TRY(report.chosen, choose_for(settings, model, jobs, report.warnings));
        if (report.chosen)
            settings.frame = measure::with(std::move(settings.frame), report.chosen->point.rungs);
    }
    RenderRun run(settings, format, model, jobs);
    for (int index = 0; index < pictures(settings); ++index)
        TRY_VOID(run.draw(index, report));
    if (settings.json) TRY_VOID(write_report(settings, to_json(report)));
    return Exit::ok;
}

} // namespace scanout::app
