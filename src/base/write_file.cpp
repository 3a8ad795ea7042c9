#include "base/write_file.h"

#include "base/fd.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace scanout {
namespace {

// Returns 0, or the errno of the write that failed.
int write_all(int fd, std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        const ssize_t n = ::write(fd, bytes.data(), bytes.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return errno;
        bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
    return 0;
}

tl::unexpected<Error> cannot_write(const std::string& path, int error, std::string_view elsewhere) {
    const bool full = error == ENOSPC || error == EDQUOT || error == EFBIG;
    const bool refused = error == EACCES || error == EPERM || error == EROFS || error == ELOOP;
    return fail(Exit::unreadable, "{}: cannot be written: {}{}{}", path, std::strerror(error),
                full      ? "; make room, or "
                : refused ? "; "
                          : "",
                full || refused ? elsewhere : "");
}

// The target of a symbolic link, even if it does not exist yet; other paths stay as they are. Links
// do not form a cycle here: stat() would have reported ELOOP before.
std::string behind_links(std::string path) {
    std::error_code error;
    constexpr int kMaxLinks = 40; // as Linux, path_resolution(7)
    for (int i = 0; i < kMaxLinks && std::filesystem::is_symlink(path, error); ++i) {
        const auto target = std::filesystem::read_symlink(path, error);
        if (error) break;
        path = std::filesystem::path(path).parent_path() / target; // the target alone if absolute
    }
    return path;
}

// A new file gets the mode that the user's umask gives every new file; mkstemp alone would make
// 0600.
mode_t default_mode() {
    const mode_t mask = ::umask(0);
    ::umask(mask);
    return 0666 & ~mask;
}

} // namespace

Result<void> write_file(const std::string& path, std::span<const std::uint8_t> bytes,
                        std::string_view elsewhere) {
    if (path == "-") {
        if (const int error = write_all(STDOUT_FILENO, bytes))
            return cannot_write("standard output", error, elsewhere);
        return {};
    }
    struct stat info {};
    const int missing = ::stat(path.c_str(), &info) == 0 ? 0 : errno;
    if (missing == ELOOP) return cannot_write(path, ELOOP, elsewhere);
    if (missing == 0 && !S_ISREG(info.st_mode)) {
        if (S_ISDIR(info.st_mode))
            return fail(Exit::unreadable, "{}: is a folder; name a file", path);
        TRY(const Fd device, Fd::open(path, O_WRONLY)); // /dev/null, a pipe: nothing to rename onto
        if (const int error = write_all(device.get(), bytes))
            return cannot_write(path, error, elsewhere);
        return {};
    }
    // Next to the file itself, so that a symbolic link to it stays one.
    const std::string file = behind_links(path);
    std::string temporary = file + ".XXXXXX";
    const Fd fd(::mkostemp(temporary.data(), O_CLOEXEC));
    if (!fd.valid()) return cannot_write(path, errno, elsewhere);
    int error = write_all(fd.get(), bytes);
    const mode_t mode = missing == 0 ? info.st_mode & 07777 : default_mode();
    if (error == 0 && ::fchmod(fd.get(), mode) != 0) error = errno;
    if (error == 0 && ::fsync(fd.get()) != 0) error = errno;
    if (error == 0 && ::rename(temporary.c_str(), file.c_str()) != 0) error = errno;
    if (error != 0) {
        ::unlink(temporary.c_str());
        return cannot_write(path, error, elsewhere);
    }
    return {};
}

Result<void> write_file(const std::string& path, std::string_view text,
                        std::string_view elsewhere) {
    return write_file(path,
                      std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()),
                      elsewhere);
}

} // namespace scanout
