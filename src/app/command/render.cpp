// scanout render: models, drawn to files without a display.
#include "app/command/commands.h"
#include "app/files.h"
#include "app/frontier/budget.h"
#include "app/message.h"
#include "app/model_arguments.h"
#include "app/model_file.h"
#include "app/moving/moment.h"
#include "app/moving/motion_file.h"
#include "app/picture/picture.h"
#include "app/picture/render_run.h"
#include "app/progress_bar.h"
#include "app/report/report.h"
#include "base/check.h"
#include "scene/shared_camera.h"
#include "simd/targets.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include <unistd.h>

namespace scanout::app {
namespace {

// The pictures of the whole run, shards of others included.
int all_pictures(const Settings& s) {
    return static_cast<int>(s.arguments.size()) * pictures(s);
}
// Is it drawn by this shard?
bool is_drawn(const Settings& s, int model, int index) {
    return !s.shard || (model * pictures(s) + index) % s.shard->count == s.shard->index;
}

// All pictures go into one file.
bool in_one_file(const Settings& s, PictureFormat format) {
    return s.sheet || format == PictureFormat::apng || format == PictureFormat::y4m;
}

Result<void> check_pair(const Settings& s) {
    if (!s.pair) return {};
    if (s.arguments.size() != 2)
        return fail(Exit::usage, "--pair draws two models, not {}", s.arguments.size());
    const scene::ModelTransform& m = s.model;
    if (s.turntable > 1 || s.motion || m.scale != DVec3(1) || m.rotate_degrees != DVec3(0) ||
        m.translate != DVec3(0) || !m.steps.empty())
        return fail(Exit::usage,
                    "--pair draws models where they lie in their files: leave "
                    "--turntable, --motion and transforms (--scale, --rotate ...) out");
    if (s.limits.any())
        return fail(Exit::usage, "--pair draws both with the same rungs: name them in place of {}",
                    s.limits.wall_ms ? "--budget" : "--max-error");
    return {};
}

// Everything that can be wrong about the command line is said before the model is read.
Result<PictureFormat> check_render(const Settings& s) {
    const std::size_t models = s.arguments.size();
    if (models == 0)
        return fail(Exit::usage, "name a model to draw, as in `scanout render "
                                 "models/spot/spot.obj -o spot.png`");
    TRY_VOID(check_pair(s));
    if (models > 1 && !s.output.empty() && !has_name(s.output) && !s.sheet)
        return fail(Exit::usage, "{}: {} models want {{name}} in the name, as in {{name}}.png",
                    s.output, models);
    if (models > 1 && std::count(s.arguments.begin(), s.arguments.end(), "-") > 0)
        return fail(Exit::usage, "- is standard input: draw it alone");
    if (!s.animation.empty() && s.range && s.arguments.front() == "-")
        return fail(Exit::usage, "- is read once, an animation's file for each frame: name the "
                                 "file, or draw one moment by --time");
    if (s.reference && s.frames > 1)
        return fail(Exit::usage, "--frames {} times the renderer; --reference draws once",
                    s.frames);
    if (s.output.empty()) {
        if (s.hash || s.json) return PictureFormat::png;
        return fail(Exit::usage,
                    "where should the picture go? say -o picture.png, or --hash, or --json");
    }
    TRY(const PictureFormat format, picture_format(s.output, s.picture_format));
    if (s.sheet && (has_name(s.output) || has_number(s.output)))
        return fail(Exit::usage, "{}: --sheet makes one picture: leave {} out of its name",
                    s.output, has_name(s.output) ? "{name}" : "{n}");
    if (s.shard && in_one_file(s, format))
        return fail(Exit::usage,
                    "--shard {}/{} draws a part of the pictures; write a file each, "
                    "as in -o '{{name}}-{{n}}.png'",
                    s.shard->index + 1, s.shard->count);
    TRY_VOID(check_output_size(s, format, all_pictures(s)));
    if (s.output == "-") {
        if (s.json == "-" || s.hash)
            return fail(Exit::usage, "the picture takes standard output; {}",
                        s.hash ? "give -o FILE with --hash" : "say --json=FILE");
        if (::isatty(STDOUT_FILENO) == 1)
            return fail(Exit::usage,
                        "standard output is a terminal; say -o picture.png, or pipe it on");
        if (pictures(s) > 1 && format == PictureFormat::png && !s.sheet)
            return fail(Exit::usage,
                        "several pictures in one stream: say --format y4m, apng, ppm, pam or raw");
    } else if (pictures(s) > 1 && !has_number(s.output) && !in_one_file(s, format)) {
        return fail(Exit::usage,
                    "{}: {} pictures want {{{}}} in the name, as in turn-{{{}}}.png; or an "
                    "animation, as in turn.apng",
                    s.output, pictures(s), s.range ? "frame" : "n", s.range ? "frame" : "n");
    }
    return format;
}

Result<void> check_files(const Settings& s, PictureFormat format) {
    if (s.sheet) return check_outputs(s.arguments, {s.json.value_or(""), s.output});
    const int files = in_one_file(s, format) ? 1 : pictures(s); // of a model
    for (int index = 0; index < files; ++index) { // whose names differ from each other
        std::vector<std::string> outputs = {s.json.value_or("")};
        for (const std::string& model : s.arguments)
            outputs.push_back(numbered(named(s.output, model), s, index));
        TRY_VOID(check_outputs(s.arguments, outputs));
    }
    return {};
}

// Rungs that meet --budget and --max-error, by the first picture. Where there is nothing to choose
// by, a warning, and the picture is drawn as it is asked for; limits that are missed are an error.
Result<std::optional<Chosen>> choose_for(const Settings& s, const LoadedModel& model,
                                         const scene::CameraOptions& camera, Jobs& jobs,
                                         std::vector<std::string>& warnings) {
    const frame::SceneFacts facts = frame::facts(model.scene, s.frame.shadow_plane);
    const double seconds = seconds_of(s, 0);
    const Moment first = moment_of(s, camera, seconds);
    frame::FrameOptions options = s.frame;
    put_lights(s, seconds, options.lights);
    TRY(const scene::View view, scene::make_view(model.scene.mesh, first.model, {}, first.camera,
                                                 {}, options.width, options.height));
    std::string bar_of;
    std::optional<ProgressBar> bar;
    const auto progress = [&](std::string_view doing, double fraction) {
        if (bar_of != doing) bar.emplace(fmt::format("{} {}", doing, model.scene.path), s.quiet);
        bar_of = doing;
        bar->show(fraction);
    };
    Result<Chosen> chosen = choose_rungs(
        {model.scene, facts, view, options, free_axes(s), jobs, s.max_memory_mb, progress},
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

// All frames of a motion, where the output takes many pictures and nothing says which.
Result<void> choose_frames(Settings& s) {
    if (!s.motion || s.time || s.range) return {};
    const auto format = picture_format(s.output, s.picture_format);
    if (!has_number(s.output) && !(format && in_one_file(s, *format))) return {};
    TRY(s.range, whole(*s.motion, s.fps));
    return {};
}

// What a run gives for one model.
struct Rendered {
    RunReport report;
    bool blank = false; // one of its pictures shows nothing of it
};

// The pictures of a run, model by model.
class Run {
public:
    Run(const Settings& all, PictureFormat format, std::uint64_t start_bytes)
        : all_(all), format_(format), start_bytes_(start_bytes), jobs_(all.threads) {
        if (all.sheet && !all.output.empty()) sheet_ = make_output(all, format);
    }

    Result<Exit> draw_all() {
        if (all_.pair) return draw_pair();
        for (std::size_t i = 0; i < all_.arguments.size(); ++i) {
            if (!draws_of(static_cast<int>(i))) continue;
            const Settings one = only(i);
            Result<LoadedModel> model = load_model_with_messages(one.arguments.front(), one, jobs_);
            const Result<Rendered> rendered =
                model ? draw(one, static_cast<int>(i), *model, fitted_camera_of(one, *model))
                      : tl::unexpected(model.error());
            TRY_VOID(note(rendered));
        }
        return finish();
    }

private:
    bool draws_of(int model) const {
        for (int index = 0; index < pictures(all_); ++index)
            if (is_drawn(all_, model, index)) return true;
        return false;
    }

    // The settings with this model alone, and with its own output.
    Settings only(std::size_t model) const {
        Settings one = all_;
        one.arguments = {all_.arguments[model]};
        one.output = named(all_.output, all_.arguments[model]);
        return one;
    }

    // Both are in memory: the camera is of both.
    Result<Exit> draw_pair() {
        const Settings settings[] = {only(0), only(1)};
        TRY(const LoadedModel first,
            load_model_with_messages(all_.arguments[0], settings[0], jobs_));
        TRY(const LoadedModel second,
            load_model_with_messages(all_.arguments[1], settings[1], jobs_));
        const double aspect = static_cast<double>(all_.frame.width) / all_.frame.height;
        const auto [of_first, of_second] = scene::shared_cameras(
            first.whole_mesh(), second.whole_mesh(), camera_of(all_, first), aspect);
        if (is_drawn(all_, 0, 0)) TRY_VOID(note(draw(settings[0], 0, first, of_first)));
        if (is_drawn(all_, 1, 0)) TRY_VOID(note(draw(settings[1], 1, second, of_second)));
        return finish();
    }

    Result<Rendered> draw(Settings settings, int number, const LoadedModel& model,
                          const scene::CameraOptions& camera) {
        CHECK(simd::choose_target(settings.target)); // read_target let only these through
        Rendered rendered;
        RunReport& report = rendered.report;
        report.model_path = model.scene.path;
        report.counts = model.scene.counts;
        report.load_ms = model.load_ms;
        report.load_times = model.load_times;
        report.warnings = model.warnings;
        report.measured = settings.measured;
        report.start_bytes = start_bytes_;
        report.threads = jobs_.threads();
        if (settings.limits.any()) {
            TRY(report.chosen, choose_for(settings, model, camera, jobs_, report.warnings));
            if (report.chosen)
                settings.frame =
                    measure::with(std::move(settings.frame), report.chosen->point.rungs);
        }
        const std::unique_ptr<PictureOutput> own =
            sheet_ || settings.output.empty() ? nullptr : make_output(settings, format_);
        PictureOutput* const output = own ? own.get() : sheet_.get();
        RenderRun run(settings, format_, model, camera, output, jobs_);
        LoadedModel moment; // of an animation, for each frame anew
        for (int index = 0; index < pictures(settings); ++index) {
            if (!is_drawn(all_, number, index)) continue;
            if (model.scene.animated && settings.range) {
                TRY(moment, model_at(settings, index, model));
                run.use(moment);
            }
            TRY_VOID(run.draw(index, report));
        }
        if (own) TRY_VOID(own->finish());
        rendered.blank = run.drew_a_blank();
        return rendered;
    }

    Result<LoadedModel> model_at(const Settings& settings, int index, const LoadedModel& model) {
        Settings then = settings;
        then.time = seconds_of(settings, index);
        then.range.reset();
        const geom::Mesh& mesh = model.whole_mesh();
        return load_model(
            settings.arguments.front(), then, jobs_, [](double) { return true; }, nullptr,
            io::Reach(mesh.box_min, mesh.box_max));
    }

    // A model that cannot be drawn ends a run of one; of several, the others are drawn
    // nevertheless.
    Result<void> note(const Result<Rendered>& rendered) {
        if (rendered) {
            reports_.push_back(rendered->report);
            if (all_.fail_if_empty && rendered->blank && exit_ == Exit::ok) exit_ = Exit::hazards;
            return {};
        }
        if (all_.arguments.size() == 1) return tl::unexpected(rendered.error());
        say("scanout: " + rendered.error().what);
        if (exit_ == Exit::ok || exit_ == Exit::hazards) exit_ = rendered.error().exit;
        return {};
    }

    Result<Exit> finish() {
        if (sheet_ && !reports_.empty()) TRY_VOID(sheet_->finish());
        if (all_.json)
            TRY_VOID(write_report(all_, all_.arguments.size() == 1 && !reports_.empty()
                                            ? to_json(reports_.front())
                                            : to_json(reports_)));
        return exit_;
    }

    const Settings& all_;
    PictureFormat format_;
    std::uint64_t start_bytes_;
    Jobs jobs_;
    std::unique_ptr<PictureOutput> sheet_; // of all models; null: each has outputs of its own
    std::vector<RunReport> reports_;
    Exit exit_ = Exit::ok;
};

} // namespace

Result<Exit> run_render(const Settings& given, std::uint64_t start_bytes) {
    Settings settings = given;
    TRY(settings.arguments, models_of(given.arguments));
    TRY_VOID(read_motion(settings));
    TRY_VOID(choose_frames(settings));
    if (settings.pair && !settings.sheet && !has_name(settings.output))
        settings.sheet = SheetGrid{2, 1};
    TRY(const PictureFormat format, check_render(settings));
    TRY_VOID(check_files(settings, format));
    return Run(settings, format, start_bytes).draw_all();
}

} // namespace scanout::app
