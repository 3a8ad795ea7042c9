#include "app/same_file.h"

#include <filesystem>

#include <sys/stat.h>

namespace scanout::app {
namespace {

bool same_file(const std::string& a, const std::string& b) {
    if (a.empty() || b.empty() || a == "-" || b == "-") return false;
    struct stat first {
    }, second{};
    if (::stat(a.c_str(), &first) == 0 && ::stat(b.c_str(), &second) == 0)
        return S_ISREG(first.st_mode) && first.st_dev == second.st_dev &&
               first.st_ino == second.st_ino;
    std::error_code error;
    const auto whole = [&](const std::string& path) {
        return std::filesystem::weakly_canonical(path, error);
    };
    return whole(a) == whole(b) && !error;
}

} // namespace

Result<void> keep_apart(const std::vector<std::string>& inputs,
                        const std::vector<std::string>& outputs) {
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        for (const std::string& input : inputs)
            if (same_file(outputs[i], input))
                return fail(Exit::usage,
                            "{}: would be written over {}, which is read; name another file",
                            outputs[i], input);
        for (std::size_t j = 0; j < i; ++j)
            if (same_file(outputs[i], outputs[j]))
                return fail(Exit::usage, "{}: two outputs have this name; name another file",
                            outputs[i]);
    }
    return {};
}

} // namespace scanout::app
