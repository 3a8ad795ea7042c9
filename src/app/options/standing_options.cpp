#include "app/options/standing_options.h"

#include "app/options/conflicts.h"
#include "app/options/names.h"
#include "app/options/text.h"
#include "base/mapping.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <utility>

#include <unistd.h>

namespace scanout::app {
namespace {

constexpr unsigned kAnyCommand = ~0U;

struct StandingOption {
    const Option* option;
    std::string text, source;
    std::size_t place;
};

// The words of a place, as options with their values.
Result<void> take_options(const StandingPlace& words, std::size_t place, Command command,
                          std::vector<StandingOption>& out) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        const auto& [word, source] = words[i];
        if (!word.starts_with('-') || word == "-" || word == "--")
            return fail(Exit::usage,
                        "{}: '{}' is no option; name files and commands on the command line",
                        source, word);
        const std::size_t equals = std::min(word.find('='), word.size());
        const std::string name = word.substr(0, equals);
        const Option* option = find_option(name, static_cast<unsigned>(command));
        if (option == nullptr) option = find_option(name, kAnyCommand);
        if (option == nullptr)
            return fail(Exit::usage, "{}: there is no option {}{}", source, name,
                        hint_for_option(name, kAnyCommand));
        std::string text = equals < word.size() ? word.substr(equals + 1) : "";
        const bool is_switch = std::holds_alternative<Switch>(option->slot);
        if (is_switch && equals < word.size())
            return fail(Exit::usage, "{}: {} takes no value; write {} alone", source, name, name);
        if (takes_next_word(*option) && equals == word.size()) {
            if (++i == words.size())
                return fail(Exit::usage, "{}: {} wants {}; give it", source, name,
                            value_text(*option));
            text = words[i].text;
        }
        if (belongs(*option, command)) out.push_back({option, text, source, place});
    }
    return {};
}

// Appends a line's words.
Result<void> take_words(std::string_view text, const std::string& source, StandingPlace& place) {
    const Result<std::vector<std::string>> words = split_words(text);
    if (!words) return fail(Exit::usage, "{}: {}", source, words.error().what);
    for (const std::string& word : *words)
        place.push_back({word, source});
    return {};
}

Result<StandingPlace> read_options_file(const std::string& path) {
    StandingPlace place;
    if (path.empty() || ::access(path.c_str(), F_OK) != 0) return place;
    TRY(const Mapping file, Mapping::open(path));
    std::string_view text = file.text();
    for (int line = 1; !text.empty(); ++line) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view content = text.substr(0, end);
        const std::size_t start = content.find_first_not_of(" \t\r");
        if (start != std::string_view::npos && content[start] != '#')
            TRY_VOID(take_words(content, fmt::format("{}:{}", path, line), place));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return place;
}

} // namespace

static std::string in_config_folder(const std::string& name) {
    const auto from = [](const char* variable, const std::string& below) {
        const char* const folder = std::getenv(variable);
        return folder != nullptr && folder[0] == '/' ? folder + below : std::string();
    };
    const std::string path = from("XDG_CONFIG_HOME", "/scanout/" + name);
    return path.empty() ? from("HOME", "/.config/scanout/" + name) : path;
}

std::string standing_options_file() {
    return in_config_folder("options");
}

std::string standing_keys_file() {
    return in_config_folder("keys.toml");
}

Result<std::vector<std::string>> split_words(std::string_view text) {
    std::vector<std::string> words;
    std::optional<std::string> word;
    char quote = 0;
    for (const char c : text) {
        const bool blank = c == ' ' || c == '\t' || c == '\n' || c == '\r';
        if (quote != 0) {
            if (c == quote)
                quote = 0;
            else
                *word += c;
        } else if (blank) {
            if (word) words.push_back(*std::exchange(word, std::nullopt));
        } else {
            if (!word) word.emplace();
            if (c == '"' || c == '\'')
                quote = c;
            else
                *word += c;
        }
    }
    if (quote != 0) return fail(Exit::usage, "a quote {} is not closed; close it", quote);
    if (word) words.push_back(*word);
    return words;
}

Result<std::vector<StandingPlace>> read_standing_options() {
    std::vector<StandingPlace> places;
    TRY(StandingPlace file, read_options_file(standing_options_file()));
    places.push_back(std::move(file));
    StandingPlace variable;
    if (const char* const text = std::getenv("SCANOUT_OPTIONS"); text != nullptr)
        TRY_VOID(take_words(text, "SCANOUT_OPTIONS", variable));
    places.push_back(std::move(variable));
    return places;
}

Result<void> apply_standing(std::span<const StandingPlace> places,
                            const std::set<std::string_view>& given, Settings& settings) {
    std::vector<StandingOption> all;
    for (std::size_t i = 0; i < places.size(); ++i)
        TRY_VOID(take_options(places[i], i, settings.command, all));
    for (const StandingOption& one : all) {
        // A shift belongs to the camera that stands with it.
        const std::string_view excluded = one.option->name == "shift" ? "camera" : one.option->name;
        const auto excludes_one = [&](std::string_view name) {
            return name == one.option->name || exclude_each_other(name, excluded);
        };
        if (std::any_of(given.begin(), given.end(), excludes_one) ||
            std::any_of(all.begin(), all.end(), [&](const StandingOption& other) {
                return other.place > one.place && excludes_one(other.option->name);
            }))
            continue;
        const Result<void> applied = apply(*one.option, one.text, settings);
        if (!applied) return fail(applied.error().exit, "{}: {}", one.source, applied.error().what);
    }
    return {};
}

} // namespace scanout::app
