// A file descriptor that closes itself.
#pragma once

#include "base/result.h"

#include <string>

namespace scanout {

class Fd {
public:
    Fd() = default;
    explicit Fd(int fd) : fd_(fd) {}
    Fd(Fd&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    Fd& operator=(Fd&& other) noexcept {
        std::swap(fd_, other.fd_);
        return *this;
    }
    Fd(const Fd&) = delete;
    Fd& operator=(const Fd&) = delete;
    ~Fd();

    // open(2) with O_CLOEXEC added. The error names the path and the reason, with Exit::unreadable.
    static Result<Fd> open(const std::string& path, int flags, int mode = 0);

    int get() const { return fd_; }
    bool valid() const { return fd_ >= 0; }

private:
    int fd_ = -1;
};

} // namespace scanout
