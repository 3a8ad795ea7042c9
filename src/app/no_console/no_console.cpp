// For containers and build machines: no libinput, libseat, libdrm.
#include "app/displays.h"

#include <fmt/format.h>

namespace scanout::app {

Result<std::unique_ptr<OpenConsole>> open_console(const Settings&) {
    return fail(Exit::no_display, "this scanout was built without displays (SCANOUT_DISPLAYS=OFF); "
                                  "`scanout render` draws to files, and --backend headless shows "
                                  "nothing but writes what a replay asks for");
}

Result<std::string> restore_console() {
    return fail(Exit::no_display,
                "this scanout was built without displays (SCANOUT_DISPLAYS=OFF): it takes no "
                "console and restores none");
}

void list_displays(const Settings&) {
    fmt::print("headless  in memory, with --backend headless\n");
}
void list_connectors(const Settings&) {}
void list_modes(const Settings&) {}

std::string displays_json(const Settings&) {
    return "[\n  {\n    \"backend\": \"headless\",\n    \"device\": \"\",\n    \"driver\": \"\",\n"
           "    \"problem\": \"\"\n  }\n]\n";
}
std::string connectors_json(const Settings&) {
    return "[]\n";
}
std::string modes_json(const Settings&) {
    return "[]\n";
}

} // namespace scanout::app
