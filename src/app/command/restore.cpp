// scanout restore: a text console again, after a program that died on it.
#include "app/command/commands.h"
#include "app/displays.h"
#include "app/message.h"

namespace scanout::app {

Result<Exit> run_restore(const Settings& settings) {
    if (!settings.arguments.empty())
        return fail(Exit::usage, "restore takes no files: it heals the console on the screen");
    TRY(const std::string done, restore_console());
    if (!settings.quiet) say(done);
    return Exit::ok;
}

} // namespace scanout::app
