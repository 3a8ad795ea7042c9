// scanout explain: the plan of a frame as a table.
#include "app/command/commands.h"
#include "app/files.h"
#include "app/message.h"
#include "app/model_file.h"
#include "app/moving/moment.h"
#include "app/moving/motion_file.h"
#include "app/progress_bar.h"
#include "app/report/explain_report.h"
#include "app/report/report.h"
#include "base/check.h"
#include "simd/targets.h"

#include <optional>
#include <utility>

namespace scanout::app {
namespace {

Result<void> check_explain(const Settings& s) {
    if (s.arguments.size() != 1)
        return s.arguments.empty()
                   ? fail(Exit::usage, "name a model to explain, as in `scanout explain "
                                       "models/spot/spot.obj`")
                   : fail(Exit::usage, "explain takes one model, not {}; run it once for each",
                          fmt::join(s.arguments, " and "));
    return check_outputs(s.arguments, {s.json.value_or("")});
}

} // namespace

Result<Exit> run_explain(const Settings& given) {
    TRY_VOID(check_explain(given));
    Settings settings = given;
    TRY_VOID(read_motion(settings));
    Jobs jobs(settings.threads);
    TRY(LoadedModel model, load_model_with_messages(settings.arguments.front(), settings, jobs));
    TRY(const scene::View view, view_at_time(settings, model));
    CHECK(simd::choose_target(settings.target)); // read_target let only these through
    std::optional<ProgressBar> bar(std::in_place, "explaining " + model.scene.path, settings.quiet);
    measure::ExplainOptions how;
    how.times = !settings.no_times;
    how.display = settings.pixel_format;
    how.progress = [&](double fraction) { bar->show(fraction); };
    TRY(const measure::Explanation explanation,
        measure::explain(model.scene, view, settings.frame, jobs, how));
    bar.reset();
    warn(explanation.ignored_options, settings, model.warnings);
    if (settings.json != "-")
        for (const std::string& line : explain_table(model, explanation))
            say(line, stdout);
    TRY_VOID(write_report(settings, to_json(model, explanation)));
    return Exit::ok;
}

} // namespace scanout::app
