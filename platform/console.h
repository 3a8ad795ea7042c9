// A virtual terminal of the kernel (/dev/ttyN): graphics mode, keyboard mode, who is shown.
#pragma once

#include "base/fd.h"
#include "base/result.h"
#include "platform/restore.h"

namespace scanout::console {

class Console {
public:
    // The VT that is on the screen (needs the rights to open it), and the one that our standard
    // streams or controlling terminal are. Neither changes anything. Errors: Exit::no_display.
    static Result<Console> open_active();
    static Result<Console> open_own();

    int number() const { return number_; }
    int fd() const { return fd_.get(); }
    int keyboard_mode() const { return keyboard_mode_; } // to be restored
    bool shown() const;                                  // it is the VT on the screen
    bool in_graphics_mode() const; // somebody draws on it, or has died doing so

    // One scanout a console: two built-in seat servers would not see each other, and the first to
    // quit would take the screen from under the second. Exit::no_display when it is taken.
    Result<void> lock();

    // Exit::no_display where another program draws here: in graphics mode, and DRM master of a
    // card.
    Result<void> refuse_if_drawn_on() const;

    // graphics() remembers the way back for every exit path (restore.h) and sets KD_GRAPHICS;
    // text() goes that way back. text_for_a_while() does not change who handles the switching.
    Result<void> graphics();
    void text();
    void text_for_a_while();
    // Muted (K_OFF), typed keys reach neither a shell nor the kernel's own key combinations.
    void set_keyboard(bool on);

private:
    friend Result<std::string> restore_shown_console();
    Console(Fd fd, int number, int keyboard_mode)
        : fd_(std::move(fd)), number_(number), keyboard_mode_(keyboard_mode) {}
    static Result<Console> adopt(Fd fd);
    ConsoleState state() const { return {fd_.get(), keyboard_mode_}; }

    Fd fd_, lock_;
    int number_ = 0;
    int keyboard_mode_ = 0;
};

// Puts the console on the screen back into text mode, its keyboard on and its terminal to lines
// with echo, whatever a program that died has left behind (`scanout restore`). Returns what was
// done, in one line. Exit::no_display: no rights, or a program that lives draws there.
Result<std::string> restore_shown_console();

} // namespace scanout::console
