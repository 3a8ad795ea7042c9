#include "app/options/completions.h"

#include "app/command/commands.h"
#include "app/options/help.h"
#include "app/options/names.h"
#include "app/options/options.h"
#include "frame/catalogue.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout::app {
namespace {

// The words that an option takes, with spaces between them; empty: not a set of words.
std::string words_of(const Option& option) {
    if (!option.choices.empty()) return std::string(option.choices);
    if (!std::holds_alternative<Asked>(option.slot)) return "";
    std::string axis(option.name);
    std::replace(axis.begin(), axis.end(), '-', '_');
    return fmt::format("auto {}", fmt::join(frame::names_on(axis), " "));
}

bool takes_file(const Option& option) {
    return option.value == "FILE" || option.value == "OUT.obj" || option.value == "PREFIX";
}

// What follows the dash in the first line of the command's introduction.
std::string_view summary_of(Command command) {
    const std::string_view text = introduction(command);
    const std::string_view line = text.substr(0, text.find('\n'));
    return line.substr(line.rfind(" - ") + 3);
}

std::string command_names(char between) {
    std::string names;
    for (const NamedCommand& row : kCommands)
        names += (names.empty() ? "" : std::string(1, between)) + std::string(row.name);
    return names;
}

// Up to the first colon or semicolon: without marks that a shell's tables give a meaning.
std::string brief(std::string_view help) {
    std::string text(help.substr(0, std::min(help.find_first_of(";:["), help.size())));
    text.erase(std::remove_if(text.begin(), text.end(),
                              [](char c) { return c == '\'' || c == '`' || c == ']'; }),
               text.end());
    return text;
}

std::string bash_options(Command command) {
    std::string words = "--help --help-all";
    for (const Option& option : options())
        if (belongs(option, command)) words += fmt::format(" --{}", option.name);
    return words;
}

// As a value of the table _scanout_values: words, @files, or @none for any other value.
std::string bash_value(const Option& option) {
    if (const std::string words = words_of(option); !words.empty()) return words;
    return takes_file(option) ? "@files" : "@none";
}

std::string zsh_option(const Option& option) {
    const std::string help = brief(option.help);
    const std::string words = words_of(option);
    const std::string value = std::holds_alternative<Switch>(option.slot) ? ""
                              : !words.empty()     ? fmt::format(":value:({})", words)
                              : takes_file(option) ? fmt::format(":{}:_files", option.value)
                                                   : fmt::format(":{}: ", brief(option.value));
    const std::string_view repeats = option.repeats ? "*" : "";
    const std::string_view glue = option.optional_value ? "=-" : "";
    const std::string end = option.optional_value ? "::FILE:_files" : value;
    std::string lines =
        fmt::format("            '{}--{}{}[{}]{}' \\\n", repeats, option.name, glue, help, end);
    if (option.letter != 0)
        lines += fmt::format("            '-{}[{}]{}' \\\n", option.letter, help, end);
    return lines;
}

std::string fish_option(const Option& option) {
    std::string commands;
    for (const NamedCommand& row : kCommands)
        if (belongs(option, row.command)) commands += fmt::format(" {}", row.name);
    const std::string words = words_of(option);
    const std::string value = std::holds_alternative<Switch>(option.slot) || option.optional_value
                                  ? ""
                              : !words.empty()     ? fmt::format(" -x -a '{}'", words)
                              : takes_file(option) ? " -r -F"
                                                   : " -x";
    return fmt::format("complete -c scanout -n '__scanout_is{}' -l {}{}{} -d '{}'\n", commands,
                       option.name, option.letter != 0 ? fmt::format(" -s {}", option.letter) : "",
                       value, brief(option.help));
}

} // namespace

