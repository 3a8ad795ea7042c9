// scanout generate WHAT: pictures and models by a formula; the manual page and completions for
// shells, made of the same tables that the program runs by.
#include "app/command/commands.h"
#include "app/files.h"
#include "app/model_file.h"
#include "app/options/completions.h"
#include "app/options/man_page.h"
#include "app/picture/made_picture.h"
#include "app/picture/nearest.h"
#include "app/picture/picture.h"
#include "app/progress_bar.h"
#include "base/write_file.h"
#include "formula/formula.h"
#include "io/obj/write_obj.h"

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

std::vector<std::string_view> generated_names() {
    std::vector<std::string_view> names;
    for (const formula::Formula& formula : formula::formulas())
        names.push_back(formula.name);
    for (const Document& document : kDocuments)
        names.push_back(document.name);
    return names;
}

bool is_model(const Settings& settings) {
    return settings.output.ends_with(".obj") && settings.picture_format == PictureFormat::by_name;
}

void warn_of_options_without_use(const formula::Formula& formula, const Settings& settings) {
    std::vector<std::string> warnings;
    if (!formula.seeded && is_given(settings, "seed"))
        warnings.push_back(
            fmt::format("--seed changes nothing: {} has no chance in it", formula.name));
    if (is_model(settings) && !formula.height_field && is_given(settings, "size"))
        warnings.push_back(fmt::format("--size changes nothing in a model of {}; --detail N does, "
                                       "{}",
                                       formula.name, formula.detail));
    print_warnings(warnings, settings);
}

Result<formula::Wanted> wanted(const formula::Formula& formula, const Settings& settings) {
    formula::Wanted w;
    const bool model = is_model(settings);
    if (model) w.width = w.height = 257;
    if (settings.made_size) {
        w.width = settings.made_size->first;
        w.height = settings.made_size->second;
    }
    w.detail = settings.detail.value_or(model ? formula.of_model : formula.of_picture);
    if (w.detail < formula.least || w.detail > formula.most)
        return fail(Exit::usage, "--detail of {} is {} to {} {}, not {}", formula.name,
                    formula.least, formula.most, formula.detail, w.detail);
    if (model && formula.height_field && (w.width < 2 || w.height < 2))
        return fail(Exit::usage, "--size {}x{}: a surface has 2x2 vertices at least", w.width,
                    w.height);
    w.seed = static_cast<std::uint64_t>(settings.seed);
    return w;
}

// About: of text, and of what it is made of.
constexpr std::int64_t kBytesPerVertex = 700, kBytesPerPixel = 24;

Result<Exit> make(const formula::Formula& formula, const Settings& settings) {
    if (settings.output.empty())
        return fail(Exit::usage, "where should {} go? say -o FILE.png, or -o FILE.obj for a model",
                    formula.name);
    const bool model = is_model(settings);
    if (model)
        TRY_VOID(check_outputs({}, {settings.output}));
    else
        TRY_VOID(check_made(settings));
    TRY(const formula::Wanted w, wanted(formula, settings));
    warn_of_options_without_use(formula, settings);
    TRY_VOID(check_memory(std::string(formula.name),
                          model ? vertices_of(formula, w) * kBytesPerVertex
                                : std::int64_t{w.width} * w.height * kBytesPerPixel));
    Jobs jobs(settings.threads);
    ProgressBar bar(fmt::format("making {}", formula.name), settings.quiet);
    const formula::Progress progress = [&bar](double share) { bar.show(share); };
    if (!model) {
        TRY_VOID(write_made(settings, formula.picture(w, jobs, progress)));
        return Exit::ok;
    }
    const std::string text = io::obj_text(formula.model(w, jobs, progress), {}, {});
    TRY_VOID(write_picture(settings.output, image::Bytes(text.begin(), text.end())));
    return Exit::ok;
}

} // namespace

std::string generated_words() {
    return fmt::format("{}", fmt::join(generated_names(), " "));
}

Result<Exit> run_generate(const Settings& settings) {
    const std::vector<std::string_view> names = generated_names();
    if (settings.arguments.size() != 1)
        return fail(Exit::usage, "generate what? one of {}", fmt::join(names, " "));
    const std::string& asked = settings.arguments.front();
    if (const formula::Formula* const formula = formula::find_formula(asked))
        return make(*formula, settings);
    const auto* const found =
        std::find_if(kDocuments.begin(), kDocuments.end(),
                     [&](const Document& document) { return document.name == asked; });
    if (found == kDocuments.end())
        return fail(Exit::usage, "generate cannot make '{}'{}; it makes {}", asked,
                    did_you_mean(asked, names), fmt::join(names, " "));
    TRY_VOID(write_file(settings.output.empty() ? "-" : settings.output, found->text()));
    return Exit::ok;
}

} // namespace scanout::app
