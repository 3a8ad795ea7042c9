// The line to the terminal that we run in: its modes, its alternate screen, bytes in and out
// without waiting.
#pragma once

#include "base/fd.h"
#include "base/result.h"

#include <string>
#include <string_view>

#include <termios.h>

namespace scanout::tty {

struct WindowSize {
    int columns = 0, rows = 0;
    int width = 0, height = 0; // pixels; 0: not known
    friend bool operator==(const WindowSize&, const WindowSize&) = default;
};

// Exit::no_display where it has no cells: nobody has told the line its size.
Result<void> check_size(const WindowSize& window);

class Line {
public:
    // The controlling terminal, by an open file of our own: that it does not block is no matter of
    // those who share the terminal. Exit::no_display where there is none, where standard output
    // goes elsewhere, also to another terminal, or in the background.
    static Result<Line> open();
    Line(Line&& other) noexcept; // before enter(): afterwards handlers know where it is
    Line& operator=(Line&&) = delete;
    ~Line() { leave(); }

    int fd() const { return fd_.get(); }
    WindowSize size() const;
    bool in_foreground() const;
    bool hung_up() const { return hung_up_; }

    // Raw keys, the alternate screen, the mouse; output of the program is held. leave() undoes
    // everything, as does restore_now() (restore.h) on every other way out. ISIG stays: Ctrl-C and
    // Ctrl-Z remain signals.
    void enter();
    void leave();
    // The terminal answers questions: leave() waits for the last one.
    void set_answers(bool answers);
    // Written when leaving, before the modes; what takes pictures out of the terminal's memory.
    void set_farewell(std::string_view text);

    // Appends to what is to be written, then writes what can be. Nothing between leave() and
    // enter(): the terminal is another program's.
    void send(std::string_view text);
    void write_on();
    bool all_sent() const { return out_.empty(); }

    // What the terminal has sent; "" when that is nothing, and between leave() and enter(): in the
    // background a read would stop the program.
    std::string read();

private:
    Line(Fd fd, const termios& modes) : fd_(std::move(fd)), modes_(modes) {}
    void remember() const;

    Fd fd_;
    termios modes_;
    std::string out_;
    std::size_t sent_ = 0; // of out_
    std::string farewell_, whole_farewell_;
    bool entered_ = false, answers_ = false, hung_up_ = false;
};

} // namespace scanout::tty
