// scanout frontier: what accuracy costs in time, on the user's model and machine.
#include "app/command/commands.h"
#include "app/files.h"
#include "app/frontier/chart.h"
#include "app/frontier/files.h"
#include "app/frontier/pictures.h"
#include "app/interrupt.h"
#include "app/machine.h"
#include "app/message.h"
#include "app/model_file.h"
#include "app/moving/moment.h"
#include "app/moving/motion_file.h"
#include "app/options/quick.h"
#include "app/picture/picture.h"
#include "app/picture/reference.h"
#include "app/progress_bar.h"
#include "app/report/report.h"
#include "base/check.h"
#include "base/stopwatch.h"
#include "frame/catalogue.h"
#include "frame/facts/facts.h"
#include "frame/plan/ignored_options.h"
#include "measure/own_measure.h"
#include "simd/targets.h"
#include "trace/render.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace scanout::app {
namespace {

// What is spent where the user does not say, and it need not be quick.
constexpr double kSeconds = 40;
constexpr std::uint32_t kSamples = 1024; // of the reference, at most

std::vector<std::string> outputs_of(const Settings& s) {
    return {s.json.value_or(""), s.csv, s.chart_svg, s.chart_png, s.sheet_png, s.report_html};
}

Result<void> check_frontier(const Settings& s) {
    if (s.arguments.size() != 1)
        return s.arguments.empty()
                   ? fail(Exit::usage, "name a model to measure, as in `scanout frontier "
                                       "models/spot/spot.obj`")
                   : fail(Exit::usage, "frontier takes one model, not {}; run it once for each",
                          fmt::join(s.arguments, " and "));
    const std::vector<std::string_view> axes = measure::ladder_axes();
    for (const std::string& axis : s.axes)
        if (std::find(axes.begin(), axes.end(), axis) == axes.end())
            return fail(Exit::usage, "--axis {}: it has no ladder of rungs; these have: {}", axis,
                        fmt::join(axes, " "));
    if (s.no_times && !(s.chart_svg.empty() && s.chart_png.empty()))
        return fail(Exit::usage, "--svg and --png draw errors against times; leave --no-times out");
    for (const auto& [file, option] : {std::pair(s.chart_png, "--png"), {s.sheet_png, "--sheet"}})
        if (!file.empty() && file != "-" && format_of_name(file) != PictureFormat::png)
            return fail(Exit::usage, "{}: {} writes a PNG; name it so", file, option);
    const std::vector<std::string> outputs = outputs_of(s);
    TRY_VOID(check_standard_output(outputs));
    return check_outputs(s.arguments, outputs);
}

class FrontierRun {
public:
    FrontierRun(const Settings& settings, const LoadedModel& model, const scene::View& view,
                Jobs& jobs)
        : settings_(settings), model_(model), view_(view), jobs_(jobs),
          facts_(frame::facts(model.scene, settings.frame.shadow_plane)) {}

    Result<FrontierReport> measured() {
        FrontierReport report;
        report.model_path = model_.scene.path;
        report.triangles = model_.scene.counts.triangles;
        report.width = settings_.frame.width;
        report.height = settings_.frame.height;
        report.threads = jobs_.threads();
        report.target = simd::chosen_target();
        report.machine = machine_name();
        report.date = today();
        report.warnings = model_.warnings;
        TRY_VOID(draw_reference(report));
        const Interrupt interrupt;
        std::optional<ProgressBar> bar(std::in_place, "measuring " + model_.scene.path,
                                       settings_.quiet);
        measure::FrontierOptions how;
        if (!settings_.axes.empty()) how.axes = settings_.axes;
        how.times = !settings_.no_times;
        if (settings_.seconds > 0)
            how.seconds = settings_.seconds;
        else if (how.times) // errors alone do not depend on the clock: there all are measured
            how.seconds = settings_.quick ? kQuickSeconds : kSeconds;
        how.seconds_a_point = seconds_a_point(how.seconds);
        if (settings_.quick || settings_.no_times)
            how.flip = measure::FrontierOptions::Flip::of_frontier;
        how.progress = [&](double fraction) { bar->show(fraction); };
        how.stop = Interrupt::asked;
        TRY(report.found, measure::frontier(model_.scene, facts_, view_, settings_.frame, jobs_,
                                            report.reference, how));
        bar.reset();
        TRY_VOID(measure_own(report));
        for (const std::string& chart : {settings_.chart_svg, settings_.chart_png})
            if (!chart.empty() && !report.has_frontier())
                warn({fmt::format("{}: not written: {}", chart,
                                  report.compared()
                                      ? "the measurement ended before anything was timed"
                                      : "without a reference there are no errors to draw")},
                     settings_, report.warnings);
        if (!settings_.sheet_png.empty() && !report.compared())
            warn({fmt::format("{}: not written: without a reference there are no errors to show",
                              settings_.sheet_png)},
                 settings_, report.warnings);
        warn(frame::ignored_options((*report.found.points)[0].plan), settings_, report.warnings);
        return report;
    }

private:
    // Of what is asked for, but for rungs.
    Result<void> draw_reference(FrontierReport& report) {
        const Result<trace::Look> look =
            look_of_rungs(model_.scene, facts_, view_, settings_.frame, settings_.max_memory_mb);
        if (!look) {
            const bool too_large = look.error().exit == Exit::unreadable;
            if (!too_large || settings_.no_times) return tl::unexpected(look.error());
            warn({look.error().what + "; times alone are measured"}, settings_, report.warnings);
            return {};
        }
        look_ = *look;
        const Stopwatch watch;
        trace::Effort effort{settings_.quick ? kQuickSamples : kSamples};
        if (settings_.reference_samples > 0)
            effort.most_samples = static_cast<std::uint32_t>(settings_.reference_samples);
        ProgressBar bar("tracing " + model_.scene.path, settings_.quiet);
        TRY(trace::Reference made,
            reference_of_rungs(model_.scene, view_, look_, jobs_, effort,
                               [&](double fraction) { bar.show(fraction); }));
        warn(left_out_of_reference(model_.scene), settings_, report.warnings);
        report.reference_ms = watch.milliseconds();
        report.reference_samples = made.samples;
        report.noise = made.noise;
        report.reference = std::move(made.image);
        return {};
    }

