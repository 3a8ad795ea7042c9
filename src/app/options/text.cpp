#include "app/options/text.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace scanout::app {

static std::string range_text(const Option& option) {
    return option.max > option.min ? fmt::format("{} to {}", option.min, option.max)
                                   : std::string();
}

std::string_view title_of(Group group) {
    constexpr std::array<std::string_view, 9> kTitles = {"Output",     "Picture",     "Camera",
                                                         "Model",      "Display",     "Speed",
                                                         "Comparison", "Examination", "General"};
    return kTitles[static_cast<std::size_t>(group)];
}

std::string value_text(const Option& option) {
    if (option.choices.empty()) return std::string(option.value);
    std::string text(option.choices);
    std::replace(text.begin(), text.end(), ' ', '|');
    return text;
}

std::string options_markdown() {
    std::string text = "| option | value | default | range | commands | what it does |\n"
                       "|---|---|---|---|---|---|\n";
    for (const Option& option : options()) {
        std::string commands;
        for (const NamedCommand& row : kCommands)
            if (belongs(option, row.command))
                commands += (commands.empty() ? "" : " ") + std::string(row.name);
        std::string value = value_text(option);
        for (std::size_t i = 0; (i = value.find('|', i)) != std::string::npos; i += 2)
            value.insert(i, 1, '\\');
        text +=
            fmt::format("| {}`--{}` | {} | {} | {} | {} | {} |\n",
                        option.letter != 0 ? fmt::format("`-{}` ", option.letter) : "", option.name,
                        value, option.default_text, range_text(option), commands, option.help);
    }
    return text;
}

} // namespace scanout::app
