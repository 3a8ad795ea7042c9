#include "app/keys/keys_file.h"

#include "app/message.h"
#include "app/options/standing_options.h"
#include "app/picture/nearest.h"
#include "base/mapping.h"

#include <algorithm>
#include <utility>

#include <unistd.h>

namespace scanout::app {
namespace {

// A string of TOML, basic or literal, off the front of the text.
Result<std::string> take_string(std::string_view& text) {
    const char quote = text.empty() ? '\0' : text[0];
    if (quote != '"' && quote != '\'')
        return fail(Exit::usage, "a key stands in quotes, as in rotate_left = \"A\"");
    std::string value;
    for (std::size_t i = 1; i < text.size(); ++i) {
        if (text[i] == quote) {
            text = trimmed(text.substr(i + 1));
            return value;
        }
        if (quote == '"' && text[i] == '\\' && i + 1 < text.size()) ++i; // \" and double backslash
        value += text[i];
    }
    return fail(Exit::usage, "a quote is not closed");
}

// "A", or ["A", "B"]; a comment may follow.
Result<std::vector<std::string>> parse_value(std::string_view text) {
    std::vector<std::string> keys;
    const bool list = text.starts_with('[');
    if (list) text = trimmed(text.substr(1));
    while (!list || !text.starts_with(']')) {
        TRY(std::string key, take_string(text));
        keys.push_back(std::move(key));
        if (!list) break;
        if (text.starts_with(','))
            text = trimmed(text.substr(1));
        else if (!text.starts_with(']'))
            return fail(Exit::usage, "a list of keys ends with ], in the same line");
    }
    if (list) text = trimmed(text.substr(1));
    if (!text.empty() && text[0] != '#') return fail(Exit::usage, "'{}' is too much", text);
    return keys;
}

std::string action_names() {
    std::string names;
    for (const ActionRow& row : action_rows())
        if (!row.keys.empty()) names += (names.empty() ? "" : " ") + std::string(row.name);
    return names;
}

// An error: the second half of a line.
Result<void> take_line(std::string_view line, KeyMap& map) {
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos)
        return fail(Exit::usage, "an action and its keys are wanted, as in rotate_left = \"A\"");
    const std::string_view name = trimmed(line.substr(0, equals));
    const ActionRow* const row = find_action(name);
    if (row == nullptr || row->keys.empty()) { // a hand or a recording does these
        std::vector<std::string_view> names;
        for (const ActionRow& known : action_rows())
            names.push_back(known.name);
        return fail(Exit::usage, "there is no action '{}'{}; there are: {}", name,
                    did_you_mean(name, names), action_names());
    }
    TRY(const std::vector<std::string> keys, parse_value(trimmed(line.substr(equals + 1))));
    if (const std::optional<std::string> wrong = map.bind(row->id, keys))
        return fail(Exit::usage,
                    "there is no key '{}'; keys are spelt as in `scanout list keys`: A, "
                    "Shift+F3, Ctrl+Left, PageUp, KP4",
                    *wrong);
    return {};
}

Result<void> take_file(const std::string& path, UserKeys& keys) {
    TRY(const Mapping file, Mapping::open(path));
    for (std::string& line : take_keys(file.text(), path, keys.map))
        keys.faults.push_back(std::move(line));
    return {};
}

} // namespace

std::vector<std::string> take_keys(std::string_view text, const std::string& name, KeyMap& map) {
    std::vector<std::string> faults;
    for (int number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.empty() || line[0] == '#' || line == "[keys]") continue;
        if (const Result<void> taken = take_line(line, map); !taken)
            faults.push_back(
                fmt::format("{}:{}: {}; its default stays", name, number, taken.error().what));
    }
    return faults;
}

Result<UserKeys> user_keys(const Settings& settings) {
    UserKeys keys{KeyMap::of(settings.nav), {}};
    const std::string own = settings.no_config ? std::string() : standing_keys_file();
    if (!own.empty() && ::access(own.c_str(), F_OK) == 0) TRY_VOID(take_file(own, keys));
    if (!settings.keys.empty()) TRY_VOID(take_file(settings.keys, keys));
    return keys;
}

} // namespace scanout::app
