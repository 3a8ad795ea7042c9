// scanout compare: two pictures against each other, with two numbers as tolerance.
#include "app/commands.h"
#include "app/files.h"
#include "app/message.h"
#include "app/picture.h"
#include "app/report.h"
#include "image/compare.h"
#include "image/flip.h"

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
    TRY_VOID(check_outputs(settings.arguments, {prefix + "got.png", prefix + "expected.png",
                                                prefix + "difference.png"}));
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

} // namespace

Result<Exit> run_compare(const Settings& settings) {
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
    TRY(const image::Image got, image::load(settings.arguments[0]));
    TRY(const image::Image expected, image::load(settings.arguments[1]));
    const image::Difference difference = image::compare(got, expected, settings.max_difference);
    const bool same = difference.same_size && difference.over_tolerance <= settings.max_pixels;
    const float flip = difference.same_size ? image::mean_flip(expected, got) : 0.0F;

    std::vector<std::string> written;
    if (!same) {
        TRY(written, write_difference(settings, got, expected));
    }
    std::string line =
        difference.same_size
            ? fmt::format("{}: {} of {} pixels differ, {} by more than {}; largest difference "
                          "{}; mean FLIP {:.6f}",
                          same ? "same" : "different", difference.differing_pixels,
                          got.pixels().size(), difference.over_tolerance, settings.max_difference,
                          difference.max_difference, flip)
            : fmt::format("different: sizes {}x{} and {}x{}", got.width(), got.height(),
                          expected.width(), expected.height());
    if (!same) line += fmt::format("; see {}", written.back());
    if (!settings.quiet) say(line, settings.json == "-" ? stderr : stdout);
    TRY_VOID(write_report(settings, to_json(difference, flip, settings, written)));
    if (same) return Exit::ok;
    return difference.same_size ? Exit::pixels_differ : Exit::sizes_differ;
}

} // namespace scanout::app
