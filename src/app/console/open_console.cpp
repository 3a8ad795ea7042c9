#include "app/displays.h"
#include "app/message.h"
#include "platform/console.h"
#include "platform/drm/display.h"
#include "platform/linux-fb/display.h"
#include "platform/session.h"
#include "platform/tty/session.h"

#include <array>
#include <string>
#include <utility>

namespace scanout::app {
namespace {

struct OpenDisplay {
    std::unique_ptr<port::Display> display;
    const char* backend = "";
};

// Opens the first display that works. Reports those refused before it with --verbose; if none
// works, the refusals are the error.
Result<OpenDisplay> open_display(const Settings& s, console::Seat& seat) {
    const bool names_fb = s.device.starts_with("/dev/fb");
    const bool names_drm = !s.device.empty() && !names_fb;
    std::string refused;
    const auto refuse = [&](const char* name, const Error& error) {
        if (s.verbose) say(fmt::format("{}: {}", name, error.what));
        refused += fmt::format("{}{}: {}", refused.empty() ? "" : "; ", name, error.what);
    };
    if (s.backend != Backend::fbdev && !names_fb) {
        auto display = drm::create({s.device, s.connector, s.mode}, seat);
        if (display) return OpenDisplay{*std::move(display), "drm"};
        refuse("DRM", display.error());
    }
    if (s.backend != Backend::drm && !names_drm) {
        linux_fb::Options options;
        if (names_fb) options.device = s.device;
        auto display = linux_fb::create(options, seat);
        if (display) return OpenDisplay{*std::move(display), "fbdev"};
        refuse("framebuffer", display.error());
    }
    return fail(Exit::no_display,
                "no display: {}; --backend terminal draws in the terminal, `scanout render` to a "
                "file",
                refused);
}

class SeatedConsole final : public OpenConsole {
public:
    SeatedConsole(std::unique_ptr<console::Session> session, OpenDisplay open)
        : session_(std::move(session)), open_(std::move(open)) {}

    port::Display& display() override { return *open_.display; }
    port::Input& input() override { return *session_; }
    Result<void> suspend(std::vector<port::Event>& events) override {
        return session_->suspend(events);
    }
    const char* backend() const override { return open_.backend; }

private:
    std::unique_ptr<console::Session> session_; // outlives the display
    OpenDisplay open_;
};

// Says why there is nothing better, whenever that becomes another reason.
class TerminalConsole final : public OpenConsole, public port::Input {
public:
    TerminalConsole(std::unique_ptr<tty::Session> session, bool quiet)
        : session_(std::move(session)), quiet_(quiet) {
        say_why();
    }

    port::Display& display() override { return session_->display(); }
    port::Input& input() override { return *this; }
    int event_fd() const override { return session_->event_fd(); }
    Result<void> dispatch(std::vector<port::Event>& events) override {
        TRY_VOID(session_->dispatch(events));
        say_why();
        return {};
    }
    std::string description() const override { return session_->description(); }
    Result<void> suspend(std::vector<port::Event>& events) override {
        return session_->suspend(events);
    }
    const char* backend() const override { return "terminal"; }

private:
    void say_why() {
        const tty::Choice& choice = session_->display().choice();
        if (choice.why == why_) return;
        why_ = choice.why;
        if (!why_.empty() && !quiet_)
            say(fmt::format("scanout: drawn as {}: {}", tty::name_of(choice), why_));
    }

    std::unique_ptr<tty::Session> session_;
    bool quiet_;
    std::string why_; // as it was said
};

Result<std::unique_ptr<OpenConsole>> open_on_terminal(const Settings& settings) {
    for (const auto& [name, value] : {std::pair("--device", settings.device),
                                      {"--connector", settings.connector},
                                      {"--mode", settings.mode}})
        if (!value.empty())
            return fail(Exit::usage, "--backend terminal has no device: leave {} out", name);
    constexpr std::array kProtocols = {tty::Protocol::automatic, tty::Protocol::kitty,
                                       tty::Protocol::sixel, tty::Protocol::blocks};
    TRY(std::unique_ptr<tty::Session> session,
        tty::Session::open(kProtocols[static_cast<std::size_t>(settings.terminal)]));
    return std::make_unique<TerminalConsole>(std::move(session), settings.quiet);
}

} // namespace

Result<std::unique_ptr<OpenConsole>> open_console(const Settings& settings) {
    if (settings.backend == Backend::terminal) return open_on_terminal(settings);
    TRY(std::unique_ptr<console::Session> session,
        console::Session::open(!settings.device.empty()));
    TRY(OpenDisplay open, open_display(settings, session->seat()));
    TRY_VOID(session->open_input());
    if (settings.verbose)
        for (const std::string& note : session->notes())
            say(note);
    return std::make_unique<SeatedConsole>(std::move(session), std::move(open));
}

Result<std::string> restore_console() {
    return console::restore_shown_console();
}

} // namespace scanout::app
