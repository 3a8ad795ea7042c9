#include "app/frontier/cache.h"

#include "base/mapping.h"
#include "base/write_file.h"
#include "frame/catalogue.h"
#include "image/hash.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace scanout::app {
namespace {

constexpr std::string_view kInPart = "in part ";
constexpr std::string_view kFilePrefix = "frontier-",
                           kElsewhere = "set XDG_CACHE_HOME to a folder that can be written",
                           kFormat = "scanout-frontier 2\n";

std::string hash_of(std::string_view text) {
    image::Hasher hasher;
    hasher.add(std::as_bytes(std::span(text)));
    return image::hash_text(hasher.hash());
}

// What stands in front of the next space or line end, without it.
std::string_view next_word(std::string_view& line) {
    const std::size_t end = std::min(line.find(' '), line.size());
    const std::string_view word = line.substr(0, end);
    line.remove_prefix(std::min(end + 1, line.size()));
    return word;
}
std::string_view take_line(std::string_view& text) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return line;
}

// A number that can be measured.
std::optional<double> take_number(std::string_view& line) {
    const std::string_view word = next_word(line);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value) ||
        value < 0)
        return std::nullopt;
    return value;
}

// "aa=samples_4", as src/techniques.h has it now.
std::optional<measure::Rung> rung_of(std::string_view word) {
    const std::size_t equals = word.find('=');
    if (equals == std::string_view::npos) return std::nullopt;
    const std::string_view axis = word.substr(0, equals), name = word.substr(equals + 1);
    for (const Technique* t : frame::techniques())
        if (t->axis == axis && t->name == name && t->kind == Kind::rung)
            return measure::Rung{t->axis, t->name};
    return std::nullopt;
}

// "12.1 20.3 0.8 aa=samples_4 texture=trilinear": wall and CPU milliseconds, codes, rungs.
std::optional<measure::KnownPoint> point_of(std::string_view line) {
    const std::optional<double> wall_ms = take_number(line), cpu_ms = take_number(line),
                                codes = take_number(line);
    if (!wall_ms || !cpu_ms || !codes) return std::nullopt;
    measure::KnownPoint point{{}, *wall_ms, *cpu_ms, *codes};
    while (!line.empty()) {
        const std::optional<measure::Rung> rung = rung_of(next_word(line));
        if (!rung) return std::nullopt;
        point.rungs.push_back(*rung);
    }
    return point;
}

} // namespace

std::string to_text(const std::string& key, const measure::KnownFrontier& known) {
    std::string text =
        fmt::format("{}{}measured {}{}\n", kFormat, key, known.complete ? "" : kInPart, known.date);
    for (const measure::KnownPoint& p : known.points) {
        text += fmt::format("point {} {} {}", p.wall_ms, p.cpu_ms, p.error);
        for (const measure::Rung& rung : p.rungs)
            text += fmt::format(" {}={}", rung.axis, rung.technique);
        text += '\n';
    }
    return text + fmt::format("hash {}\n", hash_of(text));
}

std::optional<measure::KnownFrontier> parse_frontier(std::string_view text,
                                                     const std::string& key) {
    const std::size_t end = text.rfind("hash ");
    if (end == std::string_view::npos ||
        text.substr(end) != fmt::format("hash {}\n", hash_of(text.substr(0, end))))
        return std::nullopt;
    text = text.substr(0, end);
    if (!text.starts_with(kFormat) || !text.substr(kFormat.size()).starts_with(key))
        return std::nullopt;
    text.remove_prefix(kFormat.size() + key.size());
    std::string_view measured = take_line(text);
    if (next_word(measured) != "measured") return std::nullopt;
    const bool complete = !measured.starts_with(kInPart);
    if (!complete) measured.remove_prefix(kInPart.size());
    measure::KnownFrontier known{std::string(measured), {}, complete};
    while (!text.empty()) {
        std::string_view line = take_line(text);
        if (next_word(line) != "point") return std::nullopt;
        const std::optional<measure::KnownPoint> point = point_of(line);
        if (!point) return std::nullopt;
        known.points.push_back(*point);
    }
    return known.points.empty() ? std::nullopt : std::optional(std::move(known));
}

Result<FrontierCache> FrontierCache::of_user() {
    const auto absolute = [](const char* name) {
        const char* const value = std::getenv(name);
        return std::string(value != nullptr && value[0] == '/' ? value : "");
    };
    if (const std::string caches = absolute("XDG_CACHE_HOME"); !caches.empty())
        return FrontierCache(caches + "/scanout");
    if (const std::string home = absolute("HOME"); !home.empty())
        return FrontierCache(home + "/.cache/scanout");
    return fail(Exit::unreadable, "neither XDG_CACHE_HOME nor HOME names a folder");
}

std::string FrontierCache::file_of(const std::string& key) const {
    return fmt::format("{}/{}{}", folder_, kFilePrefix, hash_of(key));
}

std::optional<measure::KnownFrontier> FrontierCache::find(const std::string& key) const {
    constexpr std::uint64_t kLargest = 1 << 20; // bytes; ours have about 2000
    const auto file =
        Mapping::open(file_of(key), [](std::string_view, std::uint64_t size) -> Result<> {
            if (size <= kLargest) return {};
            return fail(Exit::unreadable, "too large");
        });
    if (!file) return std::nullopt;
    return parse_frontier(file->text(), key);
}

Result<void> FrontierCache::keep(const std::string& key,
                                 const measure::KnownFrontier& known) const {
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error)
        return fail(Exit::unreadable, "{}: cannot be made: {}; {}", folder_, error.message(),
                    kElsewhere);
    // Anything else would be written into; a pipe without a reader blocks whoever opens it.
    const std::string file = file_of(key);
    const std::filesystem::file_status there = std::filesystem::status(file, error);
    if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there))
        return fail(Exit::unreadable, "{}: stands in the cache and is no regular file; remove it",
                    file);
    TRY_VOID(write_file(file, to_text(key, known), kElsewhere));
    remove_old_files();
    return {};
}

// Whatever cannot be read or removed stays.
void FrontierCache::remove_old_files() const {
    namespace fs = std::filesystem;
    struct File {
        fs::file_time_type written;
        fs::path path;
    };
    std::vector<File> files;
    std::error_code error;
    for (fs::directory_iterator at(folder_, error); !error && at != fs::directory_iterator();
         at.increment(error)) {
        if (!at->path().filename().string().starts_with(kFilePrefix)) continue;
        std::error_code unknown;
        if (!at->is_regular_file(unknown)) continue;
        const fs::file_time_type written = at->last_write_time(unknown);
        if (!unknown) files.push_back({written, at->path()});
    }
    if (files.size() <= kMostFiles) return;
    std::sort(files.begin(), files.end(),
              [](const File& a, const File& b) { return a.written > b.written; });
    for (std::size_t i = kMostFiles; i < files.size(); ++i)
        fs::remove(files[i].path, error);
}

} // namespace scanout::app
