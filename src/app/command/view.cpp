// scanout view: opens a display and runs the viewer on it.
#include "app/command/commands.h"
#include "app/displays.h"
#include "app/files.h"
#include "app/keys/keys_file.h"
#include "app/message.h"
#include "app/model_arguments.h"
#include "app/model_file.h"
#include "app/moving/motion_file.h"
#include "app/options/conflicts.h"
#include "app/view/view_file.h"
#include "app/view/view_session.h"
#include "base/check.h"
#include "port/headless.h"
#include "port/signals.h"
#include "simd/targets.h"

#include <csignal>

#include <unistd.h>

namespace scanout::app {
namespace {

// Refuses all that can be refused without a display, before one is opened.
Result<void> check_view(const Settings& s) {
    if (s.arguments.empty())
        return fail(Exit::usage, "name a model to show, as in `scanout models/spot/spot.obj`");
    if (s.arguments.size() == 1 && s.arguments.front() != "-" && !s.watch)
        TRY_VOID(check_readable(s.arguments.front()));
    if (!s.replay.empty()) TRY_VOID(check_readable(s.replay));
    if (s.pixel_format && s.backend != Backend::headless)
        return fail(Exit::usage,
                    "--pixel-format: a display has its own; it goes with --backend headless");
    return {};
}

// --record, --replay and the keys, opened before the display: their faults are reported on a text
// console.
struct Prepared {
    std::optional<Recorder> recorder;
    std::optional<Script> script;
    KeyMap keys;
};

Result<Prepared> prepare(const Settings& settings) {
    std::vector<std::string> inputs = settings.arguments;
    inputs.push_back(settings.replay);
    TRY_VOID(check_outputs(inputs, {settings.record, settings.json.value_or(""), settings.state}));
    Prepared prepared{std::nullopt, std::nullopt, KeyMap::standard()};
    if (!settings.replay.empty()) {
        TRY(prepared.script, load_script(settings.replay));
    }
    if (!settings.record.empty()) {
        TRY(prepared.recorder, Recorder::create(settings.record));
    }
    TRY(UserKeys keys, user_keys(settings));
    print_warnings(keys.faults, settings);
    prepared.keys = std::move(keys.map);
    return prepared;
}

SessionParts parts_of(port::Display& display, port::Input& input, Jobs& jobs,
                      std::function<Result<void>(std::vector<port::Event>&)> suspend,
                      Prepared prepared, bool instant) {
    SessionParts parts{display, input, jobs, std::move(suspend), {}, {}, instant};
    parts.recorder = std::move(prepared.recorder);
    parts.script = std::move(prepared.script);
    parts.keys = std::move(prepared.keys);
    return parts;
}

// The commands that the user noted.
using Commands = std::vector<std::string>;

Result<Commands> show(const Settings& settings, SessionParts parts, const char* backend,
                      std::uint64_t start_bytes) {
    const port::DisplayInfo& info = parts.display.info();
    if (settings.verbose)
        say(fmt::format("display {} {}, {}x{} {}", backend, info.name, info.width, info.height,
                        image::name_of(info.format)));
    TRY(const std::unique_ptr<ViewSession> session,
        ViewSession::create(settings, std::move(parts)));
    TRY_VOID(session->run());
    TRY_VOID(write_report(settings, to_json(session->report(start_bytes))));
    if (const std::string view = session->options(); !settings.state.empty() && !view.empty())
        TRY_VOID(write_view(settings.state, view));
    return session->noted_commands();
}

Result<Commands> show_headless(const Settings& settings, Prepared prepared,
                               std::uint64_t start_bytes) {
    const image::PixelFormat format = settings.pixel_format.value_or(image::PixelFormat{});
    TRY(port::HeadlessDisplay display,
        port::HeadlessDisplay::create(settings.frame.width, settings.frame.height, format));
    TRY(port::Signals signals, port::Signals::create());
    if (settings.replay.empty() && !settings.quiet)
        say("scanout: headless: nothing is shown; Ctrl-C ends it (--replay FILE plays actions)");
    CHECK(simd::choose_target(settings.target)); // read_target let only these through
    Jobs jobs(settings.threads);
    const bool instant = prepared.script.has_value();
    const auto suspend = [instant](std::vector<port::Event>&) -> Result<void> {
        if (!instant) ::kill(::getpid(), SIGSTOP); // nobody would continue a stopped replay
        return {};
    };
    return show(settings, parts_of(display, signals, jobs, suspend, std::move(prepared), instant),
                "headless", start_bytes);
}

Result<Commands> show_on_console(const Settings& settings, Prepared prepared,
                                 std::uint64_t start_bytes) {
    TRY(const std::unique_ptr<OpenConsole> console, open_console(settings));
    CHECK(simd::choose_target(settings.target)); // read_target let only these through
    Jobs jobs(settings.threads); // threads only now: the seat's server is a fork of this process
    const auto suspend = [&](std::vector<port::Event>& events) { return console->suspend(events); };
    return show(
        settings,
        parts_of(console->display(), console->input(), jobs, suspend, std::move(prepared), false),
        console->backend(), start_bytes);
}

} // namespace

Result<Exit> run_view(const Settings& given, std::uint64_t start_bytes) {
    Settings settings = given;
    if (settings.connector == "help") list_connectors(settings);
    if (settings.mode == "help") list_modes(settings);
    if (settings.connector == "help" || settings.mode == "help") return Exit::ok;
    TRY(settings.arguments, models_of(given.arguments));
    TRY_VOID(check_view(settings));
    TRY_VOID(read_motion(settings));
    TRY(Prepared prepared, prepare(settings));
    if (const std::string_view steadying = steadying_option(settings);
        settings.converge == Converge::on && !steadying.empty())
        print_warnings({fmt::format("--converge on changes nothing: with {} nothing converges, so "
                                    "that every run shows the same",
                                    steadying)},
                       settings);
    const bool on_console = settings.backend != Backend::headless;
    const Result<Commands> noted = on_console
                                       ? show_on_console(settings, std::move(prepared), start_bytes)
                                       : show_headless(settings, std::move(prepared), start_bytes);
    if (on_console && settings.verbose && (noted || noted.error().exit != Exit::no_display))
        say("console restored");
    if (!noted) return tl::unexpected(noted.error());
    for (const std::string& command : *noted)
        say(command, stdout);
    return Exit::ok;
}

} // namespace scanout::app
