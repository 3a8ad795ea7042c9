// scanout render: models, drawn to files without a display.
#include "app/budget.h"
#include "app/commands.h"
#include "app/files.h"
#include "app/message.h"
#include "app/model_file.h"
#include "app/picture.h"
#include "app/progress_bar.h"
#include "app/render_run.h"
#include "app/report.h"
#include "base/check.h"
#include "simd/targets.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <unistd.h>

namespace scanout::app {
namespace {

// Everything that can be wrong about the command line is said before the model is read.
Result<PictureFormat> check_render(const Settings& s) {
    const std::size_t models = s.arguments.size();
    if (models == 0)
        return fail(Exit::usage, "name a model to draw, as in `scanout render "
                                 "models/spot/spot.obj -o spot.png`");
    if (models > 1 && !s.output.empty() && !has_name(s.output))
        return fail(Exit::usage, "{}: {} models want {{name}} in the name, as in {{name}}.png",
                    s.output, models);
    if (models > 1 && std::count(s.arguments.begin(), s.arguments.end(), "-") > 0)
        return fail(Exit::usage, "- is standard input: draw it alone");
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
    for (int index = 0; index < pictures(s); ++index) { // whose names differ from each other
        std::vector<std::string> outputs = {s.json.value_or("")};
        for (const std::string& model : s.arguments)
            outputs.push_back(numbered(named(s.output, model), index, pictures(s)));
        TRY_VOID(check_outputs(s.arguments, outputs));
    }
    return {};
}

// Rungs that meet --budget and --max-error, by the first picture. Where there is nothing to choose
// by, a warning, and the picture is drawn as it is asked for; limits that are missed are an error.
Result<std::optional<Chosen>> choose_for(const Settings& s, const LoadedModel& model, Jobs& jobs,
                                         std::vector<std::string>& warnings) {
    const frame::SceneFacts facts = frame::facts(model.scene, s.frame.shadow_plane);
    TRY(const scene::View view,
        scene::make_view(model.scene.mesh, s.model, {}, fitted_camera_of(s, model), {},
                         s.frame.width, s.frame.height));
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

// What a run gives for one model.
struct Rendered {
    RunReport report;
    bool blank = false; // one of its pictures shows nothing of it
};

// `settings`: with this model alone, and with its own output.
Result<Rendered> render_model(Settings settings, PictureFormat format, Jobs& jobs,
                              std::uint64_t start_bytes) {
    TRY(const LoadedModel model,
        load_model_with_messages(settings.arguments.front(), settings, jobs));
    CHECK(simd::choose_target(settings.target)); // read_target let only these through
    Rendered rendered;
    RunReport& report = rendered.report;
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
    rendered.blank = run.drew_a_blank();
    return rendered;
}

Settings only(const Settings& all, const std::string& model) {
    Settings one = all;
    one.arguments = {model};
    one.output = named(all.output, model);
    return one;
}

} // namespace

Result<Exit> run_render(const Settings& settings, std::uint64_t start_bytes) {
    TRY(const PictureFormat format, check_render(settings));
    TRY_VOID(check_files(settings));
    Jobs jobs(settings.threads);
    std::vector<RunReport> reports;
    Exit exit = Exit::ok;
    for (const std::string& model : settings.arguments) {
        const Result<Rendered> rendered =
            render_model(only(settings, model), format, jobs, start_bytes);
        if (!rendered) {
            if (settings.arguments.size() == 1) return tl::unexpected(rendered.error());
            say("scanout: " + rendered.error().what); // the others are drawn nevertheless
            if (exit == Exit::ok || exit == Exit::hazards) exit = rendered.error().exit;
            continue;
        }
        reports.push_back(rendered->report);
        if (settings.fail_if_empty && rendered->blank && exit == Exit::ok) exit = Exit::hazards;
    }
    if (settings.json)
        TRY_VOID(write_report(settings, settings.arguments.size() == 1 ? to_json(reports.front())
                                                                       : to_json(reports)));
    return exit;
}

} // namespace scanout::app
