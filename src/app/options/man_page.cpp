#include "app/options/man_page.h"

#include "app/options/help.h"
#include "app/options/options.h"
#include "app/options/text.h"
#include "app/view/bindings.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout::app {
namespace {

// As roff text: a hyphen that is typed is a minus, a line must not begin as a request does.
std::string roff(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n')) out += "\\&";
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else
            out += c;
    }
    return out;
}

std::string verbatim(std::string_view text) {
    return fmt::format(".nf\n{}{}.fi\n", roff(text), text.ends_with('\n') ? "" : "\n");
}

std::string names_of(const Option& option) {
    const std::string value = value_text(option);
    std::string names = option.letter != 0 ? fmt::format("\\fB\\-{}\\fR, ", option.letter) : "";
    names += fmt::format("\\fB{}\\fR", roff(fmt::format("--{}", option.name)));
    if (value.empty()) return names;
    return names + (option.optional_value ? fmt::format("[=\\fI{}\\fR]", roff(value))
                                          : fmt::format(" \\fI{}\\fR", roff(value)));
}

std::string commands_of(const Option& option) {
    std::string commands;
    for (const NamedCommand& row : kCommands)
        if (belongs(option, row.command))
            commands += (commands.empty() ? "" : ", ") + std::string(row.name);
    return commands;
}

std::string all_options() {
    std::vector<const Option*> sorted;
    for (const Option& option : options())
        sorted.push_back(&option);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Option* a, const Option* b) { return a->group < b->group; });
    std::string text;
    const Option* last = nullptr;
    for (const Option* option : sorted) {
        if (last == nullptr || last->group != option->group)
            text += fmt::format(".SS {}\n", title_of(option->group));
        text += fmt::format(".TP\n{}\n{}. Of: {}.\n", names_of(*option), roff(help_of(*option)),
                            commands_of(*option));
        last = option;
    }
    return text;
}

constexpr std::string_view kExitCodes =
    ".TP\n0\nall is well\n"
    ".TP\n2\na mistake in the command line\n"
    ".TP\n3\na file cannot be read or written, or its format is not supported\n"
    ".TP\n4\n\\fBdoctor \\-\\-strict\\fR found hazards, or a picture of \\fBrender\n"
    "\\-\\-fail\\-if\\-empty\\fR shows nothing of its model\n"
    ".TP\n5\nno display, or no permission to use it\n"
    ".TP\n21\nthe compared pictures have different sizes\n"
    ".TP\n22\nthe compared pictures differ\n"
    ".TP\n70\na mistake in scanout, or no memory left\n";

constexpr std::string_view kFiles =
    ".TP\n\\fI~/.config/scanout/options\\fR\n"
    "options for every run: words as on the command line, a line or more; lines that begin with #\n"
    "are comments. A command leaves out those of other commands. The command line goes before it.\n"
    ".TP\n\\fI~/.config/scanout/keys.toml\\fR\n"
    "keys of the viewer: lines such as rotate_left = [\"Left\", \"A\"]; \\fBscanout list keys\\fR "
    "names\n"
    "actions and keys\n"
    ".TP\n\\fI~/.cache/scanout\\fR\n"
    "frontiers that \\fB\\-\\-budget\\fR and \\fB\\-\\-max\\-error\\fR measured\n";

constexpr std::string_view kEnvironment =
    ".TP\nSCANOUT_OPTIONS\noptions for every run, which go before the file's\n"
    ".TP\nXDG_CONFIG_HOME, XDG_CACHE_HOME\nwhere the files below stand instead of ~/.config and\n"
    "~/.cache\n";

} // namespace

std::string man_page() {
    std::string text = fmt::format(
        ".TH SCANOUT 1 \"\" \"scanout {}\" \"User Commands\"\n"
        ".SH NAME\nscanout \\- view and draw 3D models on the Linux console, by the CPU alone\n"
        ".SH SYNOPSIS\n.B scanout\n.RI [ COMMAND ]\n.RI [ OPTION ...]\n.IR FILE ...\n"
        ".SH DESCRIPTION\n",
        SCANOUT_VERSION);
    text += verbatim(help_overview());
    text += ".SH COMMANDS\n";
    for (const NamedCommand& row : kCommands)
        text += fmt::format(".SS {}\n{}", row.name, verbatim(introduction(row.command)));
    text += ".SH OPTIONS\n" + all_options();
    text += ".SH KEYS\nOf the viewer: key, action, what it does.\n" + verbatim(keys_text());
    text += fmt::format(".SH EXIT STATUS\n{}.SH ENVIRONMENT\n{}.SH FILES\n{}", kExitCodes,
                        kEnvironment, kFiles);
    return text;
}

} // namespace scanout::app
