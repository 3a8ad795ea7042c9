// The viewer's session in a terminal: what the terminal is asked first, its keys and its mouse,
// signals, and the display on it.
#pragma once

#include "platform/tty/display.h"
#include "platform/tty/line.h"
#include "platform/tty/parser.h"
#include "platform/tty/paste.h"
#include "port/input.h"
#include "port/signals.h"

#include <memory>
#include <vector>

namespace scanout::tty {

class Session final : public port::Input {
public:
    // Takes the terminal and asks what it can, for 200 ms at most. Blocks the signals that end or
    // suspend a program, so it must run before any thread exists. The terminal comes back on every
    // way out of the process but SIGKILL. Exit::no_display where there is none, or where it cannot
    // show what is asked for.
    static Result<std::unique_ptr<Session>> open(Protocol asked);

    Display& display() { return *display_; }

    // As console::Session. Where it is told to end meanwhile, the terminal stays as it was left.
    Result<void> suspend(std::vector<port::Event>& events);

    int event_fd() const override { return epoll_.get(); }
    Result<void> dispatch(std::vector<port::Event>& events) override;
    std::string description() const override { return "keys and mouse of the terminal"; }

private:
    explicit Session(Line line) : line_(std::move(line)) {}
    Result<void> watch_events();
    void probe();
    void enter();
    void take_bytes();
    void arm(int ms); // wakes up for what is late; 0: does not
    void take_signals(std::vector<port::Event>& events);
    void take(const std::vector<Token>& tokens);
    void take_answered(Answer answer, const Token& token, const Facts& before);
    void take_mouse(const Token& token);
    void take_fact(const Facts& before, bool was_open);
    void give_up_late_token();
    bool wait_for_foreground();

    Line line_;
    Fd epoll_, timer_, window_signals_;
    port::Signals signals_;
    Parser parser_;
    int patience_ms_ = 0; // that the timer is set to, of the token that has begun; 0: to none
    Paste paste_;
    Facts facts_;
    std::unique_ptr<Display> display_; // none while the terminal is asked
    std::vector<port::Event> events_;  // not yet given away
    bool tmux_ = false, pixel_mouse_ = false;
};

} // namespace scanout::tty
