#include "io/find_file.h"

#include "io/file_name.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>

#include <dirent.h>

namespace scanout::io {
namespace {

namespace fs = std::filesystem;

// std::filesystem::directory_iterator ends the program where memory runs out.
struct CloseFolder {
    void operator()(DIR* folder) const { ::closedir(folder); }
};

constexpr std::size_t kLongestPath = 4095; // PATH_MAX of Linux without its NUL

bool exists(const std::string& path) {
    std::error_code error;
    return fs::exists(path, error);
}

std::string join(const std::string& folder, std::string_view name) {
    if (folder.empty() || name.starts_with('/')) return std::string(name);
    return folder.back() == '/' ? folder + std::string(name) : folder + '/' + std::string(name);
}

std::string with_slashes(std::string_view name) {
    std::string out(name);
    std::replace(out.begin(), out.end(), '\\', '/');
    return out;
}

} // namespace

std::string folder_of(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    if (slash == std::string::npos) return "";
    return slash == 0 ? "/" : path.substr(0, slash);
}

FileFinder::FileFinder(const std::string& root) {
    std::error_code error;
    root_ = fs::absolute(root.empty() ? "." : root, error).lexically_normal().string();
    if (!root_.ends_with('/')) root_ += '/';
}

bool FileFinder::is_outside(const std::string& folder, std::string_view name) const {
    const auto leaves = [&](std::string_view spelling) {
        std::error_code error;
        const std::string path = join(folder, spelling);
        return !fs::absolute(path, error).lexically_normal().string().starts_with(root_);
    };
    return !root_.empty() && (leaves(name) || leaves(with_slashes(name)));
}

// Of several entries that differ in case alone the first in byte order is meant.
std::optional<std::string> FileFinder::entry_in_any_case(const std::string& folder,
                                                         std::string_view name) {
    if (name == "." || name == ".." || exists(join(folder, name))) return std::string(name);
    const auto [known, is_new] = folders_.try_emplace(folder);
    if (is_new) {
        const std::unique_ptr<DIR, CloseFolder> entries(
            ::opendir(folder.empty() ? "." : folder.c_str()));
        while (const dirent* const next = entries ? ::readdir(entries.get()) : nullptr) {
            const std::string entry = next->d_name;
            const auto [same, first] = known->second.try_emplace(folded(entry), entry);
            if (!first && entry < same->second) same->second = entry;
        }
    }
    const auto found = known->second.find(folded(name));
    return found == known->second.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::string> FileFinder::find(const std::string& folder, std::string_view name) {
    if (name.empty() || name.size() > kLongestPath || name.find('\0') != std::string_view::npos)
        return std::nullopt;
    if (is_outside(folder, name)) return std::nullopt;
    if (std::string path = join(folder, name); exists(path)) return path;
    const std::string slashed = with_slashes(name);
    if (slashed.front() == '/') return exists(slashed) ? std::optional(slashed) : std::nullopt;
    std::string path = folder;
    for (std::size_t begin = 0; begin < slashed.size();) {
        const std::size_t end = std::min(slashed.find('/', begin), slashed.size());
        if (end > begin) {
            const auto entry =
                entry_in_any_case(path, std::string_view(slashed).substr(begin, end - begin));
            if (!entry) return std::nullopt;
            path = join(path, *entry);
        }
        begin = end + 1;
    }
    return exists(path) ? std::optional(path) : std::nullopt;
}

std::optional<std::string> FileFinder::find_anywhere(const std::string& folder,
                                                     const std::string& other_folder,
                                                     std::string_view name) {
    for (const std::string& spelling : spellings(name)) {
        const std::string slashed = with_slashes(spelling);
        for (const std::string& wanted : {spelling, slashed.substr(slashed.rfind('/') + 1)}) {
            if (auto path = find(folder, wanted)) return path;
            if (other_folder != folder)
                if (auto path = find(other_folder, wanted)) return path;
        }
    }
    return std::nullopt;
}

} // namespace scanout::io
