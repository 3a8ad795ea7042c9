// The terminal as a display: each frame is sent as the protocol has it, and the next one waits for
// the terminal's answer, so that at most one is on its way.
#pragma once

#include "base/fd.h"
#include "platform/tty/blocks.h"
#include "platform/tty/choose.h"
#include "port/display.h"

#include <chrono>
#include <memory>
#include <vector>

namespace scanout::tty {

class Display final : public port::Display {
public:
    static Result<std::unique_ptr<Display>> create(Line& line, const Facts& facts, Protocol asked,
                                                   bool tmux);

    const port::DisplayInfo& info() const override { return info_; }
    bool ready() const override { return awaited_ == Awaited::nothing && line_.all_sent(); }
    void show_text(std::vector<port::TextLine> lines) override { text_ = std::move(lines); }
    Result<void> present(const image::Image& frame, std::span<const image::Rect> damage) override;
    bool paced() const override { return false; }
    int event_fd() const override { return epoll_.get(); }
    Result<void> dispatch() override;
    bool lost() const override { return false; }
    bool stale() const override { return stale_; }

    const Choice& choice() const { return choice_; }
    // The facts or the window's size have changed.
    void reconfigure(const Facts& facts);
    // The screen shows something else, and a frame that was on its way is answered to nobody.
    void repaint();
    // The terminal has answered. False: nothing of the kind was awaited.
    bool take(Answer answer);
    // Waits for the terminal where it has not taken all that was sent.
    void watch_output();

private:
    enum class Awaited : unsigned char { nothing, attributes, picture };
    Display(Line& line, const Facts& facts, Protocol asked, bool tmux);
    void configure(Choice choice);
    void redraw();
    std::string picture(const image::Image& frame);
    unsigned next_id() const;

    Line& line_;
    Facts facts_;
    Protocol asked_;
    bool tmux_;
    Choice choice_;
    port::DisplayInfo info_;
    Fd epoll_;
    bool watching_ = false; // until the terminal takes more
    Awaited awaited_ = Awaited::nothing;
    std::chrono::steady_clock::time_point sent_at_;
    bool stale_ = true, clear_ = false;
    unsigned id_ = 0; // of the picture that kitty shows; 0: none is
    Cells shown_;
    std::vector<port::TextLine> text_;
};

} // namespace scanout::tty
