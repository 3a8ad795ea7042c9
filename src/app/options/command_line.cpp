#include "app/options/command_line.h"

#include "app/options/conflicts.h"
#include "app/options/help.h"
#include "app/options/names.h"
#include "app/options/options.h"
#include "app/options/text.h"
#include "app/picture/nearest.h"
#include "app/view/view_file.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <deque>
#include <map>
#include <set>
#include <utility>

#include <unistd.h>

namespace scanout::app {
namespace {

bool exists(const std::string& path) {
    return ::access(path.c_str(), F_OK) == 0;
}

// The first word is a command, or a model to view. A word that is neither a file nor could be one
// (no dot, no slash) is a misspelt command.
Result<Command> take_command(std::vector<std::string>& arguments) {
    const std::string& first = arguments.front();
    for (const NamedCommand& known : kCommands)
        if (known.name == first) {
            arguments.erase(arguments.begin());
            return known.command;
        }
    if (first.starts_with('-') || first.find_first_of("./") != std::string::npos || exists(first))
        return Command::view;
    std::vector<std::string_view> names;
    names.reserve(kCommands.size());
    for (const NamedCommand& known : kCommands)
        names.push_back(known.name);
    const std::string hint = did_you_mean(first, names);
    return fail(Exit::usage, "there is no command and no file '{}'{}", first,
                hint.empty() ? "; `scanout --help` lists the commands" : hint);
}

bool is_help(const std::string& word) {
    return word == "--help" || word == "-h" || word == "--help-all";
}

// `--json out.json` means --json=out.json, but `--json model.obj` must not write over the model.
void join_json(std::vector<std::string>& arguments) {
    for (std::size_t i = 0; i + 1 < arguments.size(); ++i) {
        if (arguments[i] != "--json" || !arguments[i + 1].ends_with(".json")) continue;
        arguments[i] += "=" + arguments[i + 1];
        arguments.erase(arguments.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    }
}

Result<void> no_name() {
    return fail(Exit::usage, "an empty word stands where a file is named; is a variable empty?");
}

// Splits `-o=x.png` into `-o x.png` (nobody wants a file named "=x.png"). Removes and returns the
// words behind `--`, which are files even if they look like options. Refuses options without their
// value, and switches with one.
Result<std::vector<std::string>> take_files(std::vector<std::string>& arguments, Command command) {
    const auto commands = static_cast<unsigned>(command);
    for (auto word = arguments.begin(); word != arguments.end(); ++word) {
        if (*word == "--") {
            std::vector<std::string> files(word + 1, arguments.end());
            arguments.erase(word, arguments.end());
            return files;
        }
        const Option* letter = find_option(word->substr(0, 2), commands);
        if (letter != nullptr && takes_next_word(*letter) && word->substr(2, 1) == "=") {
            const std::string value = word->substr(3);
            word->resize(2);
            word = arguments.insert(word + 1, value);
            continue;
        }
        const Option* option = find_option(*word, commands);
        if (option != nullptr && takes_next_word(*option)) {
            if (++word == arguments.end()) // else its value, even if that looks like an option
                return fail(Exit::usage, "{} wants {}; give it", arguments.back(),
                            value_text(*option));
            continue;
        }
        const std::string name = word->substr(0, word->find('='));
        option = find_option(name, commands);
        if (name != *word && option != nullptr && std::holds_alternative<Switch>(option->slot))
            return fail(Exit::usage, "{} takes no value; write {} alone", name, name);
    }
    return std::vector<std::string>();
}

struct Given {
    const Option* option;
    const CLI::Option* parsed = nullptr; // of one with a value
    std::vector<std::string>
        texts; // as often as it was given; unless it repeats, the last one counts
};

void declare(CLI::App& parser, Given& given) {
    const Option& option = *given.option;
    const std::string names = (option.letter != 0 ? fmt::format("-{},", option.letter) : "") +
                              fmt::format("--{}", option.name);
    if (!takes_next_word(option)) {
        // A flag's value may only be glued on: --json=FILE. CLI11 gives "true" for none.
        CLI::Option* flag = parser.add_flag(names, given.texts);
        if (!option.optional_value) flag->disable_flag_override();
        return;
    }
    given.parsed = parser.add_option(names, given.texts)
                       ->expected(1)
                       ->allow_extra_args(false)
                       ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

Result<void> unknown_option(const std::string& word, Command command) {
    const std::string name = word.substr(0, word.find('='));
    std::vector<std::string_view> takers; // commands that have it
    for (const NamedCommand& row : kCommands)
        if (find_option(name, static_cast<unsigned>(row.command)) != nullptr)
            takers.push_back(row.name);
    if (!takers.empty())
        return fail(Exit::usage,
                    "{} is for {}, not for this command; leave it out, or see "
                    "--help-all",
                    name, fmt::join(takers, " and "));
    if (exists(word))
        return fail(Exit::usage, "there is no option {}; write the file as -- {} or ./{}", word,
                    word, word);
    return fail(Exit::usage, "there is no option {}{}", name,
                hint_for_option(name, static_cast<unsigned>(command)));
}

// Of an option that was given several times, the last one counts: that may surprise.
void note_repetition(const Given& given, std::vector<std::string>& notes) {
    const bool differ = std::any_of(given.texts.begin(), given.texts.end(),
                                    [&](const auto& text) { return text != given.texts.back(); });
    if (differ && !given.option->repeats)
        notes.push_back(fmt::format("--{} is given {} times; {} counts, which is the last",
                                    given.option->name, given.texts.size(), given.texts.back()));
}

// Until 0.2 these names had the meanings of each other.
void note_depth_test(Settings& settings) {
    const std::string& test = settings.frame.depth_test;
    const bool is_nearest = test == "less" || test == "less_equal";
    if (!is_nearest && test != "greater" && test != "greater_equal") return;
    settings.notes.push_back(fmt::format(
        "--depth-test {} shows the {} now, as OpenGL and Direct3D name it; it was the other way "
        "round: {} shows the {}",
        test, is_nearest ? "nearest" : "farthest", is_nearest ? "greater" : "less",
        is_nearest ? "farthest" : "nearest"));
}

// The options of the view that a file holds; a state that is not there yet has none.
Result<void> add_view(const std::string& path, bool may_be_missing,
                      std::vector<StandingPlace>& standing) {
    if (may_be_missing && !exists(path)) return {};
    TRY(StandingPlace view, read_view(path));
    standing.push_back(std::move(view));
    return {};
}

// The options whose order counts, as the command line has them.
Result<void> apply_in_order(const std::deque<Given>& given, const std::vector<CLI::Option*>& order,
                            Settings& settings) {
    std::map<const CLI::Option*, std::size_t> applied; // so many of its texts
    for (const CLI::Option* parsed : order)
        for (const Given& one : given)
            if (one.parsed == parsed && one.option->in_order)
                TRY_VOID(apply(*one.option, one.texts[applied[parsed]++], settings));
    return {};
}

Result<Settings> parse_words(Command command, std::vector<std::string> words,
                             const std::vector<std::string>& files,
                             const ReadStanding& read_standing) {
    Settings settings;
    settings.command = command;
    CLI::App parser;
    parser.set_help_flag("");
    parser.allow_extras();
    std::deque<Given> given; // CLI11 keeps references into it
    for (const Option& option : options())
        if (belongs(option, command))
            declare(parser, given.emplace_back(Given{&option, nullptr, {}}));
    parser.add_option("arguments", settings.arguments);
    std::reverse(words.begin(), words.end()); // CLI11 takes them from the back
    try {
        parser.parse(words);
    } catch (const CLI::ParseError& error) {
        return fail(Exit::usage, "{}; see --help", error.what());
    }
    for (const std::string& extra : parser.remaining())
        if (extra.size() > 1 && extra.starts_with('-')) TRY_VOID(unknown_option(extra, command));
    settings.arguments.insert(settings.arguments.end(), files.begin(), files.end());
    if (std::count(settings.arguments.begin(), settings.arguments.end(), "") > 0)
        TRY_VOID(no_name());
    std::set<std::string_view> names;
    for (const Given& one : given)
        if (!one.texts.empty()) names.insert(one.option->name);
    std::vector<StandingPlace> standing;
    if (read_standing && names.count("no-config") == 0) {
        TRY(standing, read_standing());
    }
    for (const Given& one : given)
        if (!one.texts.empty() && (one.option->name == "like" || one.option->name == "state"))
            TRY_VOID(add_view(one.texts.back(), one.option->name == "state", standing));
    TRY_VOID(apply_standing(standing, names, settings));
    for (const Given& one : given) {
        if (one.texts.empty() || one.option->in_order) continue;
        note_repetition(one, settings.notes);
        const bool bare = one.option->optional_value && one.texts.back() == "true";
        const std::size_t first = one.option->repeats ? 0 : one.texts.size() - 1;
        for (std::size_t i = first; i < one.texts.size(); ++i)
            TRY_VOID(apply(*one.option, bare ? "" : one.texts[i], settings));
    }
    TRY_VOID(apply_in_order(given, parser.parse_order(), settings));
    note_depth_test(settings);
    TRY_VOID(check_together(settings));
    for (std::string& note : without_effect(settings, names))
        settings.notes.push_back(std::move(note));
    return settings;
}

} // namespace

Result<CommandLine> parse_command_line(std::vector<std::string> arguments,
                                       const ReadStanding& read_standing) {
    if (arguments.empty())
        return fail(Exit::usage, "name a model to show, as in `scanout models/spot/spot.obj`; "
                                 "`scanout --help` explains");
    const std::string first = arguments.front();
    if (first.empty()) return tl::unexpected(no_name().error());
    if (first == "--version" || first == "-V" || first == "version")
        return CommandLine{{}, fmt::format("scanout {}\n", SCANOUT_VERSION)};
    const bool asks_first = first == "help" || is_help(first);
    if (asks_first) arguments.erase(arguments.begin());
    if (asks_first && arguments.empty()) return CommandLine{{}, help_overview()};
    TRY(const Command command, take_command(arguments));
    TRY(const std::vector<std::string> files, take_files(arguments, command));
    const bool all =
        first == "--help-all" || std::count(arguments.begin(), arguments.end(), "--help-all") > 0;
    if (asks_first || std::any_of(arguments.begin(), arguments.end(), is_help))
        return CommandLine{{}, all ? full_help_for(command) : help_for(command)};
    join_json(arguments);
    TRY(Settings settings, parse_words(command, std::move(arguments), files, read_standing));
    return CommandLine{std::move(settings), {}};
}

} // namespace scanout::app