std::string bash_completions() {
    std::string text = "# bash completions of scanout\ndeclare -gA _scanout_options=(\n";
    for (const NamedCommand& row : kCommands)
        text += fmt::format("    [{}]='{}'\n", row.name, bash_options(row.command));
    text += ")\ndeclare -gA _scanout_values=(\n";
    for (const NamedCommand& row : kCommands)
        for (const Option& option : options()) {
            if (!belongs(option, row.command) || !takes_next_word(option)) continue;
            const std::string value = bash_value(option);
            text += fmt::format("    ['{} --{}']='{}'\n", row.name, option.name, value);
            if (option.letter != 0)
                text += fmt::format("    ['{} -{}']='{}'\n", row.name, option.letter, value);
        }
    text += ")\n";
    text +=
        fmt::format("_scanout() {{\n"
                    "    local word=${{COMP_WORDS[COMP_CWORD]}} command=view\n"
                    "    local previous=${{COMP_WORDS[COMP_CWORD - 1]}} words=@files\n"
                    "    if ((COMP_CWORD > 1)); then\n"
                    "        case ${{COMP_WORDS[1]}} in {}) command=${{COMP_WORDS[1]}} ;; esac\n"
                    "    fi\n",
                    command_names('|'));
    text += "    if [[ $word == = ]]; then # bash takes it for a word of its own\n"
            "        word=\n"
            "    elif [[ $previous == = ]]; then\n"
            "        previous=${COMP_WORDS[COMP_CWORD - 2]}\n"
            "    fi\n"
            "    if [[ -n ${_scanout_values[$command $previous]-} ]]; then\n"
            "        words=${_scanout_values[$command $previous]}\n"
            "    elif [[ $word == -* ]]; then\n"
            "        words=${_scanout_options[$command]}\n";
    text += fmt::format("    elif [[ $command == list ]]; then\n        words='{}'\n"
                        "    elif [[ $command == generate ]]; then\n        words='{}'\n    fi\n",
                        list_topics(), generated_words());
    text += "    COMPREPLY=()\n"
            "    case $words in\n"
            "    @files) mapfile -t COMPREPLY < <(compgen -f -- \"$word\") ;;\n"
            "    @none) ;;\n"
            "    *) mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\") ;;\n"
            "    esac\n";
    text += fmt::format("    if ((COMP_CWORD == 1)) && [[ $words == @files ]]; then\n"
                        "        local commands\n"
                        "        mapfile -t commands < <(compgen -W '{}' -- \"$word\")\n"
                        "        COMPREPLY=(\"${{commands[@]}}\" \"${{COMPREPLY[@]}}\")\n"
                        "    fi\n}}\n"
                        "complete -o filenames -F _scanout scanout\n",
                        command_names(' '));
    return text;
}

std::string zsh_completions() {
    std::string text = "#compdef scanout\n# zsh completions of scanout\n_scanout() {\n"
                       "    local command=view\n    local -a commands=(\n";
    for (const NamedCommand& row : kCommands)
        text += fmt::format("        '{}:{}'\n", row.name, brief(summary_of(row.command)));
    text += fmt::format("    )\n"
                        "    if ((CURRENT == 2)) && [[ $words[2] != -* ]]; then\n"
                        "        _describe command commands\n        _files\n        return\n"
                        "    fi\n"
                        "    case $words[2] in\n"
                        "    ({})\n        command=$words[2]\n        shift words\n"
                        "        ((CURRENT--)) ;;\n    esac\n    case $command in\n",
                        command_names('|'));
    for (const NamedCommand& row : kCommands) {
        text += fmt::format("    ({})\n        _arguments \\\n", row.name);
        for (const Option& option : options())
            if (belongs(option, row.command)) text += zsh_option(option);
        text += "            '(- *)'{-h,--help}'[explain]' \\\n"
                "            '(- *)--help-all[explain all options]' \\\n";
        const std::string files =
            row.command == Command::list       ? fmt::format("what:({})", list_topics())
            : row.command == Command::generate ? fmt::format("what:({})", generated_words())
                                               : "file:_files";
        text += fmt::format("            '*:{}' ;;\n", files);
    }
    return text + "    esac\n}\n_scanout \"$@\"\n";
}

std::string fish_completions() {
    std::string text = fmt::format("# fish completions of scanout\n"
                                   "function __scanout_is\n"
                                   "    set -l words (commandline -opc)\n"
                                   "    set -l command view\n"
                                   "    if set -q words[2]; and contains -- $words[2] {}\n"
                                   "        set command $words[2]\n"
                                   "    end\n"
                                   "    contains -- $command $argv\n"
                                   "end\n",
                                   command_names(' '));
    for (const NamedCommand& row : kCommands)
        text += fmt::format("complete -c scanout -n 'test (count (commandline -opc)) -eq 1' -a {} "
                            "-d '{}'\n",
                            row.name, brief(summary_of(row.command)));
    for (const Option& option : options())
        text += fish_option(option);
    text += "complete -c scanout -s h -l help -d 'explain'\n"
            "complete -c scanout -l help-all -d 'explain all options'\n";
    return text + fmt::format("complete -c scanout -n '__scanout_is list' -f -a '{}'\n"
                              "complete -c scanout -n '__scanout_is generate' -f -a '{}'\n",
                              list_topics(), generated_words());
}

} // namespace scanout::app
