#include "app/machine.h"

#include <algorithm>
#include <ctime>
#include <fstream>

#include <fmt/format.h>
#include <sys/stat.h>

namespace scanout::app {

std::string machine_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name"))
            return line.substr(std::min(line.find(": ") + 2, line.size()));
    return "unknown processor";
}

std::string today() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    ::gmtime_r(&now, &utc);
    return fmt::format("{:04}-{:02}-{:02}", utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday);
}

// A program that was built anew has the same version and may be faster.
std::string program_identity() {
    struct stat file {};
    if (::stat("/proc/self/exe", &file) != 0) return SCANOUT_VERSION;
    return fmt::format("{} {} {}.{:09}", SCANOUT_VERSION, file.st_size, file.st_mtim.tv_sec,
                       file.st_mtim.tv_nsec);
}

} // namespace scanout::app
