// scanout colour: one colour in every model, or a picture's channels in one.
#include "app/command/commands.h"
#include "app/message.h"
#include "app/options/colour_value.h"
#include "app/picture/made_picture.h"
#include "app/picture/picture.h"
#include "app/progress_bar.h"
#include "image/codec.h"
#include "image/colour_models.h"

#include <algorithm>

namespace scanout::app {
namespace {

// The three beside each other.
image::Image beside(const std::array<image::Image, 3>& channels) {
    const int width = channels[0].width();
    image::Image out(3 * width, channels[0].height());
    for (std::size_t i = 0; i < channels.size(); ++i)
        for (int y = 0; y < out.height(); ++y)
            std::copy(channels[i].row(y).begin(), channels[i].row(y).end(),
                      out.row(y).begin() + static_cast<std::ptrdiff_t>(i) * width);
    return out;
}

Result<void> write_channels(const Settings& settings) {
    TRY_VOID(check_one_picture(settings, "colour --channels",
                               "colour photo.png --channels lab -o lab.png"));
    TRY_VOID(check_made(settings));
    TRY(const image::Image picture, image::load(settings.arguments.front()));
    const image::ColourModel& model = *image::find_colour_model(settings.channels);
    Jobs jobs(settings.threads);
    std::array<image::Image, 3> channels;
    {
        ProgressBar bar("converting " + settings.arguments.front(), settings.quiet);
        channels =
            image::channels_of(picture, model, jobs, [&bar](double share) { bar.show(share); });
    }
    if (!has_number(settings.output)) return write_made(settings, beside(channels));
    for (std::size_t i = 0; i < channels.size(); ++i) {
        Settings one = settings;
        one.output = numbered(settings.output, settings, static_cast<int>(i));
        TRY_VOID(check_made(one));
        TRY_VOID(write_made(one, channels[i]));
    }
    return {};
}

Result<void> print_colour(const Settings& settings) {
    if (!settings.output.empty())
        return fail(Exit::usage, "which channels go to {}? say --channels, one of {}",
                    settings.output, image::kColourModelNames);
    if (settings.arguments.size() != 1)
        return fail(Exit::usage,
                    "name one colour, as in `scanout colour '#ff8000'` or `scanout colour "
                    "hsv:30,1,1`");
    TRY(const DVec3 rgb, parse_colour_value(settings.arguments.front()));
    for (const std::string& line : colour_lines(rgb))
        say(line, stdout);
    return {};
}

} // namespace

Result<Exit> run_colour(const Settings& settings) {
    TRY_VOID(settings.channels.empty() ? print_colour(settings) : write_channels(settings));
    return Exit::ok;
}

} // namespace scanout::app