    // Each rung by the measure of its axis, against rays of the reference.
    Result<void> measure_own(FrontierReport& report) {
        if (!report.compared()) return {};
        TRY(const std::unique_ptr<measure::Oracle> oracle, oracle_of(model_.scene, view_, look_));
        measure::OwnMeasurer measurer(model_.scene, facts_, view_, jobs_, *oracle,
                                      report.reference);
        measure::measure_own(report.found.ladders, settings_.frame, measurer, Interrupt::asked);
        return {};
    }

    const Settings& settings_;
    const LoadedModel& model_;
    const scene::View& view_;
    Jobs& jobs_;
    frame::SceneFacts facts_;
    trace::Look look_; // of the reference, where there is one
};

Result<void> write_text(const std::string& path, std::string_view text) {
    if (path.empty()) return {};
    return write_picture(path, image::Bytes(text.begin(), text.end()));
}

Result<void> write_png(const std::string& path, const std::function<image::Image()>& draw) {
    if (path.empty()) return {};
    TRY(const image::Bytes png, image::encode_png(draw()));
    return write_picture(path, png);
}

// The longest is made before the first is written.
Result<void> write_files(const Settings& settings, const FrontierReport& report) {
    std::string html;
    if (!settings.report_html.empty()) {
        TRY(html, frontier_html(report));
    }
    TRY_VOID(write_text(settings.csv, frontier_csv(report)));
    TRY_VOID(write_text(settings.report_html, html));
    if (report.has_frontier()) {
        const Chart chart = frontier_chart(report);
        TRY_VOID(write_text(settings.chart_svg, chart_svg(chart)));
        TRY_VOID(write_png(settings.chart_png, [&] { return chart_picture(chart); }));
    }
    if (report.compared())
        TRY_VOID(write_png(settings.sheet_png, [&] { return contact_sheet(report); }));
    return write_report(settings, to_json(report));
}

// The axis that comes only on request is asked for where its ladder is.
Settings with_what_axes_ask(Settings s) {
    const bool named = std::find(s.axes.begin(), s.axes.end(), measure::kOnRequest) != s.axes.end();
    if (named && frame::is_auto(frame::asked_for(s.frame, measure::kOnRequest)))
        frame::ask(s.frame, measure::kOnRequest, frame::names_on(measure::kOnRequest).back());
    return s;
}

} // namespace

Result<Exit> run_frontier(const Settings& asked) {
    TRY_VOID(check_frontier(asked));
    Settings settings = with_what_axes_ask(asked);
    TRY_VOID(read_motion(settings));
    Jobs jobs(settings.threads);
    TRY(const LoadedModel model,
        load_model_with_messages(settings.arguments.front(), settings, jobs));
    TRY(const scene::View view, view_at_time(settings, model));
    CHECK(simd::choose_target(settings.target)); // read_target let only these through
    TRY(const FrontierReport report, FrontierRun(settings, model, view, jobs).measured());
    const std::vector<std::string> outputs = outputs_of(settings);
    if (std::count(outputs.begin(), outputs.end(), "-") == 0)
        for (const std::string& line : frontier_text(report))
            say(line, stdout);
    TRY_VOID(write_files(settings, report));
    return Exit::ok;
}

} // namespace scanout::app
