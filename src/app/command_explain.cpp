// scanout explain: the plan of a frame as a table.
#include "app/commands.h"
#include "app/explain_report.h"
#include "app/files.h"
#include "app/message.h"
#include "app/model_file.h"
#include "app/report.h"
#include "base/check.h"
#include "base/stopwatch.h"
#include "simd/targets.h"

#include <unistd.h>

namespace scanout::app {
namespace {

Result<void> check(const Settings& s) {
    if (s.arguments.size() != 1)
        return s.arguments.empty()
                   ? fail(Exit::usage, "name a model to explain, as in `scanout explain "
                                       "models/spot/spot.obj`")
                   : fail(Exit::usage, "explain takes one model, not {}; run it once for each",
                          fmt::join(s.arguments, " and "));
    return check_outputs(s.arguments, {s.json.value_or("")});
}

} // namespace

Result<Exit> run_explain(const Settings& settings) {
    TRY_VOID(check(settings));
    TRY(LoadedModel model, load_model_with_messages(settings.arguments.front(), settings));
    TRY(const scene::View view,
        scene::make_view(model.scene.mesh, settings.model, {}, settings.camera, {},
                         settings.frame.width, settings.frame.height));
    CHECK(simd::choose_target(settings.target)); // read_target let only these through
    Jobs jobs(settings.threads);
    const bool talks = !settings.quiet && ::isatty(STDERR_FILENO) == 1;
    const Stopwatch watch;
    bool shown = false;
    measure::ExplainOptions how;
    how.times = !settings.no_times;
    how.progress = [&](double share) {
        if (!talks || watch.milliseconds() < 1000) return;
        shown = true;
        say_over(fmt::format("explaining {} {:3.0f} %", model.scene.path, share * 100));
    };
    TRY(const measure::Explanation explanation,
        measure::explain(model.scene, view, settings.frame, jobs, how));
    if (shown) say_over("");
    print_warnings(explanation.in_vain, settings);
    model.warnings.insert(model.warnings.end(), explanation.in_vain.begin(),
                          explanation.in_vain.end());
    if (settings.json != "-")
        for (const std::string& line : explain_table(model, explanation))
            say(line, stdout);
    TRY_VOID(write_report(settings, to_json(model, explanation)));
    return Exit::ok;
}

} // namespace scanout::app
