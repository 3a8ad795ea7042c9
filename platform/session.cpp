#include "platform/session.h"

#include "platform/translate.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <signal.h>
#include <sys/epoll.h>
#include <sys/resource.h>
#include <unistd.h>

namespace scanout::console {
namespace {

// Taking the console of a machine that has nothing to show on would only disturb it.
bool some_display_exists() {
    for (const char* folder : {"/dev/dri", "/dev"}) {
        std::error_code error;
        for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
             entry.increment(error)) {
            const std::string name = entry->path().filename();
            if (name.starts_with("card") && folder == std::string_view("/dev/dri")) return true;
            if (name.starts_with("fb") && name.size() > 2 && name[2] >= '0' && name[2] <= '9')
                return true;
        }
    }
    return false;
}

// Seat, displays, signals, timers and each input device take one or more; libraries among them
// crash where one is refused, and a console that is half taken would have to be given back.
constexpr int kDescriptors = 64;

// Free ones, so many; before anything is taken.
Result<void> have_descriptors() {
    rlimit limit{};
    if (::getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur < limit.rlim_max) {
        limit.rlim_cur = limit.rlim_max;
        ::setrlimit(RLIMIT_NOFILE, &limit);
    }
    std::array<Fd, kDescriptors> taken;
    for (Fd& fd : taken) {
        fd = Fd(::open("/dev/null", O_RDONLY | O_CLOEXEC));
        if (!fd.valid())
            return fail(Exit::no_display,
                        "fewer than {} more files can be open at once ({}): raise `ulimit -n`, "
                        "which is {}",
                        kDescriptors, std::strerror(errno), limit.rlim_cur);
    }
    return {};
}

} // namespace

Result<std::unique_ptr<Session>> Session::open(bool device_is_named) {
    if (!device_is_named && !some_display_exists())
        return fail(Exit::no_display, "this machine has no display (neither /dev/dri/card* nor "
                                      "/dev/fb*): --backend terminal draws in the terminal, "
                                      "`scanout render` to a file");
    TRY_VOID(have_descriptors());
    std::unique_ptr<Session> session(new Session);
    TRY(session->signals_, port::Signals::create());
    TRY(session->seat_, open_seat(session->notes_));
    session->epoll_ = Fd(::epoll_create1(EPOLL_CLOEXEC));
    if (!session->epoll_.valid()) return fail(Exit::internal, "epoll: {}", std::strerror(errno));
    session->watch(session->signals_.event_fd());
    session->watch(session->seat_->event_fd());
    return session;
}

// Inputs close their devices through the seat.
Session::~Session() {
    terminal_.reset();
    libinput_.reset();
}

void Session::watch(int fd) const {
    if (fd < 0) return;
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.fd = fd;
    ::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, fd, &event);
}

void Session::unwatch(int fd) const {
    if (fd >= 0) ::epoll_ctl(epoll_.get(), EPOLL_CTL_DEL, fd, nullptr);
}

Result<void> Session::open_input() {
    auto libinput = Libinput::open(*seat_, notes_);
    if (libinput) {
        libinput_ = std::move(*libinput);
        watch(libinput_->event_fd());
    } else {
        notes_.push_back(libinput.error().what);
    }
    TRY_VOID(route_keys());
    if (!libinput_ && !terminal_)
        return fail(Exit::no_display, "no keyboard and no mouse: {}; {}", libinput.error().what,
                    notes_.back());
    return {};
}

// Keys come from a keyboard when one can be opened, and only then is the terminal's muted: a user
// can always press Ctrl-C. Keyboards come and go.
Result<void> Session::route_keys() {
    const bool keyboard = libinput_ && libinput_->has_keyboard();
    if (routed_ && keyboard == keyboard_) return {};
    routed_ = true;
    keyboard_ = keyboard;
    seat_->set_terminal_keyboard(!keyboard);
    if (terminal_) unwatch(terminal_->event_fd());
    terminal_.reset();
    if (keyboard) return {};
    auto terminal = open_terminal();
    if (!terminal) {
        notes_.push_back(fmt::format("keys from the terminal: {}", terminal.error().what));
        return {};
    }
    terminal_ = std::move(*terminal);
    watch(terminal_->event_fd());
    return {};
}

Result<void> Session::pause(std::vector<port::Event>& events) {
    if (std::exchange(paused_, true)) return {};
    for (ConsoleInput* input : inputs())
        if (input != nullptr) TRY_VOID(input->pause(events));
    return {};
}

Result<void> Session::resume() {
    if (!std::exchange(paused_, false)) return {};
    for (ConsoleInput* input : inputs())
        if (input != nullptr) TRY_VOID(input->resume());
    return {};
}

Result<void> Session::dispatch(std::vector<port::Event>& events) {
    const std::size_t first = events.size();
    TRY_VOID(signals_.dispatch(events));
    const std::uint64_t activations = seat_->activations();
    TRY_VOID(seat_->dispatch());
    // Away and back within one dispatch: the devices were revoked all the same.
    if (!seat_->active() || seat_->activations() != activations) TRY_VOID(pause(events));
    if (seat_->active()) {
        TRY_VOID(resume());
        for (ConsoleInput* input : inputs())
            if (input != nullptr) TRY_VOID(input->dispatch(events));
        if (routed_) TRY_VOID(route_keys());
    }
    const auto switched = std::remove_if(events.begin() + static_cast<std::ptrdiff_t>(first),
                                         events.end(), [&](const port::Event& event) {
                                             const auto console = console_switch(event);
                                             if (console) (void)seat_->switch_session(*console);
                                             return console.has_value();
                                         });
    events.erase(switched, events.end());
    return {};
}

Result<void> Session::suspend(std::vector<port::Event>& events) {
    // Where the console cannot be given back, stopping would leave a dead screen: go on instead.
    if (const auto text = seat_->text(); !text) {
        notes_.push_back(text.error().what);
        return {};
    }
    TRY_VOID(pause(events));
    ::kill(::getpid(), SIGSTOP);
    // Continued here. A console that is not on the screen now comes back by the seat's own events.
    TRY_VOID(seat_->graphics());
    if (seat_->active()) TRY_VOID(resume());
    return {};
}

std::string Session::description() const {
    std::string text = seat_->description();
    for (const ConsoleInput* input : inputs())
        if (input != nullptr) text += "; " + input->description();
    return text;
}

} // namespace scanout::console
