#include "platform/tty/display.h"

#include "platform/tty/kitty.h"
#include "platform/tty/sixel_within.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <sys/epoll.h>
#include <unistd.h>

namespace scanout::tty {
namespace {

constexpr double kFramesPerSecond = 30; // a line carries no more
constexpr std::chrono::seconds kAnswerTimeout{10};
// tmux throws away a longer sequence (its INPUT_BUF_LIMIT is 1 MiB).
constexpr std::size_t kMostForTmux = 1'000'000;
constexpr int kMostColours = 256;

// Terminals have one room for the ids of all programs in them: two of our own, by the process.
unsigned first_id() {
    constexpr unsigned kOurs = 0x5c0000;
    return kOurs + (static_cast<unsigned>(::getpid()) & 0x7fff) * 2;
}

// Kitty's commands, as they reach the terminal that shows the picture.
std::string wrapped(const Choice& choice, const std::string& text) {
    return choice.through_tmux ? through_tmux(text) : text;
}

} // namespace

Result<std::unique_ptr<Display>> Display::create(Line& line, const Facts& facts, Protocol asked,
                                                 bool tmux) {
    TRY(Choice choice, choose(facts, line.size(), asked, tmux));
    std::unique_ptr<Display> display(new Display(line, facts, asked, tmux));
    if (!display->epoll_.valid()) return fail(Exit::internal, "epoll: {}", std::strerror(errno));
    display->configure(std::move(choice));
    return display;
}

Display::Display(Line& line, const Facts& facts, Protocol asked, bool tmux)
    : line_(line), facts_(facts), asked_(asked), tmux_(tmux),
      epoll_(::epoll_create1(EPOLL_CLOEXEC)) {}

void Display::configure(Choice choice) {
    if (choice.protocol == Protocol::kitty) // before its first picture; it stays, whatever follows
        line_.set_farewell(
            wrapped(choice, kitty_delete(first_id()) + kitty_delete(first_id() + 1)));
    else if (const unsigned shown = std::exchange(id_, 0);
             shown != 0) // it would cover what follows
        line_.send(wrapped(choice_, kitty_delete(shown)));
    choice_ = std::move(choice);
    info_.name = fmt::format("{}, {}x{} cells{}", name_of(choice_), choice_.columns, choice_.rows,
                             choice_.why.empty() ? "" : " (" + choice_.why + ")");
    info_.width = choice_.width;
    info_.height = choice_.height;
    info_.refresh_hz = kFramesPerSecond;
    info_.has_pointer = true;
    info_.has_letters = choice_.protocol == Protocol::blocks;
    redraw();
}

void Display::reconfigure(const Facts& facts) {
    facts_ = facts;
    auto choice = choose(facts_, line_.size(), asked_, tmux_);
    if (choice && !(*choice == choice_)) configure(*std::move(choice));
}

void Display::redraw() {
    stale_ = clear_ = true;
    shown_ = {};
}

void Display::repaint() {
    redraw();
    awaited_ = Awaited::nothing;
    watch_output();
}

unsigned Display::next_id() const {
    return id_ == first_id() ? first_id() + 1 : first_id();
}

std::string Display::picture(const image::Image& frame) {
    if (choice_.protocol == Protocol::blocks) {
        Cells cells = cells_of(frame);
        put_text(cells, text_);
        std::string changes = written(cells, shown_, facts_.true_colour || tmux_);
        shown_ = std::move(cells);
        return changes;
    }
    if (choice_.protocol == Protocol::sixel) {
        const int colours = facts_.colour_registers > 1
                                ? std::min(facts_.colour_registers, kMostColours)
                                : kMostColours;
        return "\x1b[H" + sixel_within(frame, colours, tmux_ ? kMostForTmux : std::string::npos);
    }
    const unsigned id = next_id();
    std::string out =
        "\x1b[H" + (choice_.through_tmux
                        ? kitty_placeholders(frame, id, choice_.columns, choice_.rows)
                        : kitty_picture(frame, id, choice_.scaled ? choice_.columns : 0,
                                        choice_.scaled ? choice_.rows : 0));
    if (id_ != 0) out += wrapped(choice_, kitty_delete(id_)); // only now: nothing flickers
    id_ = id;
    return out;
}

Result<void> Display::present(const image::Image& frame, std::span<const image::Rect> damage) {
    const bool letters = choice_.protocol == Protocol::blocks; // they are no damage
    if (damage.empty() && !stale_ && !letters) return {};
    std::string out = picture(frame);
    if (std::exchange(clear_, false)) out = "\x1b[m\x1b[2J" + out;
    stale_ = false;
    if (out.empty()) return {};
    if (facts_.synchronized) out = "\x1b[?2026h" + out + "\x1b[?2026l";
    if (choice_.protocol == Protocol::kitty && !choice_.through_tmux && facts_.kitty) {
        awaited_ = Awaited::picture;
    } else if (facts_.answers) {
        awaited_ = Awaited::attributes;
        out += kAskAttributes;
    }
    line_.send(out);
    sent_at_ = std::chrono::steady_clock::now();
    watch_output();
    return {};
}

bool Display::take(Answer answer) {
    const bool of_picture = answer == Answer::picture || answer == Answer::refusal;
    const Awaited told = of_picture                     ? Awaited::picture
                         : answer == Answer::attributes ? Awaited::attributes
                                                        : Awaited::nothing;
    if (told == Awaited::nothing || told != awaited_) return false;
    awaited_ = Awaited::nothing;
    return true;
}

void Display::watch_output() {
    const bool watch = !line_.all_sent();
    if (watch == watching_) return;
    watching_ = watch;
    epoll_event event{};
    event.events = EPOLLOUT;
    event.data.fd = line_.fd();
    ::epoll_ctl(epoll_.get(), watch ? EPOLL_CTL_ADD : EPOLL_CTL_DEL, line_.fd(), &event);
}

Result<void> Display::dispatch() {
    if (!line_.all_sent()) {
        line_.write_on();
        sent_at_ = std::chrono::steady_clock::now();
    } else if (awaited_ != Awaited::nothing &&
               std::chrono::steady_clock::now() - sent_at_ > kAnswerTimeout) {
        awaited_ = Awaited::nothing; // it will not come
    }
    watch_output();
    return {};
}

} // namespace scanout::tty
