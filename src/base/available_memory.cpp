#include "base/available_memory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>

#include <sys/resource.h>

namespace scanout {
namespace {

constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

// The number behind the word `key`, or the file's first word if the key is empty. "max" is no
// number: no limit.
std::optional<std::uint64_t> number_in(const std::string& path, const std::string& key = {}) {
    std::ifstream file(path);
    std::uint64_t value = 0;
    for (std::string word; key.empty() || file >> word;)
        if (key.empty() || word == key) return file >> value ? std::optional(value) : std::nullopt;
    return std::nullopt;
}

std::uint64_t difference(std::uint64_t a, std::uint64_t b) {
    return a > b ? a - b : 0;
}

// The names of a group's files, in both versions (kernel documentation, admin-guide/cgroup-v2 and
// cgroup-v1/memory).
struct Names {
    const char *limit, *usage, *cache;
};
constexpr Names kVersion1{"memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"};
constexpr Names kVersion2{"memory.max", "memory.current", "inactive_file"};

std::uint64_t left_in_group(const std::string& folder, const Names& names) {
    const auto limit = number_in(folder + "/" + names.limit);
    const auto usage = number_in(folder + "/" + names.usage);
    if (!limit || !usage) return kUnlimited;
    const std::uint64_t cache = number_in(folder + "/memory.stat", names.cache).value_or(0);
    return difference(*limit, difference(*usage, cache));
}

// The least of a group and the groups around it. In a container the path may be the host's, of
// which only the root exists: missing folders limit nothing.
std::uint64_t left_in_groups(const std::string& root, std::string path, const Names& names) {
    std::uint64_t left = left_in_group(root, names);
    for (; path.size() > 1; path.resize(path.rfind('/')))
        left = std::min(left, left_in_group(root + path, names));
    return left;
}

// Lines are "number:controllers:path", for version 2 "0::path".
std::uint64_t left_in_all_groups(const std::string& proc, const std::string& cgroups) {
    std::uint64_t left = kUnlimited;
    std::ifstream file(proc + "/self/cgroup");
    for (std::string line; std::getline(file, line);) {
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos || line.substr(second + 1, 1) != "/") continue;
        const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
        const std::string path = line.substr(second + 1);
        if (controllers == ",,")
            left = std::min(left, left_in_groups(cgroups, path, kVersion2));
        else if (controllers.find(",memory,") != std::string::npos)
            left = std::min(left, left_in_groups(cgroups + "/memory", path, kVersion1));
    }
    return left;
}

std::uint64_t left_of_address_space(const std::string& proc) {
    rlimit limit{};
    if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnlimited;
    const std::uint64_t taken = number_in(proc + "/self/status", "VmSize:").value_or(0) * 1024;
    return difference(limit.rlim_cur, taken);
}

} // namespace

std::uint64_t available_bytes(const std::string& proc, const std::string& cgroups) {
    const auto machine = number_in(proc + "/meminfo", "MemAvailable:");
    return std::min({machine ? *machine * 1024 : kUnlimited, left_in_all_groups(proc, cgroups),
                     left_of_address_space(proc)});
}

} // namespace scanout
