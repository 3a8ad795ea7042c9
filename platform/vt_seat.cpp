#include "platform/vt_seat.h"

#include "platform/device_calls.h"
#include "platform/devices.h"
#include "platform/guard.h"

#include <cerrno>
#include <cstring>

#include <linux/vt.h>
#include <signal.h>
#include <sys/signalfd.h>
#include <unistd.h>

namespace scanout::console {
namespace {

// The kernel asks for the VT and announces its return by signals of our choice; these two are free
// of other meanings, and doubled ones do no harm: they are read as events, never handled.
int release_signal() {
    return SIGRTMIN + 4;
}
int acquire_signal() {
    return SIGRTMIN + 5;
}

class VtSeat final : public Seat {
public:
    VtSeat(Console console, Fd signals)
        : console_(std::move(console)), signals_(std::move(signals)),
          guard_({console_.fd(), console_.keyboard_mode()}) {}
    VtSeat(const VtSeat&) = delete;
    VtSeat& operator=(const VtSeat&) = delete;
    ~VtSeat() override { console_.text(); }

    Result<void> graphics() override {
        TRY_VOID(console_.graphics());
        vt_mode mode{};
        mode.mode = VT_PROCESS;
        mode.relsig = static_cast<short>(release_signal());
        mode.acqsig = static_cast<short>(acquire_signal());
        if (control(console_.fd(), VT_SETMODE, &mode) != 0)
            return fail(Exit::no_display, "tty{}: cannot follow its switching: {}",
                        console_.number(), std::strerror(errno));
        console_.set_keyboard(keyboard_on_);
        if (console_.shown()) acquire();
        return {};
    }

    Result<void> text() override {
        release();
        console_.text();
        return {};
    }

    tl::expected<int, int> open_device(const std::string& path) override {
        auto fd = open_device_node(path);
        if (fd) cards_.opened(path, *fd);
        return fd;
    }
    void close_device(int fd) override {
        cards_.closed(fd);
        ::close(fd);
    }

    int event_fd() const override { return signals_.get(); }
    Result<void> dispatch() override {
        signalfd_siginfo info{};
        while (::read(signals_.get(), &info, sizeof info) == sizeof info) {
            if (static_cast<int>(info.ssi_signo) == release_signal()) {
                release();
                control(console_.fd(), VT_RELDISP, 1);
            } else {
                control(console_.fd(), VT_RELDISP, VT_ACKACQ);
                acquire();
            }
        }
        return {};
    }

    Result<void> switch_session(int vt) override {
        if (control(console_.fd(), VT_ACTIVATE, vt) != 0)
            return fail(Exit::no_display, "tty{}: {}", vt, std::strerror(errno));
        return {};
    }
    void set_terminal_keyboard(bool on) override {
        keyboard_on_ = on;
        console_.set_keyboard(on);
    }
    std::string description() const override { return fmt::format("tty{}", console_.number()); }
    bool has_console() const override { return true; }

private:
    void release() {
        set_active(false);
        cards_.drop_master();
    }
    void acquire() {
        cards_.set_master();
        set_active(true);
    }

    Console console_;
    Fd signals_;
    Cards cards_;
    Guard guard_;
    bool keyboard_on_ = true;
};

} // namespace

Result<std::unique_ptr<Seat>> open_vt_seat(Console& console) {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, release_signal());
    sigaddset(&set, acquire_signal());
    ::pthread_sigmask(SIG_BLOCK, &set, nullptr);
    Fd signals(::signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK));
    if (!signals.valid()) return fail(Exit::internal, "signalfd: {}", std::strerror(errno));
    // Tried before the console is taken from the caller: without the rights nothing changes.
    TRY_VOID(console.graphics());
    auto seat = std::make_unique<VtSeat>(std::move(console), std::move(signals));
    TRY_VOID(seat->graphics());
    return seat;
}

} // namespace scanout::console
