#include "app/command/commands.h"
#include "app/message.h"
#include "app/model_file.h"
#include "app/options/command_line.h"
#include "base/float_environment.h"
#include "base/memory.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <system_error>

namespace scanout::app {
namespace {

Result<Exit> dispatch(const Settings& settings, std::uint64_t start_bytes) {
    print_warnings(settings.notes, settings);
    switch (settings.command) {
    case Command::view:
        return run_view(settings, start_bytes);
    case Command::render:
        return run_render(settings, start_bytes);
    case Command::explain:
        return run_explain(settings);
    case Command::frontier:
        return run_frontier(settings);
    case Command::doctor:
        return run_doctor(settings);
    case Command::info:
        return run_info(settings);
    case Command::compare:
        return run_compare(settings);
    case Command::spectrum:
        return run_spectrum(settings);
    case Command::colour:
        return run_colour(settings);
    case Command::synthesise:
        return run_synthesise(settings);
    case Command::generate:
        return run_generate(settings);
    case Command::restore:
        return run_restore(settings);
    case Command::list:
        break;
    }
    return run_list(settings);
}

Result<Exit> parse_and_run(std::vector<std::string> arguments, std::uint64_t start_bytes) {
    TRY(const CommandLine line, parse_command_line(std::move(arguments), read_standing_options));
    if (line.printout.empty()) return dispatch(line.settings, start_bytes);
    std::fputs(line.printout.c_str(), stdout);
    return Exit::ok;
}

} // namespace

Exit run(int argc, char** argv) {
    const FloatEnvironment plain; // for arithmetic outside of jobs: cameras, models
    const std::uint64_t start_bytes = resident_bytes();
    // A reader that ends early (`scanout ... | head`) makes write() fail; it must not end the
    // program by a signal.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN); // a file that may not grow likewise
    Result<Exit> result = Exit::internal;
    try {
        result = parse_and_run({argv + 1, argv + argc}, start_bytes);
    } catch (const std::bad_alloc&) {
        result = fail(Exit::internal, "out of memory; a smaller --size or model needs less");
    } catch (const std::system_error& error) { // of fmt::print, where the buffer is full
        const bool output = error.code().value() == EPIPE || error.code().value() == ENOSPC;
        result = output ? fail(Exit::unreadable, "standard output: {}", error.what())
                        : fail(Exit::internal, "{}; this is a mistake in scanout", error.what());
    } catch (const std::exception& error) {
        result = fail(Exit::internal, "{}; this is a mistake in scanout", error.what());
    }
    if (result && std::fflush(stdout) != 0)
        result =
            fail(Exit::unreadable, "standard output: cannot be written: {}", std::strerror(errno));
    if (result) return *result;
    say("scanout: " + result.error().what);
    return result.error().exit;
}

} // namespace scanout::app
