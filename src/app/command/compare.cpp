// scanout compare: two pictures against each other, with two numbers as tolerance, or by a figure.
#include "app/command/commands.h"
#include "app/files.h"
#include "app/message.h"
#include "app/picture/picture.h"
#include "app/report/comparison.h"
#include "app/report/report.h"
#include "image/flip.h"
#include "image/heat_map.h"

#include <sys/stat.h>

namespace scanout::app {
namespace {

// --out FOLDER or --out PREFIX; without it, the name of the first picture.
std::string prefix_of(const Settings& settings) {
    const std::string& asked = settings.difference_prefix;
    if (asked.empty()) {
        const std::string& got = settings.arguments[0];
        const std::size_t dot = got.rfind('.');
        const std::size_t slash = got.rfind('/');
        const bool extension =
            dot != std::string::npos && (slash == std::string::npos || dot > slash);
        return (extension ? got.substr(0, dot) : got) + "-";
    }
    struct stat info {};
    const bool folder = ::stat(asked.c_str(), &info) == 0 && S_ISDIR(info.st_mode);
    if (folder) return asked.ends_with('/') ? asked : asked + "/";
    const bool separated = asked.ends_with('/') || asked.ends_with('-') || asked.ends_with('.');
    return separated ? asked : asked + "-";
}

Result<std::vector<std::string>> write_difference(const Settings& settings, const image::Image& got,
                                                  const image::Image& expected) {
    const std::string prefix = prefix_of(settings);
    std::vector<std::string> written;
    TRY_VOID(check_outputs(settings.arguments,
                           {prefix + "got.png", prefix + "expected.png", prefix + "difference.png",
                            settings.json.value_or(""), settings.heat_map}));
    const auto write = [&](const char* name, const image::Image& picture) -> Result<void> {
        written.push_back(prefix + name + ".png");
        TRY(const image::Bytes bytes, image::encode_png(picture));
        return write_picture(written.back(), bytes);
    };
    TRY_VOID(write("got", got));
    TRY_VOID(write("expected", expected));
    TRY_VOID(write("difference", image::difference_image(got, expected)));
    return written;
}

Result<void> check_compare(const Settings& settings) {
    if (settings.arguments.size() != 2)
        return fail(Exit::usage,
                    "compare takes two pictures, as in `scanout compare got.png expected.png`; "
                    "{} named",
                    settings.arguments.empty()
                        ? "none was"
                        : fmt::format("{} {}", fmt::join(settings.arguments, " and "),
                                      settings.arguments.size() == 1 ? "was" : "were"));
    for (const std::string& path : settings.arguments)
        TRY_VOID(check_readable(path));
    const std::string& map = settings.heat_map;
    if (!map.empty() && map != "-" && !format_of_name(map))
        return fail(Exit::usage, "--heatmap {}: name it .png, .ppm, .pam or .raw", map);
    const std::vector<std::string> outputs = {settings.json.value_or(""), map};
    TRY_VOID(check_standard_output(outputs));
    return check_outputs(settings.arguments, outputs);
}

image::Image heat_map_of(Metric metric, const image::Image& expected, const image::Image& got) {
    std::vector<float> errors;
    switch (metric) {
    case Metric::flip:
        errors = image::flip_map(expected, got);
        break;
    case Metric::ssim:
        for (const double similarity : image::ssim_map(expected, got))
            errors.push_back(static_cast<float>(1 - similarity));
        break;
    default:
        return image::heat_map(expected, got);
    }
    return image::heat_map(got.width(), got.height(), errors);
}

Result<void> write_heat_map(const Settings& settings, const image::Image& got,
                            const image::Image& expected) {
    if (settings.heat_map.empty()) return {};
    const image::Image map = heat_map_of(settings.metric, expected, got);
    TRY(const PictureFormat format, picture_format(settings.heat_map, PictureFormat::by_name));
    TRY(const image::Bytes bytes, encode(map, format, std::nullopt));
    return write_picture(settings.heat_map, bytes);
}

// What is printed, without the names of written files.
std::string line_of(const Comparison& c, const Settings& settings, const image::Image& got,
                    const image::Image& expected, bool same) {
    const image::Difference& d = c.difference;
    if (!d.same_size)
        return fmt::format("different: sizes {}x{} and {}x{}", got.width(), got.height(),
                           expected.width(), expected.height());
    if (settings.metric != Metric::none)
        return fmt::format("{:.{}f}", c.figure(settings.metric),
                           settings.metric == Metric::max ? 0 : 6);
    return fmt::format("{}: {} of {} pixels differ, {} by more than {}; largest difference {}; "
                       "mean FLIP {:.6f}",
                       same ? "same" : "different", d.differing_pixels, got.pixels().size(),
                       d.over_tolerance, settings.max_difference, d.max_difference, c.flip);
}

} // namespace

Result<Exit> run_compare(const Settings& settings) {
    TRY_VOID(check_compare(settings));
    TRY(const image::Image got, image::load(settings.arguments[0]));
    TRY(const image::Image expected, image::load(settings.arguments[1]));
    const Comparison compared = comparison(expected, got, settings);
    const bool same = compared.same(settings), by_figure = settings.metric != Metric::none;
    std::vector<std::string> written;
    if (!same) {
        TRY(written, write_difference(settings, got, expected));
    }
    if (compared.difference.same_size) TRY_VOID(write_heat_map(settings, got, expected));
    std::string line = line_of(compared, settings, got, expected, same);
    const std::string see = same ? "" : fmt::format("; see {}", written.back());
    if (!by_figure || !compared.difference.same_size) line += see;
    const bool output_taken = settings.json == "-" || settings.heat_map == "-";
    if (!settings.quiet || by_figure) say(line, output_taken ? stderr : stdout);
    if (by_figure && !same && compared.difference.same_size)
        say(fmt::format("different: {} {} --limit {}{}", text_of(settings.metric),
                        more_is_better(settings.metric) ? "is below" : "is above", *settings.limit,
                        see));
    TRY_VOID(write_report(settings, to_json(compared, settings, written)));
    if (same) return Exit::ok;
    return compared.difference.same_size ? Exit::pixels_differ : Exit::sizes_differ;
}

} // namespace scanout::app
