// scanout generate WHAT: the manual page and completions for shells, made of the same tables that
// the program runs by.
#include "app/commands.h"
#include "app/completions.h"
#include "app/man_page.h"
#include "app/nearest.h"
#include "base/write_file.h"

#include <algorithm>
#include <array>

namespace scanout::app {
namespace {

struct Document {
    std::string_view name;
    std::string (*text)();
};
constexpr std::array kDocuments = {Document{"man", man_page}, Document{"bash", bash_completions},
                                   Document{"zsh", zsh_completions},
                                   Document{"fish", fish_completions}};

std::vector<std::string_view> document_names() {
    std::vector<std::string_view> names;
    names.reserve(kDocuments.size());
    for (const Document& document : kDocuments)
        names.push_back(document.name);
    return names;
}

} // namespace

std::string generated_documents() {
    return fmt::format("{}", fmt::join(document_names(), " "));
}

Result<Exit> run_generate(const Settings& settings) {
    const std::vector<std::string_view> names = document_names();
    if (settings.arguments.size() != 1)
        return fail(Exit::usage, "generate what? one of {}", fmt::join(names, " "));
    const std::string& asked = settings.arguments.front();
    const auto* const found =
        std::find_if(kDocuments.begin(), kDocuments.end(),
                     [&](const Document& document) { return document.name == asked; });
    if (found == kDocuments.end())
        return fail(Exit::usage, "generate cannot make '{}'{}; it makes {}", asked,
                    did_you_mean(asked, names), fmt::join(names, " "));
    TRY_VOID(write_file("-", found->text()));
    return Exit::ok;
}

} // namespace scanout::app
