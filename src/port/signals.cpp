#include "port/signals.h"

#include <cerrno>
#include <cstring>

#include <signal.h>
#include <sys/signalfd.h>
#include <unistd.h>

namespace scanout::port {

Result<Signals> Signals::create() {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP})
        sigaddset(&set, signal);
    if (::pthread_sigmask(SIG_BLOCK, &set, nullptr) != 0)
        return fail(Exit::internal, "signals cannot be blocked");
    Fd fd(::signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK));
    if (!fd.valid()) return fail(Exit::internal, "signalfd: {}", std::strerror(errno));
    return Signals(std::move(fd));
}

Result<void> Signals::dispatch(std::vector<Event>& events) {
    signalfd_siginfo info{};
    while (::read(fd_.get(), &info, sizeof info) == sizeof info) {
        Event event;
        event.kind = info.ssi_signo == SIGTSTP ? EventKind::suspend : EventKind::quit;
        events.push_back(event);
    }
    return {};
}

} // namespace scanout::port
