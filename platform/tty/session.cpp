#include "platform/tty/session.h"

#include "platform/terminal.h"
#include "platform/tty/mouse.h"

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>

#include <poll.h>
#include <signal.h>
#include <sys/epoll.h>
#include <sys/signalfd.h>
#include <sys/timerfd.h>
#include <unistd.h>

namespace scanout::tty {
namespace {

constexpr std::chrono::milliseconds kProbe{200};

bool runs_in_tmux() {
    const char* const socket = std::getenv("TMUX");
    return socket != nullptr && *socket != 0;
}

// Programs that run terminals of 24-bit colours say so here.
bool environment_has_true_colour() {
    const char* const colours = std::getenv("COLORTERM");
    const std::string_view text = colours != nullptr ? colours : "";
    return text == "truecolor" || text == "24bit";
}

// By a signal, which waits to be taken.
bool told_to_end() {
    sigset_t pending;
    if (::sigpending(&pending) != 0) return false;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT})
        if (sigismember(&pending, signal) == 1) return true;
    return false;
}

} // namespace

Result<std::unique_ptr<Session>> Session::open(Protocol asked) {
    TRY(Line line, Line::open());
    std::unique_ptr<Session> session(new Session(std::move(line)));
    TRY(session->signals_, port::Signals::create());
    TRY_VOID(session->watch_events());
    session->tmux_ = runs_in_tmux();
    session->facts_.true_colour = environment_has_true_colour();
    session->line_.enter();
    session->probe();
    TRY(session->display_, Display::create(session->line_, session->facts_, asked, session->tmux_));
    session->take_fact(session->facts_, false);
    session->display_->watch_output();
    // For keys that were typed meanwhile at once, for the rest of one in its time.
    session->patience_ms_ = session->events_.empty() ? session->parser_.patience_ms() : 0;
    session->arm(session->events_.empty() ? session->patience_ms_ : 1);
    return session;
}

Result<void> Session::watch_events() {
    epoll_ = Fd(::epoll_create1(EPOLL_CLOEXEC));
    timer_ = Fd(::timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK));
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGWINCH);
    sigaddset(&set, SIGCONT);
    if (::pthread_sigmask(SIG_BLOCK, &set, nullptr) != 0)
        return fail(Exit::internal, "signals cannot be blocked");
    window_signals_ = Fd(::signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK));
    for (const int fd :
         {epoll_.get(), timer_.get(), window_signals_.get(), signals_.event_fd(), line_.fd()}) {
        if (fd < 0) return fail(Exit::internal, "events: {}", std::strerror(errno));
        if (fd == epoll_.get()) continue;
        epoll_event event{};
        event.events = EPOLLIN;
        event.data.fd = fd;
        if (::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, fd, &event) != 0)
            return fail(Exit::internal, "epoll_ctl: {}", std::strerror(errno));
    }
    return {};
}

// Through tmux the answer about kitty comes from farther away than the device attributes, and
// later.
void Session::probe() {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end = Clock::now() + kProbe;
    line_.send(questions(tmux_));
    while (!line_.hung_up() && !(facts_.answers && (facts_.kitty || !tmux_))) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
        if (left.count() <= 0) break;
        pollfd state{line_.fd(), static_cast<short>(line_.all_sent() ? POLLIN : POLLIN | POLLOUT),
                     0};
        if (::poll(&state, 1, static_cast<int>(left.count()) + 1) < 0 && errno != EINTR) break;
        line_.write_on();
        take_bytes();
    }
    line_.set_answers(facts_.answers);
}

void Session::take_bytes() {
    const std::string bytes = line_.read();
    if (bytes.empty()) return;
    std::vector<Token> tokens;
    const bool begun = parser_.feed(bytes, tokens);
    take(tokens);
    // What follows the first byte does not put it off, but where it makes an answer of a key.
    const int patience_ms = parser_.patience_ms();
    if (begun || patience_ms != patience_ms_) arm(patience_ms_ = patience_ms);
}

void Session::arm(int ms) {
    itimerspec spec{};
    spec.it_value.tv_nsec = ms % 1000 * 1'000'000;
    spec.it_value.tv_sec = ms / 1000;
    ::timerfd_settime(timer_.get(), 0, &spec, nullptr);
}

void Session::give_up_late_token() {
    std::uint64_t expirations = 0;
    if (::read(timer_.get(), &expirations, sizeof expirations) != sizeof expirations) return;
    if (std::exchange(patience_ms_, 0) == 0) { // it has woken us up, no more
        arm(patience_ms_ = parser_.patience_ms());
        return;
    }
    std::vector<Token> tokens;
    parser_.give_up(tokens);
    take(tokens);
}

