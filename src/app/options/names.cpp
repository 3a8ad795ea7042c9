#include "app/options/names.h"

#include "app/picture/nearest.h"

#include <vector>

namespace scanout::app {

const Option* find_option(std::string_view word, unsigned commands) {
    for (const Option& option : options())
        if ((option.commands & commands) != 0 &&
            ((word.size() == 2 && word[0] == '-' && option.letter != 0 &&
              word[1] == option.letter) ||
             (word.starts_with("--") && word.substr(2) == option.name)))
            return &option;
    return nullptr;
}

bool takes_next_word(const Option& option) {
    return !option.optional_value && !std::holds_alternative<Switch>(option.slot);
}

std::string hint_for_option(std::string_view word, unsigned commands) {
    std::vector<std::string> spelt;
    for (const Option& option : options())
        if ((option.commands & commands) != 0) spelt.push_back("--" + std::string(option.name));
    const std::vector<std::string_view> names(spelt.begin(), spelt.end());
    const std::string hint = did_you_mean(word, names);
    return hint.empty() ? "; see --help-all" : hint;
}

} // namespace scanout::app
