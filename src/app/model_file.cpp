#include "app/model_file.h"

#include "app/files.h"
#include "app/message.h"
#include "app/progress_bar.h"
#include "base/stopwatch.h"
#include "io/load.h"

namespace scanout::app {

Result<LoadedModel> load_model(const std::string& path, const Settings& settings, Jobs& jobs,
                               const std::function<bool(double)>& progress) {
    if (path != "-") TRY_VOID(check_readable(path));
    const Stopwatch watch;
    Warnings warnings;
    io::LoadOptions options;
    options.progress = progress;
    options.jobs = &jobs;
    options.format = settings.model_format;
    options.clamps = settings.frame.wrap == "clamp";
    options.memory_bytes =
        std::uint64_t{1'000'000} * static_cast<std::uint64_t>(settings.max_memory_mb);
    options.allow_outside = settings.allow_outside;
    io::LoadTimes times;
    options.times = &times;
    TRY(scene::Scene scene, io::load(path, options, warnings));
    return LoadedModel{std::move(scene), warnings.lines(), watch.milliseconds(), times};
}

Result<LoadedModel> load_model_with_messages(const std::string& path, const Settings& settings,
                                             Jobs& jobs) {
    Result<LoadedModel> model = [&] {
        ProgressBar bar("reading " + path, settings.quiet);
        return load_model(path, settings, jobs, [&](double fraction) {
            bar.show(fraction);
            return true;
        });
    }();
    if (model) print_warnings(model->warnings, settings);
    return model;
}

void print_warnings(const std::vector<std::string>& warnings, const Settings& settings) {
    if (settings.quiet) return;
    for (const std::string& line : warnings)
        say("scanout: warning: " + line);
}

} // namespace scanout::app
