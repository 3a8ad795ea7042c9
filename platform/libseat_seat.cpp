#include "platform/libseat_seat.h"

#include "platform/devices.h"
#include "platform/guard.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>

#include <poll.h>
#include <pthread.h>
#include <sys/mman.h>
#include <unistd.h>

extern "C" {
#include <libseat.h>
}

namespace scanout::console {
namespace {

constexpr std::chrono::milliseconds kEnableTimeout{2000};

// libseat reports its reasons through a log handler without a user pointer.
std::array<char, 256> last_message;

void on_log(libseat_log_level level, const char* format, va_list arguments) {
    if (level == LIBSEAT_LOG_LEVEL_ERROR)
        std::vsnprintf(last_message.data(), last_message.size(), format, arguments);
}

// libseat's built-in server is a fork of this process that ends with exit(): our buffered output
// would be written twice and our exit handlers would run twice. Handlers run last registered first,
// so this one, registered in the child alone, ends it before any of ours.
bool opening_seat = false;
pid_t* server = nullptr; // shared with the child, which notes its own number
void in_forked_child() {
    if (!opening_seat) return;
    if (server != nullptr) *server = ::getpid();
    std::atexit([] { ::_exit(0); });
}

pid_t* shared_number() {
    void* const page =
        ::mmap(nullptr, sizeof(pid_t), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    return page == MAP_FAILED ? nullptr : static_cast<pid_t*>(page);
}

struct CloseSeat {
    void operator()(libseat* seat) const { libseat_close_seat(seat); }
};

class LibseatSeat final : public Seat {
public:
    LibseatSeat() = default;
    LibseatSeat(const LibseatSeat&) = delete;
    LibseatSeat& operator=(const LibseatSeat&) = delete;

    ~LibseatSeat() override {
        seat_.reset();
        // The server has usually restored the state that it found; this restores the state that we
        // found.
        if (console_) console_->text();
    }

    Result<void> open() {
        static const bool handler_installed = [] {
            server = shared_number();
            ::pthread_atfork(nullptr, nullptr, in_forked_child);
            libseat_set_log_handler(on_log);
            libseat_set_log_level(LIBSEAT_LOG_LEVEL_ERROR);
            return true;
        }();
        (void)handler_installed;
        std::fflush(nullptr);
        if (server != nullptr) *server = -1;
        opening_seat = true;
        static const libseat_seat_listener listener{on_enable, on_disable};
        last_message[0] = 0;
        seat_.reset(libseat_open_seat(&listener, this));
        const int error = errno;
        opening_seat = false;
        if (!seat_) return refused(std::strerror(error));
        return wait_for_enable();
    }

    // The console is in graphics mode by now; from here on it is restored on every exit path.
    void adopt(Console console) {
        console_ = std::move(console);
        guard_.emplace(ConsoleState{console_->fd(), console_->keyboard_mode()},
                       server != nullptr ? *server : -1);
        (void)console_->graphics();
    }

    tl::expected<int, int> open_device(const std::string& path) override {
        int fd = -1;
        const int id = libseat_open_device(seat_.get(), path.c_str(), &fd);
        if (id < 0) return tl::unexpected<int>(errno);
        ids_[fd] = id;
        cards_.opened(path, fd);
        return fd;
    }
    void close_device(int fd) override {
        const auto id = ids_.find(fd);
        if (id != ids_.end()) {
            libseat_close_device(seat_.get(), id->second);
            ids_.erase(id);
        }
        cards_.closed(fd);
        ::close(fd);
    }

    int event_fd() const override { return libseat_get_fd(seat_.get()); }
    Result<void> dispatch() override {
        // libseat_dispatch() returns 0 for ever when its server is dead: only the hang-up tells.
        pollfd state{event_fd(), POLLIN, 0};
        ::poll(&state, 1, 0);
        const int result = libseat_dispatch(seat_.get(), 0);
        if ((state.revents & (POLLHUP | POLLERR)) != 0 || (result < 0 && errno != EAGAIN)) {
            set_active(false);
            return fail(Exit::no_display, "the seat server is gone: start scanout again");
        }
        return {};
    }

    Result<void> switch_session(int vt) override {
        if (libseat_switch_session(seat_.get(), vt) != 0)
            return fail(Exit::no_display, "tty{}: {}", vt, std::strerror(errno));
        return {};
    }
    void set_terminal_keyboard(bool on) override {
        keyboard_on_ = on;
        if (console_) console_->set_keyboard(on);
    }
    Result<void> text() override {
        if (!console_)
            return fail(Exit::no_display, "cannot suspend: the console belongs to the seat server");
        set_active(false);
        cards_.drop_master();
        console_->text_for_a_while();
        return {};
    }
    Result<void> graphics() override {
        TRY_VOID(console_->graphics());
        console_->set_keyboard(keyboard_on_);
        cards_.set_master();
        set_active(true);
        return {};
    }
    std::string description() const override {
        const char* name = libseat_seat_name(seat_.get());
        return console_ ? fmt::format("libseat {} on tty{}", name, console_->number())
                        : fmt::format("libseat {}", name);
    }
    bool has_console() const override { return true; }

private:
    static void on_enable(libseat*, void* self) {
        static_cast<LibseatSeat*>(self)->set_active(true);
    }
    static void on_disable(libseat* seat, void* self) {
        static_cast<LibseatSeat*>(self)->set_active(false);
        libseat_disable_seat(seat);
    }

    // An opened seat proves nothing until it is enabled: without /dev/tty0 that never comes.
    Result<void> wait_for_enable() {
        const auto deadline = std::chrono::steady_clock::now() + kEnableTimeout;
        while (!active()) {
            const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
                deadline - std::chrono::steady_clock::now());
            pollfd state{event_fd(), POLLIN, 0};
            if (left.count() <= 0) return refused("the seat was not enabled within 2 s");
            ::poll(&state, 1, static_cast<int>(left.count()));
            if ((state.revents & (POLLHUP | POLLERR)) != 0) return refused("its server ended");
            if (libseat_dispatch(seat_.get(), 0) < 0 && errno != EAGAIN)
                return refused(std::strerror(errno));
        }
        return {};
    }
    static Result<void> refused(const char* reason) {
        return fail(Exit::no_display, "seat: {}{}{}", reason, last_message[0] != 0 ? ": " : "",
                    last_message.data());
    }

    std::optional<Console> console_;
    std::optional<Guard> guard_;
    std::unique_ptr<libseat, CloseSeat> seat_;
    std::map<int, int> ids_; // descriptor -> libseat's device number
    Cards cards_;
    bool keyboard_on_ = false;
};

// The built-in server needs root; asking for it without costs two seconds and yields nothing.
Result<std::unique_ptr<LibseatSeat>> open_some_backend() {
    constexpr const char* kVariable = "LIBSEAT_BACKEND";
    auto seat = std::make_unique<LibseatSeat>();
    if (::geteuid() == 0 || std::getenv(kVariable) != nullptr) {
        TRY_VOID(seat->open());
        return seat;
    }
    Error error;
    for (const char* backend : {"seatd", "logind"}) {
        ::setenv(kVariable, backend, 1);
        auto opened = seat->open();
        ::unsetenv(kVariable);
        if (opened) return seat;
        error = std::move(opened).error();
    }
    return tl::unexpected<Error>(std::move(error));
}

} // namespace

Result<std::unique_ptr<Seat>> open_libseat(std::optional<Console>& console) {
    TRY(auto seat, open_some_backend());
    if (console) seat->adopt(*std::move(console));
    return seat;
}

} // namespace scanout::console
