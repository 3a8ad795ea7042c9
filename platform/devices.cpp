#include "platform/devices.h"

#include "base/fd.h"

#include <drm.h>

#include <cerrno>

#include <fcntl.h>
#include <sys/ioctl.h>

namespace scanout::console {

tl::expected<int, int> open_device_node(const std::string& path) {
    const int fd = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (fd < 0) return tl::unexpected<int>(errno);
    return fd;
}

void Cards::opened(const std::string& path, int fd) {
    if (path.starts_with("/dev/dri/")) paths_[fd] = path;
}

void Cards::set_master() const {
    for (const auto& [fd, path] : paths_)
        ::ioctl(fd, DRM_IOCTL_SET_MASTER, 0);
}

void Cards::drop_master() const {
    for (const auto& [fd, path] : paths_)
        ::ioctl(fd, DRM_IOCTL_DROP_MASTER, 0);
}

bool a_card_has_another_master() {
    for (int i = 0; i < 16; ++i) {
        const auto fd = open_device_node(fmt::format("/dev/dri/card{}", i));
        if (!fd) continue;
        const Fd card(*fd);
        // The first to open a card without a master is its master, and then this succeeds.
        if (::ioctl(card.get(), DRM_IOCTL_SET_MASTER, 0) != 0) return true;
    }
    return false;
}

} // namespace scanout::console
