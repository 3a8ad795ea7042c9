// Recordings of actions, for --record and --replay. A text file:
//
//   scanout-actions 1              the first line: format and version
//   # a comment
//   0 rotate_left                  STEP ACTION [NUMBERS]: a step is 1/60 s of the virtual clock
//   +30 drag_begin                 +N: that many steps after the line above
//   drag_rotate 120 -33            no step: the same as the line above
//   +1 drag_end
//   +0 frame turned.png            writes the picture: .png .ppm .pam, or .raw (display bytes)
//   +60 quit
#pragma once

#include "app/view/actions.h"
#include "base/result.h"

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace scanout::app {

struct TimedAction {
    std::int64_t step = 0;
    Action action;
    friend bool operator==(const TimedAction&, const TimedAction&) = default;
};
using Script = std::vector<TimedAction>;

// `name` begins each error: "name:line: fault". Exit::unreadable.
Result<Script> parse_script(std::string_view text, const std::string& name);
Result<Script> load_script(const std::string& path);

// Writes each action as it is taken; a line is in the file when write() returns.
class Recorder {
public:
    static Result<Recorder> create(const std::string& path);
    Result<void> write(const TimedAction& action);

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    Recorder(std::FILE* file, std::string path) : file_(file), path_(std::move(path)) {}
    Result<void> put(const std::string& line);
    std::unique_ptr<std::FILE, Close> file_;
    std::string path_;
};

} // namespace scanout::app
