#include "app/files.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <sys/stat.h>
#include <unistd.h>

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
        return std::filesystem::weakly_canonical(std::filesystem::absolute(path), error);
    };
    return whole(a) == whole(b) && !error;
}

Result<void> check_folder(const std::string& output) {
    struct stat info {};
    if (output != "-" && ::stat(output.c_str(), &info) == 0 && S_ISDIR(info.st_mode))
        return fail(Exit::unreadable, "{}: is a folder; name a file", output);
    const std::size_t slash = output.rfind('/');
    if (slash == std::string::npos || slash == 0) return {};
    const std::string folder = output.substr(0, slash);
    if (::stat(folder.c_str(), &info) != 0)
        return fail(Exit::unreadable, "{}: cannot be written: {}: {}; make the folder first",
                    output, folder, std::strerror(errno));
    if (!S_ISDIR(info.st_mode))
        return fail(Exit::unreadable, "{}: cannot be written: {} is a file; name a folder", output,
                    folder);
    const bool device = ::stat(output.c_str(), &info) == 0 && !S_ISREG(info.st_mode);
    if (!device && ::access(folder.c_str(), W_OK) != 0) // files are written beside, and renamed
        return fail(Exit::unreadable, "{}: cannot be written: {}: {}; name another folder", output,
                    folder, std::strerror(errno));
    return {};
}

} // namespace

std::string file_name_of(const std::string& path) {
    return path.substr(path.rfind('/') + 1);
}

Result<void> check_outputs(const std::vector<std::string>& inputs,
                           const std::vector<std::string>& outputs) {
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        TRY_VOID(check_folder(outputs[i]));
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

Result<void> check_standard_output(const std::vector<std::string>& outputs) {
    if (std::count(outputs.begin(), outputs.end(), "-") > 1)
        return fail(Exit::usage, "two outputs take standard output; name a file for one of them");
    return {};
}

Result<void> check_readable(const std::string& path) {
    if (::access(path.c_str(), R_OK) == 0) return {};
    const int error = errno;
    const char* advice = error == EACCES ? "allow reading it (chmod), or use a copy"
                                         : "check the name and its folder";
    return fail(Exit::unreadable, "{}: cannot be opened: {}; {}", path, std::strerror(error),
                advice);
}

} // namespace scanout::app
