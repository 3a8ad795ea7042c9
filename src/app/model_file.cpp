#include "app/model_file.h"

#include "app/files.h"
#include "app/message.h"
#include "base/stopwatch.h"
#include "io/load.h"

#include <unistd.h>

namespace scanout::app {

Result<LoadedModel> load_model(const std::string& path,
                               const std::function<bool(double)>& progress) {
    TRY_VOID(check_readable(path));
    const Stopwatch watch;
    Warnings warnings;
    io::LoadOptions options;
    options.progress = progress;
    io::LoadTimes times;
    options.times = &times;
    TRY(scene::Scene scene, io::load(path, options, warnings));
    return LoadedModel{std::move(scene), warnings.lines(), watch.milliseconds(), times};
}

Result<LoadedModel> load_model_with_messages(const std::string& path, const Settings& settings) {
    const bool talks = !settings.quiet && ::isatty(STDERR_FILENO) == 1;
    const Stopwatch watch;
    int shown = -1;
    Result<LoadedModel> model = load_model(path, [&](double share) {
        const int percent = static_cast<int>(share * 100);
        if (talks && watch.milliseconds() > 1000 && percent != shown) {
            shown = percent;
            say_over(fmt::format("reading {} {:3} %", path, percent));
        }
        return true;
    });
    if (shown >= 0) say_over("");
    if (model) print_warnings(model->warnings, settings);
    return model;
}

void print_warnings(const std::vector<std::string>& warnings, const Settings& settings) {
    if (settings.quiet) return;
    for (const std::string& line : warnings)
        say("scanout: warning: " + line);
}

} // namespace scanout::app
