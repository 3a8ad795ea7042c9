#include "platform/terminal.h"

#include "base/fd.h"
#include "platform/restore.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <span>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>
#include <xkbcommon/xkbcommon-keysyms.h>

namespace scanout::console {
namespace {

struct Sequence {
    std::string_view text; // after ESC [ or ESC O
    std::uint32_t keysym;
};
constexpr std::array kSequences = std::to_array<Sequence>({
    {"A", XKB_KEY_Up},      {"B", XKB_KEY_Down}, {"C", XKB_KEY_Right},    {"D", XKB_KEY_Left},
    {"H", XKB_KEY_Home},    {"F", XKB_KEY_End},  {"1~", XKB_KEY_Home},    {"2~", XKB_KEY_Insert},
    {"3~", XKB_KEY_Delete}, {"4~", XKB_KEY_End}, {"5~", XKB_KEY_Page_Up}, {"6~", XKB_KEY_Page_Down},
    {"[A", XKB_KEY_F1},     {"[B", XKB_KEY_F2},  {"[C", XKB_KEY_F3},      {"[D", XKB_KEY_F4},
    {"[E", XKB_KEY_F5},     {"P", XKB_KEY_F1},   {"Q", XKB_KEY_F2},       {"R", XKB_KEY_F3},
    {"S", XKB_KEY_F4},      {"15~", XKB_KEY_F5}, {"17~", XKB_KEY_F6},     {"18~", XKB_KEY_F7},
    {"19~", XKB_KEY_F8},    {"20~", XKB_KEY_F9}, {"21~", XKB_KEY_F10},    {"23~", XKB_KEY_F11},
    {"24~", XKB_KEY_F12},
});

struct Modifiers {
    bool shift = false, control = false, alt = false;
};

void add_key(std::vector<port::Event>& events, std::uint32_t keysym, std::uint32_t base,
             Modifiers held) {
    port::Event event;
    event.kind = port::EventKind::key;
    event.keysym = keysym;
    event.base_keysym = base;
    event.shift = held.shift;
    event.control = held.control;
    event.alt = held.alt;
    for (const bool pressed : {true, false}) {
        event.pressed = pressed;
        events.push_back(event);
    }
}

void add_character(std::vector<port::Event>& events, unsigned char c, bool alt) {
    if (c == '\r' || c == '\n')
        return add_key(events, XKB_KEY_Return, XKB_KEY_Return, {.alt = alt});
    if (c == '\t') return add_key(events, XKB_KEY_Tab, XKB_KEY_Tab, {.alt = alt});
    if (c == 0x7f || c == '\b')
        return add_key(events, XKB_KEY_BackSpace, XKB_KEY_BackSpace, {.alt = alt});
    if (c >= 1 && c <= 26) {
        const std::uint32_t letter = 'a' + c - 1U;
        return add_key(events, letter, letter, {.control = true, .alt = alt});
    }
    if (c < 0x20 || c > 0x7e) return;
    const bool upper = c >= 'A' && c <= 'Z';
    add_key(events, c, upper ? c + ('a' - 'A') : c, {.shift = upper, .alt = alt});
}

// ESC [ or ESC O, parameters, a final letter: returns the number of bytes taken after the ESC.
std::size_t add_sequence(std::vector<port::Event>& events, std::string_view rest) {
    std::size_t end = 1;
    if (rest[0] == '[' && rest.size() > 1 && rest[1] == '[')
        end = 2; // the Linux console's F1 to F5
    while (end < rest.size() && (rest[end] == ';' || (rest[end] >= '0' && rest[end] <= '9')))
        ++end;
    if (end >= rest.size()) return rest.size();
    std::string text(rest.substr(1, end)); // with the final byte
    Modifiers held;
    if (const std::size_t semicolon = text.find(';'); semicolon != std::string::npos) {
        // xterm: 1;2A is Shift-Up, 5;5~ Ctrl-PageUp; the code is 1 plus a bit each.
        const int code = text[semicolon + 1] - '1';
        held = {(code & 1) != 0, (code & 4) != 0, (code & 2) != 0};
        const char final_byte = text.back();
        text.resize(semicolon);
        text += final_byte;
        if (final_byte != '~') text.erase(0, text.size() - 1);
    }
    for (const Sequence& sequence : kSequences)
        if (sequence.text == text) add_key(events, sequence.keysym, sequence.keysym, held);
    return end + 1;
}

class Terminal final : public ConsoleInput {
public:
    Terminal(int fd, Fd owned, const termios& saved)
        : fd_(fd), owned_(std::move(owned)), saved_(saved) {
        remember_terminal({.fd = fd_, .modes = saved_});
        raw();
    }
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;
    ~Terminal() override { cooked(); }

