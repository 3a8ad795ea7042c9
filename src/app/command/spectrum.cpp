// scanout spectrum: a picture's Fourier transform as a picture, or the picture of a band of it.
#include "app/command/commands.h"
#include "app/picture/made_picture.h"
#include "app/progress_bar.h"
#include "image/codec.h"
#include "signal/frequencies.h"

namespace scanout::app {

Result<Exit> run_spectrum(const Settings& settings) {
    TRY_VOID(check_one_picture(settings, "spectrum", "spectrum photo.png -o spectrum.png"));
    TRY_VOID(check_made(settings));
    const std::string& path = settings.arguments.front();
    TRY(const image::Image picture, image::load(path));
    TRY_VOID(check_memory("the transform of " + path,
                          signal::spectrum_bytes(picture.width(), picture.height())));
    Jobs jobs(settings.threads);
    image::Image made;
    {
        ProgressBar bar("transforming " + path, settings.quiet);
        const signal::Progress progress = [&bar](double share) { bar.show(share); };
        made = settings.keep ? signal::kept(picture, *settings.keep, jobs, progress)
                             : signal::spectrum_picture(picture, jobs, progress);
    }
    TRY_VOID(write_made(settings, made));
    return Exit::ok;
}

} // namespace scanout::app
