// scanout synthesise: a texture of any size that looks like a sample.
#include "app/command/commands.h"
#include "app/picture/made_picture.h"
#include "app/progress_bar.h"
#include "image/codec.h"

namespace scanout::app {
namespace {

Result<signal::Synthesis> wanted(const Settings& settings, const image::Image& sample) {
    const int most = signal::greatest_window(sample);
    signal::Synthesis how = settings.synthesis;
    how.seed = static_cast<std::uint64_t>(settings.seed);
    if (most < signal::kLeastWindow)
        return fail(
            Exit::usage, "{}: {}x{} pixels are too few for a sample; take {} a side at least",
            settings.arguments.front(), sample.width(), sample.height(), signal::kLeastWindow);
    if (how.window == 0) how.window = signal::default_window(sample, how.by);
    if (how.window > most)
        return fail(Exit::usage, "--window {}: {} has room for {} pixels at most", how.window,
                    settings.arguments.front(), most);
    if (how.by == signal::SynthesisBy::pixel && how.window % 2 == 0)
        return fail(Exit::usage, "--window {}: has a pixel in its middle; take {} or {}",
                    how.window, how.window - 1, how.window + 1);
    if (!settings.made_size) {
        how.width = 2 * sample.width();
        how.height = 2 * sample.height();
    } else {
        how.width = settings.made_size->first;
        how.height = settings.made_size->second;
    }
    return how;
}

} // namespace

Result<Exit> run_synthesise(const Settings& settings) {
    TRY_VOID(check_one_picture(settings, "synthesise", "synthesise bark.png -o more.png"));
    TRY_VOID(check_made(settings));
    const std::string& path = settings.arguments.front();
    TRY(const image::Image sample, image::load(path));
    TRY(const signal::Synthesis how, wanted(settings, sample));
    Jobs jobs(settings.threads);
    image::Image made;
    {
        ProgressBar bar("synthesising from " + path, settings.quiet);
        made = signal::synthesised(sample, how, jobs, [&bar](double share) { bar.show(share); });
    }
    TRY_VOID(write_made(settings, made));
    return Exit::ok;
}

} // namespace scanout::app
