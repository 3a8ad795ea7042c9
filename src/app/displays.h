// The displays of this machine, and a console to show the viewer on. Two folders implement it:
// console/, and no_console/ in a program that was built without (SCANOUT_DISPLAYS=OFF).
#pragma once

#include "app/options/settings.h"
#include "base/result.h"
#include "port/display.h"
#include "port/input.h"

#include <memory>
#include <string>
#include <vector>

namespace scanout::app {

// A display with its input devices. The console's text comes back with its end.
class OpenConsole {
public:
    OpenConsole() = default;
    OpenConsole(const OpenConsole&) = delete;
    OpenConsole& operator=(const OpenConsole&) = delete;
    virtual ~OpenConsole() = default;
    virtual port::Display& display() = 0;
    virtual port::Input& input() = 0;
    virtual Result<void> suspend(std::vector<port::Event>& events) = 0; // as console::Session
    virtual const char* backend() const = 0;                            // "drm"
};

// As --backend, --device, --connector and --mode say; before any thread exists. Exit::no_display
// with the reason of each display that was tried.
Result<std::unique_ptr<OpenConsole>> open_console(const Settings& settings);

// `scanout restore`: the console on the screen back to text, after a program that died (restored to
// what, in one line).
Result<std::string> restore_console();

// What `scanout list` prints, and as JSON; of the display that --device names, or of all.
void list_displays(const Settings& settings);
void list_connectors(const Settings& settings);
void list_modes(const Settings& settings);
std::string displays_json(const Settings& settings);
std::string connectors_json(const Settings& settings);
std::string modes_json(const Settings& settings);

} // namespace scanout::app
