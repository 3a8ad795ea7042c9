#include "app/displays.h"
#include "app/message.h"
#include "platform/console.h"
#include "platform/drm/display.h"
#include "platform/linux-fb/display.h"
#include "platform/session.h"

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
    return fail(Exit::no_display, "no display: {}; `scanout render` draws without one", refused);
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

} // namespace

Result<std::unique_ptr<OpenConsole>> open_console(const Settings& settings) {
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
