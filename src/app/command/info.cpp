// scanout info: what a model's file holds.
#include "app/command/commands.h"
#include "app/files.h"
#include "app/message.h"
#include "app/report/info_report.h"
#include "app/report/report.h"

#include <fmt/ranges.h>

namespace scanout::app {

Result<Exit> run_info(const Settings& settings) {
    if (settings.arguments.size() != 1)
        return settings.arguments.empty()
                   ? fail(Exit::usage,
                          "name a model to describe, as in `scanout info models/spot/spot.obj`")
                   : fail(Exit::usage, "info takes one model, not {}; run it once for each",
                          fmt::join(settings.arguments, " and "));
    TRY_VOID(check_outputs(settings.arguments, {settings.json.value_or("")}));
    Jobs jobs(settings.threads);
    io::ModelSource source;
    TRY(const LoadedModel model,
        load_model_with_messages(settings.arguments.front(), settings, jobs, &source));
    ModelInfo info = model_info(model, source, jobs);
    if (settings.order.given > 0)
        info.transform = scene::placement_of(settings.model, model.scene.mesh, info.up);
    if (settings.json != "-")
        for (const std::string& line : info_lines(info))
            say(line, stdout);
    TRY_VOID(write_report(settings, info_json(info)));
    return Exit::ok;
}

} // namespace scanout::app
