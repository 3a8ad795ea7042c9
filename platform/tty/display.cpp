#include "platform/tty/display.h"

#include "platform/tty/kitty.h"
#include "platform/tty/sixel.h"

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

constexpr const char* name_of(const Choice& choice) {
    switch (choice.protocol) {
    case Protocol::kitty:
        return choice.through_tmux ? "kitty graphics through tmux" : "kitty graphics";
    case Protocol::sixel:
        return "sixel";
    default:
        return "half blocks";
    }
}

std::string sixel_within(const image::Image& frame, int colours, std::size_t bytes) {
    for (;; colours /= 2) {
        std::string picture = sixel_picture(frame, colours);
        if (picture.size() <= bytes || colours <= 4) return picture;
    }
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
    choice_ = std::move(choice);
    info_.name = fmt::format("{}, {}x{} cells{}", name_of(choice_), choice_.columns, choice_.rows,
                             choice_.why.empty() ? "" : " (" + choice_.why + ")");
    info_.width = choice_.width();
    info_.height = choice_.height;
    info_.refresh_hz = kFramesPerSecond;
    info_.has_pointer = true;
    info_.has_letters = choice_.protocol == Protocol::blocks;
    repaint();
}

void Display::reconfigure(const Facts& facts) {
    facts_ = facts;
    const WindowSize window = line_.size();
    if (window.columns < 1 || window.rows < 1) return;
    auto choice = choose(facts_, window, asked_, tmux_);
    if (choice && !(*choice == choice_)) configure(*std::move(choice));
}

void Display::repaint() {
    stale_ = clear_ = true;
    shown_ = {};
}

unsigned Display::next_id() {
    // Terminals have one room for the ids of all programs in them: two of our own, by the process.
    constexpr unsigned kOurs = 0x5c0000;
    const unsigned first = kOurs + (static_cast<unsigned>(::getpid()) & 0x7fff) * 2;
    return id_ == first ? first + 1 : first;
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
    const auto wrapped = [&](const std::string& text) {
        return choice_.through_tmux ? through_tmux(text) : text;
    };
    std::string out = "\x1b[H" + (choice_.through_tmux
                                      ? kitty_placeholders(frame, id, choice_.columns, choice_.rows)
                                      : kitty_picture(frame, id));
    if (id_ != 0) out += wrapped(kitty_delete(id_)); // only now: nothing flickers
    id_ = id;
    line_.set_farewell(wrapped(kitty_delete(id)) + wrapped(kitty_delete(next_id())));
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

void Display::take(Answer answer) {
    if ((answer == Answer::picture && awaited_ == Awaited::picture) ||
        (answer == Answer::attributes && awaited_ == Awaited::attributes))
        awaited_ = Awaited::nothing;
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
        watch_output();
    } else if (awaited_ != Awaited::nothing &&
               std::chrono::steady_clock::now() - sent_at_ > kAnswerTimeout) {
        awaited_ = Awaited::nothing; // it will not come
    }
    return {};
}

} // namespace scanout::tty
