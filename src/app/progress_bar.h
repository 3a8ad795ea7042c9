// A progress bar on one line of the terminal, for work of more than a moment.
#pragma once

#include "base/stopwatch.h"

#include <functional>
#include <string>
#include <string_view>

namespace scanout::app {

// ", 12 s left", at the speed so far; nothing for work that has not taken long yet.
std::string time_left(double fraction, double milliseconds);

// "reading .../knot.stl  [##########..........]  50 %, 12 s left", ProgressBar::kWidth columns at
// most: `what`, a verb and a path, loses what stands in the path's middle.
std::string progress_line(const std::string& what, int percent, std::string_view left);

class ProgressBar {
public:
    static constexpr double kPatience = 1000; // milliseconds without a bar
    static constexpr std::size_t kWidth = 78; // columns; the narrowest terminals have 80

    // Writes over the line before; "" only erases it.
    using Write = std::function<void(std::string_view line)>;

    // On standard error, where that is a terminal and the program is not told to be quiet. `what`
    // precedes the bar (progress_line).
    ProgressBar(std::string what, bool quiet);
    ProgressBar(std::string what, double patience, Write write);
    ~ProgressBar(); // erases the bar
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void show(double fraction); // 0 to 1; less than before changes nothing

private:
    std::string what_;
    double patience_;
    Write write_; // empty: never shown
    Stopwatch watch_;
    int shown_ = -1; // percent
};

} // namespace scanout::app