void Session::take(const std::vector<Token>& tokens) {
    const auto now = std::chrono::steady_clock::now();
    for (const Token& token : tokens) {
        const Facts before = facts_;
        if (const Answer answer = take_answer(token, facts_); answer != Answer::none) {
            take_answered(answer, token, before);
        } else if (token.kind == Token::Kind::sequence && token.text.starts_with('<')) {
            take_mouse(token);
        } else if (!paste_.has(token, now) && token.kind != Token::Kind::string) {
            const std::vector<port::Event> keys =
                console::keys_of((token.kind == Token::Kind::sequence ? "\x1b[" : "") + token.text);
            events_.insert(events_.end(), keys.begin(), keys.end());
        }
    }
}

void Session::take_answered(Answer answer, const Token& token, const Facts& before) {
    if (display_ && display_->take(answer) && answer == Answer::refusal)
        facts_.refusal = refusal_of(token);
    take_fact(before, display_ != nullptr);
}

void Session::take_mouse(const Token& token) {
    if (!display_) return;
    const Choice& choice = display_->choice();
    const int across = pixel_mouse_ ? choice.cell_width : 1;
    const int down = pixel_mouse_ ? choice.cell_height : 1;
    add_mouse(token.text, choice.columns * across, choice.rows_covered() * down,
              pixel_mouse_ ? 0 : 0.5, events_);
}

// Answers that come later than the display was opened count, too.
void Session::take_fact(const Facts& before, bool was_open) {
    if (!display_ || (was_open && before == facts_)) return;
    if (was_open) {
        line_.set_answers(facts_.answers);
        display_->reconfigure(facts_);
    }
    const bool pixels = facts_.pixel_mouse && display_->choice().protocol != Protocol::blocks;
    if (pixels && !std::exchange(pixel_mouse_, pixels)) line_.send("\x1b[?1016h");
    if (!pixels && std::exchange(pixel_mouse_, pixels)) line_.send("\x1b[?1016l\x1b[?1006h");
}

void Session::enter() {
    line_.enter();
    if (pixel_mouse_) line_.send("\x1b[?1016h");
    display_->reconfigure(facts_);
    display_->repaint();
}

// False: the program is to end instead.
bool Session::wait_for_foreground() {
    // As Ctrl-Z does by itself: not where nobody could continue us. Continued by `bg`, what draws
    // on a terminal stops again until it gets it.
    sigset_t stop;
    sigemptyset(&stop);
    sigaddset(&stop, SIGTSTP);
    constexpr int kMostTimes = 1000;
    for (int times = 0; times < kMostTimes && (times == 0 || !line_.in_foreground()); ++times) {
        if (told_to_end()) return false;
        ::pthread_sigmask(SIG_UNBLOCK, &stop, nullptr);
        ::kill(::getpid(), SIGTSTP);
        ::pthread_sigmask(SIG_BLOCK, &stop, nullptr);
    }
    signalfd_siginfo info{};
    while (::read(window_signals_.get(), &info, sizeof info) == sizeof info) {
    }
    return !told_to_end();
}

void Session::take_signals(std::vector<port::Event>& events) {
    signalfd_siginfo info{};
    bool resized = false, continued = false;
    while (::read(window_signals_.get(), &info, sizeof info) == sizeof info)
        (info.ssi_signo == SIGWINCH ? resized : continued) = true;
    if (continued) { // stopped by SIGSTOP: whoever had the terminal may have changed it
        if (line_.in_foreground() && !told_to_end())
            enter();
        else
            (void)suspend(events);
    }
    if (!resized) return;
    display_->reconfigure(facts_);
    if (facts_.cell_width > 0) line_.send("\x1b[16t"); // letters of another size, too
}

Result<void> Session::dispatch(std::vector<port::Event>& events) {
    take_signals(events); // first: it looks at those that end the program
    TRY_VOID(signals_.dispatch(events));
    take_bytes();
    give_up_late_token();
    const std::int64_t now =
        std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
    for (port::Event& event : events_) {
        event.time_ns = now; // a terminal does not say when it was
        events.push_back(event);
    }
    events_.clear();
    display_->watch_output(); // for what was sent here
    if (line_.hung_up()) {
        port::Event quit;
        quit.kind = port::EventKind::quit;
        events.push_back(quit);
    }
    return {};
}

Result<void> Session::suspend(std::vector<port::Event>&) {
    line_.leave();
    if (wait_for_foreground()) enter();
    return {};
}

} // namespace scanout::tty
