#include "platform/tty/line.h"

#include "base/check.h"
#include "platform/restore.h"
#include "platform/tty/held_output.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace scanout::tty {
namespace {

// Alternate screen, no cursor, no wrapping at the last column, pasted text marked as such, the
// mouse's motion in SGR form; an empty screen.
constexpr const char* kEnter = "\x1b[?1049h\x1b[?25l\x1b[?7l\x1b[?2004h\x1b[?1003h\x1b[?1006h"
                               "\x1b[m\x1b[2J\x1b[H";
// First CAN and ST: a sequence may have been cut short.
constexpr const char* kEndOfString = "\x18\x1b\\";
constexpr const char* kLeave = "\x1b[?2026l\x1b[?1016l\x1b[?1006l\x1b[?1003l\x1b[?2004l\x1b[m"
                               "\x1b[?7h\x1b[?25h\x1b[?1049l";

// Of two descriptors of terminals: is it the same one? /dev/tty is a name for any.
bool same_terminal(int a, int b) {
    unsigned device_a = 0, device_b = 0;
    return ::ioctl(a, TIOCGDEV, &device_a) != 0 || ::ioctl(b, TIOCGDEV, &device_b) != 0 ||
           device_a == device_b;
}

} // namespace

Result<void> check_size(const WindowSize& window) {
    if (window.columns > 0 && window.rows > 0) return {};
    return fail(Exit::no_display, "--backend terminal: the terminal does not say its size: set it, "
                                  "as by `stty cols 80 rows 24`");
}

Line::Line(Line&& other) noexcept : fd_(std::move(other.fd_)), modes_(other.modes_) {
    CHECK(!other.entered_);
}

Result<Line> Line::open() {
    if (::isatty(STDOUT_FILENO) == 0)
        return fail(Exit::no_display, "--backend terminal: standard output is no terminal; by ssh, "
                                      "`ssh -t` makes it one (reports go to --json=FILE)");
    const auto tty = Fd::open("/dev/tty", O_RDWR | O_NOCTTY | O_NONBLOCK);
    if (!tty)
        return fail(Exit::no_display,
                    "--backend terminal: this process has no controlling terminal");
    if (!same_terminal(tty->get(), STDOUT_FILENO))
        return fail(Exit::no_display, "--backend terminal: standard output is another terminal "
                                      "than the one that scanout is started in: start it there");
    // Where a standard stream is closed, the number is that of the stream.
    Fd fd(::fcntl(tty->get(), F_DUPFD_CLOEXEC, STDERR_FILENO + 1));
    if (!fd.valid()) return fail(Exit::no_display, "--backend terminal: {}", std::strerror(errno));
    termios modes{};
    if (::tcgetattr(fd.get(), &modes) != 0)
        return fail(Exit::no_display, "--backend terminal: the terminal's modes: {}",
                    std::strerror(errno));
    Line line(std::move(fd), modes);
    if (!line.in_foreground())
        return fail(Exit::no_display, "--backend terminal: the terminal belongs to another job: "
                                      "start scanout in the foreground");
    if (const char* const name = std::getenv("TERM");
        name != nullptr && std::string_view(name) == "dumb")
        return fail(Exit::no_display, "--backend terminal: this terminal only prints (TERM=dumb)");
    TRY_VOID(check_size(line.size()));
    return line;
}

WindowSize Line::size() const {
    winsize size{};
    if (::ioctl(fd(), TIOCGWINSZ, &size) != 0) return {};
    return {size.ws_col, size.ws_row, size.ws_xpixel, size.ws_ypixel};
}

bool Line::in_foreground() const {
    const pid_t foreground = ::tcgetpgrp(fd());
    return foreground < 0 || foreground == ::getpgrp();
}

void Line::remember() const {
    console::remember_terminal({.fd = fd(),
                                .modes = modes_,
                                .farewell = whole_farewell_,
                                .answers = answers_,
                                .every_signal = true,
                                .afterwards = release_output});
}

void Line::set_answers(bool answers) {
    answers_ = answers;
    set_farewell(std::string(farewell_));
}

void Line::set_farewell(std::string_view text) {
    farewell_ = text;
    std::string whole = kEndOfString + farewell_ + kLeave + (answers_ ? console::kAskStatus : "");
    console::forget_terminal(); // for as short as it can be: a handler reads the text
    whole_farewell_ = std::move(whole);
    if (entered_) remember();
}

void Line::enter() {
    ::signal(SIGTTOU, SIG_IGN);                // leaving from the background must not stop us
    if (!entered_) ::tcgetattr(fd(), &modes_); // the shell may have changed them meanwhile
    entered_ = true;
    set_farewell(std::string(farewell_));
    hold_output();
    termios raw = modes_;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO | IEXTEN);
    raw.c_iflag &= ~static_cast<tcflag_t>(IXON | ICRNL | INLCR | IGNCR | ISTRIP);
    raw.c_oflag &= ~static_cast<tcflag_t>(OPOST);
    raw.c_cc[VMIN] = 1;
    raw.c_cc[VTIME] = 0;
    ::tcsetattr(fd(), TCSANOW, &raw);
    send(kEnter);
}

void Line::leave() {
    if (!entered_) return;
    entered_ = false;
    out_.clear(); // what was not written is not worth a wait
    sent_ = 0;
    console::restore_now();
}

void Line::send(std::string_view text) {
    if (!entered_) return;
    out_ += text;
    write_on();
}

void Line::write_on() {
    while (!out_.empty() && !hung_up_) {
        const ssize_t count = ::write(fd(), out_.data() + sent_, out_.size() - sent_);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0 && errno == EAGAIN) return;
        if (count < 0) hung_up_ = true;
        sent_ += count > 0 ? static_cast<std::size_t>(count) : 0;
        if (sent_ == out_.size() || hung_up_) {
            out_.clear();
            sent_ = 0;
        }
    }
}

std::string Line::read() {
    std::string all;
    std::array<char, 4096> bytes;
    while (entered_ && !hung_up_) {
        const ssize_t count = ::read(fd(), bytes.data(), bytes.size());
        if (count > 0)
            all.append(bytes.data(), static_cast<std::size_t>(count));
        else if (count < 0 && errno == EINTR)
            continue;
        else if (count < 0 && errno == EAGAIN)
            break;
        else
            hung_up_ = true;
    }
    return all;
}

} // namespace scanout::tty
