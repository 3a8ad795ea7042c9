#include "platform/console.h"

#include "platform/device_calls.h"
#include "platform/devices.h"

#include <cerrno>
#include <cstddef>
#include <cstring>

#include <fcntl.h>
#include <linux/kd.h>
#include <linux/major.h>
#include <linux/vt.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/sysmacros.h>
#include <sys/un.h>
#include <unistd.h>

namespace scanout::console {
namespace {

Result<Fd> open_terminal_device(const std::string& path) {
    Fd fd(device_calls().open(path.c_str(), O_RDWR | O_NOCTTY));
    if (!fd.valid()) return fail(Exit::unreadable, "{}: {}", path, std::strerror(errno));
    return fd;
}

} // namespace

// fd: any descriptor of a terminal. Only /dev/tty1 to /dev/tty63 are virtual terminals.
Result<Console> Console::adopt(Fd fd) {
    // TIOCGDEV tells the terminal behind /dev/tty and /dev/console too.
    unsigned device = 0;
    if (control(fd.get(), TIOCGDEV, &device) != 0) device = 0;
    const int number = static_cast<int>(minor(device));
    if (major(device) != TTY_MAJOR || number < 1 || number > MAX_NR_CONSOLES)
        return fail(Exit::no_display,
                    "the terminal is not a virtual terminal (/dev/tty1 to /dev/tty63)");
    int keyboard_mode = 0;
    if (control(fd.get(), KDGKBMODE, &keyboard_mode) != 0)
        return fail(Exit::no_display, "tty{}: {}", number, std::strerror(errno));
    // Left over from a program that died: not a state to return to.
    if (keyboard_mode == K_OFF) keyboard_mode = K_UNICODE;
    return Console(std::move(fd), number, keyboard_mode);
}

Result<Console> Console::open_active() {
    TRY(const Fd any, open_terminal_device("/dev/tty0"));
    vt_stat state{};
    if (control(any.get(), VT_GETSTATE, &state) != 0)
        return fail(Exit::no_display, "/dev/tty0: {}", std::strerror(errno));
    TRY(Fd shown, open_terminal_device(fmt::format("/dev/tty{}", state.v_active)));
    return adopt(std::move(shown));
}

Result<Console> Console::open_own() {
    for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::isatty(fd) == 0) continue;
        Fd copy(::fcntl(fd, F_DUPFD_CLOEXEC, 3));
        if (auto console = adopt(std::move(copy))) return console;
    }
    TRY(Fd terminal, Fd::open("/dev/tty", O_RDWR | O_NOCTTY));
    return adopt(std::move(terminal));
}

bool Console::shown() const {
    vt_stat state{};
    return control(fd(), VT_GETSTATE, &state) == 0 && state.v_active == number_;
}

bool Console::in_graphics_mode() const {
    int mode = KD_TEXT;
    return control(fd(), KDGETMODE, &mode) == 0 && mode == KD_GRAPHICS;
}

Result<void> Console::refuse_if_drawn_on() const {
    if (!in_graphics_mode()) return {};
    const std::string card = card_with_another_master();
    if (card.empty()) return {};
    return fail(Exit::no_display,
                "tty{}: another program draws there{}: quit it, or switch to a text console "
                "(Ctrl-Alt-F3)",
                number_, held_by(card));
}

// A name in the kernel's abstract socket space: taken at once or not at all, and free again when
// every process that holds it is gone.
Result<void> Console::lock() {
    Fd lock(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string name = fmt::format("scanout-tty{}", number_);
    std::memcpy(address.sun_path + 1, name.data(), name.size());
    const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
    if (lock.valid() &&
        ::bind(lock.get(), reinterpret_cast<const sockaddr*>(&address), length) != 0 &&
        errno == EADDRINUSE)
        return fail(Exit::no_display,
                    "tty{}: another scanout runs there: quit it, or switch to another console",
                    number_);
    lock_ = std::move(lock);
    return {};
}

Result<void> Console::graphics() {
    // Remembered first: a signal between the two calls finds the way back too.
    remember_console(state());
    if (control(fd(), KDSETMODE, KD_GRAPHICS) == 0) return {};
    const int error = errno;
    forget_console();
    return fail(Exit::no_display, "tty{}: cannot enter graphics mode: {}", number_,
                std::strerror(error));
}

void Console::text() {
    forget_console();
    restore_console(state());
}

void Console::text_for_a_while() {
    forget_console();
    restore_modes(state());
}

void Console::set_keyboard(bool on) {
    control(fd(), KDSKBMODE, on ? keyboard_mode_ : K_OFF);
}

} // namespace scanout::console
