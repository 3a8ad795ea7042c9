#include "platform/console.h"

#include <termios.h>

namespace scanout::console {

Result<std::string> restore_shown_console() {
    TRY(Console console, Console::open_active());
    TRY_VOID(console.refuse_if_drawn_on());
    TRY_VOID(console.lock());
    const bool drawn_on = console.in_graphics_mode();
    restore_console(console.state());
    termios mode{};
    if (::tcgetattr(console.fd(), &mode) == 0) {
        mode.c_iflag |= ICRNL | IXON;
        mode.c_oflag |= OPOST | ONLCR;
        mode.c_lflag |= ISIG | ICANON | ECHO | ECHOE | ECHOK | IEXTEN;
        ::tcsetattr(console.fd(), TCSANOW, &mode);
    }
    return fmt::format("tty{}: text mode{}, keyboard on, lines with echo", console.number(),
                       drawn_on ? " (it was left in graphics mode)" : "");
}

} // namespace scanout::console
