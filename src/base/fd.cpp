#include "base/fd.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <unistd.h>

namespace scanout {

Fd::~Fd() {
    if (fd_ >= 0) ::close(fd_);
}

Result<Fd> Fd::open(const std::string& path, int flags, int mode) {
    const int fd = ::open(path.c_str(), flags | O_CLOEXEC, mode);
    if (fd < 0) return fail(Exit::unreadable, "{}: {}", path, std::strerror(errno));
    return Fd(fd);
}

} // namespace scanout
