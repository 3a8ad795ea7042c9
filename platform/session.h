// A session on the console, as the viewer sees it: the seat, the signals and the input devices
// behind one Input. Create it first thing in main (before threads: see open), destroy it last.
#pragma once

#include "platform/console_input.h"
#include "platform/libinput.h"
#include "platform/seat.h"
#include "platform/terminal.h"
#include "port/input.h"
#include "port/signals.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace scanout::console {

class Session final : public port::Input {
public:
    // Takes the seat and puts the console into graphics mode. Blocks the signals that end or
    // suspend a program (they arrive as Events), so it must run before any thread exists. From here
    // on the console's text comes back on every way out of the process: destruction, exit(), a
    // fatal signal; a small guard process restores it after SIGKILL. Exit::no_display when this
    // machine has neither /dev/dri/card* nor /dev/fb*.
    // device_is_named: the user names a device, so it is tried even if /dev has no display.
    static Result<std::unique_ptr<Session>> open(bool device_is_named = false);
    ~Session() override;

    Seat& seat() { return *seat_; }

    // Opens the input devices: libinput by udev, else by path, else keys from the terminal. Call it
    // when a display is there. An error (Exit::no_display): nothing to press a key on.
    Result<void> open_input();

    // Gives the console back to the shell and stops the process until it is continued (Ctrl-Z).
    // Call on EventKind::suspend. Appends the releases of held keys and buttons. Does nothing where
    // the console belongs to a seat server that does not let us give it back.
    Result<void> suspend(std::vector<port::Event>& events);

    int event_fd() const override { return epoll_.get(); }
    // quit and suspend come from signals too. Ctrl-Alt-Fn switches the console and is not passed
    // on.
    Result<void> dispatch(std::vector<port::Event>& events) override;
    std::string description() const override; // seat and input

    // The attempts that failed and their reasons; one line each, for --verbose.
    const std::vector<std::string>& notes() const { return notes_; }

private:
    Session() = default;
    std::array<ConsoleInput*, 2> inputs() const { return {libinput_.get(), terminal_.get()}; }
    void watch(int fd) const;
    void unwatch(int fd) const;
    Result<void> route_keys();
    Result<void> pause(std::vector<port::Event>& events);
    Result<void> resume();

    Fd epoll_;
    port::Signals signals_;
    std::unique_ptr<Seat> seat_;
    std::unique_ptr<Libinput> libinput_;
    std::unique_ptr<ConsoleInput> terminal_;
    bool routed_ = false, keyboard_ = false; // keys come from a keyboard, not from the terminal
    bool paused_ = false;
    std::vector<std::string> notes_;
};

} // namespace scanout::console