    int event_fd() const override { return hung_up_ ? -1 : fd_; }
    Result<void> dispatch(std::vector<port::Event>& events) override;
    Result<void> pause(std::vector<port::Event>&) override {
        cooked();
        return {};
    }
    Result<void> resume() override {
        remember_terminal({.fd = fd_, .modes = saved_});
        raw();
        return {};
    }
    std::string description() const override {
        return "keys from the terminal (no input device could be opened)";
    }

private:
    // ISIG stays: Ctrl-C and Ctrl-Z remain signals.
    void raw() const {
        termios mode = saved_;
        mode.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
        mode.c_iflag &= ~static_cast<tcflag_t>(IXON | ICRNL);
        mode.c_cc[VMIN] = 1;
        mode.c_cc[VTIME] = 0;
        ::tcsetattr(fd_, TCSAFLUSH, &mode);
    }
    void cooked() const {
        forget_terminal();
        ::tcsetattr(fd_, TCSAFLUSH, &saved_);
    }

    int fd_;
    Fd owned_;
    termios saved_;
    bool hung_up_ = false;
};

// Never O_NONBLOCK: the flag would stay on the terminal for every program that shares it. poll()
// tells whether a read returns at once.
Result<void> Terminal::dispatch(std::vector<port::Event>& events) {
    std::array<char, 256> bytes;
    pollfd state{fd_, POLLIN, 0};
    while (!hung_up_ && ::poll(&state, 1, 0) == 1) {
        const ssize_t count = ::read(fd_, bytes.data(), bytes.size());
        if (count > 0) {
            const auto keys = keys_of({bytes.data(), static_cast<std::size_t>(count)});
            events.insert(events.end(), keys.begin(), keys.end());
        } else if (count == 0 || errno != EINTR) {
            hung_up_ = true;
            port::Event quit;
            quit.kind = port::EventKind::quit;
            events.push_back(quit);
        }
    }
    return {};
}

} // namespace

std::vector<port::Event> keys_of(std::string_view bytes) {
    std::vector<port::Event> events;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const char c = bytes[i];
        const std::string_view rest = bytes.substr(i + 1);
        if (c != '\x1b') {
            add_character(events, static_cast<unsigned char>(c), false);
        } else if (rest.empty() || rest[0] == '\x1b') {
            add_key(events, XKB_KEY_Escape, XKB_KEY_Escape, {});
        } else if (rest.size() > 1 && (rest[0] == '[' || rest[0] == 'O')) {
            i += add_sequence(events, rest);
        } else {
            add_character(events, static_cast<unsigned char>(rest[0]), true); // Alt is sent as ESC
            ++i;
        }
    }
    return events;
}

Result<std::unique_ptr<ConsoleInput>> open_terminal() {
    int fd = STDIN_FILENO;
    Fd owned;
    if (::isatty(fd) == 0) {
        auto opened = Fd::open("/dev/tty", O_RDWR | O_NOCTTY);
        if (!opened) return fail(Exit::no_display, "standard input is no terminal");
        owned = std::move(*opened);
        fd = owned.get();
    }
    const pid_t foreground = ::tcgetpgrp(fd);
    if (foreground >= 0 && foreground != ::getpgrp())
        return fail(Exit::no_display,
                    "the terminal belongs to another job: start scanout in the foreground");
    termios saved{};
    if (::tcgetattr(fd, &saved) != 0)
        return fail(Exit::no_display, "the terminal's mode: {}", std::strerror(errno));
    return std::make_unique<Terminal>(fd, std::move(owned), saved);
}

} // namespace scanout::console
