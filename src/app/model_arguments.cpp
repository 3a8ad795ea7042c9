#include "app/model_arguments.h"

#include "io/formats.h"

#include <algorithm>
#include <filesystem>

namespace scanout::app {
namespace {

bool is_model(const std::string& path) {
    const std::string extension = io::extension_of(path);
    const auto formats = io::formats();
    return std::any_of(formats.begin(), formats.end(),
                       [&](const io::Format& row) { return row.extension == extension; });
}

} // namespace

Result<std::vector<std::string>> models_of(const std::vector<std::string>& arguments) {
    std::vector<std::string> models;
    for (const std::string& argument : arguments) {
        std::error_code error;
        if (!std::filesystem::is_directory(argument, error)) {
            models.push_back(argument);
            continue;
        }
        const std::size_t before = models.size();
        std::filesystem::directory_iterator entries(argument, error), end;
        for (; !error && entries != end; entries.increment(error))
            if (!entries->is_directory(error) && is_model(entries->path().string()))
                models.push_back(entries->path().string());
        if (error)
            return fail(Exit::unreadable, "{}: cannot be listed: {}; allow reading it (chmod)",
                        argument, error.message());
        if (models.size() == before)
            return fail(
                Exit::unreadable,
                "{}: this folder holds no model that is read (`scanout list formats`); name "
                "a file",
                argument);
        std::sort(models.begin() + static_cast<std::ptrdiff_t>(before), models.end());
    }
    return models;
}

} // namespace scanout::app
