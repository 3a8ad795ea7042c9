#include "platform/guard.h"

#include <array>
#include <cerrno>
#include <string>

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

namespace scanout::console {
namespace {

// Where console-guard may stand: beside the program, as in a build, or where it is installed.
std::array<std::string, 2> guard_paths() {
    std::array<char, 4096> path{};
    const ssize_t length = ::readlink("/proc/self/exe", path.data(), path.size() - 1);
    const std::string program(path.data(), length > 0 ? static_cast<std::size_t>(length) : 0);
    const std::string folder = program.substr(0, program.rfind('/') + 1);
    return {folder + "console-guard", folder + "../libexec/scanout/console-guard"};
}

// The child of a fork: it may only make system calls.
[[noreturn]] void become_guard(int pipe, const ConsoleState& state, const Watched& watched,
                               const std::array<std::string, 2>& paths,
                               const std::array<std::string, 3>& words) {
    // A signal to our group or session does not reach it. A plain user's rights on the console rest
    // on its being the session's terminal, so only root leaves the session.
    if (::geteuid() != 0 || ::setsid() < 0) ::setpgid(0, 0);
    sigset_t all;
    sigfillset(&all);
    ::sigprocmask(SIG_BLOCK, &all, nullptr);
    // Keeps only these two descriptors: an open pipe would never end, an open display would stay
    // taken.
    const int high_pipe = ::fcntl(pipe, F_DUPFD, 10), high_tty = ::fcntl(state.fd, F_DUPFD, 10);
    if (::dup2(high_pipe, 0) < 0 || ::dup2(high_tty, 1) < 0) ::_exit(1);
    ::close_range(2, ~0U, 0);
    for (const std::string& path : paths)
        ::execl(path.c_str(), "console-guard", words[0].c_str(), words[1].c_str(), words[2].c_str(),
                static_cast<char*>(nullptr));
    watch(0, {1, state.keyboard_mode}, watched);
}

} // namespace

Guard::Guard(const ConsoleState& state, pid_t server) {
    int ends[2] = {-1, -1};
    if (::pipe2(ends, O_CLOEXEC) != 0) return;
    Fd read_end(ends[0]);
    pipe_ = Fd(ends[1]);
    const Watched watched{::getpid(), server};
    const std::array<std::string, 2> paths = guard_paths();
    const std::array<std::string, 3> words{std::to_string(state.keyboard_mode),
                                           std::to_string(watched.program),
                                           std::to_string(watched.server)};
    pid_ = ::fork();
    if (pid_ == 0) become_guard(read_end.get(), state, watched, paths, words);
}

Guard::~Guard() {
    if (pid_ <= 0) return;
    const char farewell = 1;
    [[maybe_unused]] const ssize_t written = ::write(pipe_.get(), &farewell, 1);
    while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

} // namespace scanout::console
