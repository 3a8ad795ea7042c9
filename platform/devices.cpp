#include "platform/devices.h"

#include "base/fd.h"
#include "platform/device_calls.h"

#include <drm.h>

#include <cerrno>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <unistd.h>

namespace scanout::console {
namespace {

// This process or a child of it.
bool is_ours(const std::string& process) {
    const std::string self = std::to_string(::getpid());
    if (process == self) return true;
    std::ifstream status("/proc/" + process + "/status");
    for (std::string word; status >> word;)
        if (word == "PPid:") return status >> word && word == self;
    return false;
}

} // namespace

tl::expected<int, int> open_device_node(const std::string& path) {
    const int fd = device_calls().open(path.c_str(), O_RDWR | O_NONBLOCK | O_NOCTTY);
    if (fd < 0) return tl::unexpected<int>(errno);
    return fd;
}

void Cards::opened(const std::string& path, int fd) {
    if (path.starts_with("/dev/dri/")) paths_[fd] = path;
}

void Cards::set_master() const {
    for (const auto& [fd, path] : paths_)
        control(fd, DRM_IOCTL_SET_MASTER, 0);
}

void Cards::drop_master() const {
    for (const auto& [fd, path] : paths_)
        control(fd, DRM_IOCTL_DROP_MASTER, 0);
}

bool has_another_master(const std::string& card) {
    const auto opened = open_device_node(card);
    if (!opened) return false;
    const Fd fd(*opened);
    // The first to open a card without a master is its master, and then this succeeds.
    return control(fd.get(), DRM_IOCTL_SET_MASTER, 0) != 0;
}

std::string card_with_another_master() {
    for (int i = 0; i < 16; ++i) {
        std::string card = fmt::format("/dev/dri/card{}", i);
        if (has_another_master(card)) return card;
    }
    return {};
}

std::string held_by(const std::string& path) {
    namespace fs = std::filesystem;
    std::string holders;
    std::error_code error, none;
    for (fs::directory_iterator process("/proc", error), end; !error && process != end;
         process.increment(error)) {
        const std::string number = process->path().filename();
        if (number.find_first_not_of("0123456789") != std::string::npos || is_ours(number))
            continue;
        std::error_code hidden;
        for (fs::directory_iterator fd(process->path() / "fd", hidden), last; !hidden && fd != last;
             fd.increment(hidden)) {
            if (fs::read_symlink(fd->path(), none) != path) continue;
            std::string name;
            std::getline(std::ifstream(process->path() / "comm"), name);
            holders += fmt::format("{}{}, process {}", holders.empty() ? "" : "; ", name, number);
            break;
        }
    }
    return holders.empty() ? "" : fmt::format(" ({})", holders);
}

} // namespace scanout::console
