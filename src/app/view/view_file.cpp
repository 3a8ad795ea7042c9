#include "app/view/view_file.h"

#include "base/mapping.h"
#include "base/write_file.h"
#include "image/codec.h"

#include <algorithm>
#include <span>

namespace scanout::app {
namespace {

constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";
constexpr std::string_view kHead =
    "# A view of scanout: `--like FILE` draws it, `view --state FILE` goes on "
    "with it.\n";

// Of `scanout render MODEL OPTIONS -o FILE` the options.
std::vector<std::string> options_of_command(std::vector<std::string> words) {
    const auto first = std::find_if(words.begin(), words.end(),
                                    [](const std::string& word) { return word.starts_with("--"); });
    words.erase(words.begin(), first);
    const auto output = std::find(words.begin(), words.end(), "-o");
    if (output != words.end()) words.erase(output, std::min(output + 2, words.end()));
    return words;
}

} // namespace

Result<StandingPlace> read_view(const std::string& path) {
    TRY(const Mapping file, Mapping::open(path));
    const std::string_view bytes = file.text();
    const bool is_png = bytes.starts_with(kPngSignature);
    std::string text;
    if (is_png) {
        TRY(text, image::png_description(
                      {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, path));
        if (!text.starts_with("scanout "))
            return fail(Exit::unreadable, "{}: holds no view; a screenshot of the viewer (S) does",
                        path);
    } else {
        if (!bytes.starts_with("# A view of scanout"))
            return fail(Exit::unreadable,
                        "{}: is no view: neither a screenshot of the viewer nor written by --state",
                        path);
        text = bytes.substr(std::min(bytes.find('\n'), bytes.size()));
    }
    const Result<std::vector<std::string>> words = split_words(text);
    if (!words) return fail(Exit::unreadable, "{}: {}", path, words.error().what);
    StandingPlace place;
    for (const std::string& word : is_png ? options_of_command(*words) : *words)
        place.push_back({word, path});
    return place;
}

Result<void> write_view(const std::string& path, const std::string& options) {
    return write_file(path, std::string(kHead) + options + "\n");
}

} // namespace scanout::app
