#include "app/progress_bar.h"

#include "app/message.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace scanout::app {
namespace {

constexpr std::size_t kBar = 20;
constexpr double kWorthTelling = 5000; // milliseconds: work that takes longer says how long

bool is_inside_character(char byte) {
    return (static_cast<unsigned char>(byte) & 0xc0) == 0x80; // UTF-8
}

// The first letters of a text, and the last: no more bytes, which are no fewer than columns, and no
// half characters.
std::string_view front_of(std::string_view text, std::size_t bytes) {
    while (bytes > 0 && bytes < text.size() && is_inside_character(text[bytes]))
        --bytes;
    return text.substr(0, bytes);
}
std::string_view back_of(std::string_view text, std::size_t bytes) {
    std::size_t from = text.size() - std::min(bytes, text.size());
    while (from < text.size() && is_inside_character(text[from]))
        ++from;
    return text.substr(from);
}

// "reading .../models/knot.stl": the verb and the file's name are worth more than its folders.
std::string shortened(const std::string& what, std::size_t most) {
    constexpr std::string_view kDots = "...";
    if (what.size() <= most) return what;
    const std::size_t verb = std::min(what.find(' ') + 1, most / 2); // 0: there is none
    const std::size_t room = most - verb - kDots.size();
    const std::size_t name = what.size() - std::min(what.rfind('/') + 1, what.size());
    const std::size_t front = name <= room ? 0 : room / 3; // of a long name
    const std::string_view text = what, path = text.substr(verb);
    return fmt::format("{}{}{}{}", front_of(text, verb), front_of(path, front), kDots,
                       back_of(path, room - front));
}

} // namespace

std::string time_left(double fraction, double milliseconds) {
    if (milliseconds < kWorthTelling || !(fraction > 0)) return {};
    const double left = milliseconds / 1000 * (1 - fraction) / fraction;
    return fmt::format(", {:.0f} s left", std::min(left, 99999.0));
}

std::string progress_line(const std::string& what, int percent, std::string_view left) {
    const std::size_t full = kBar * static_cast<std::size_t>(percent) / 100;
    const std::string bar = fmt::format("  [{}{}] {:3} %{}", std::string(full, '#'),
                                        std::string(kBar - full, '.'), percent, left);
    return shortened(escaped(what), ProgressBar::kWidth - bar.size()) + bar;
}

ProgressBar::ProgressBar(std::string what, bool quiet)
    : ProgressBar(std::move(what), kPatience,
                  !quiet && ::isatty(STDERR_FILENO) == 1 ? Write(say_over) : Write()) {}

ProgressBar::ProgressBar(std::string what, double patience, Write write)
    : what_(std::move(what)), patience_(patience), write_(std::move(write)) {}

ProgressBar::~ProgressBar() {
    if (shown_ >= 0) write_("");
}

void ProgressBar::show(double fraction) {
    const int percent = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * 100);
    if (!write_ || percent <= shown_ || watch_.milliseconds() < patience_) return;
    shown_ = percent;
    write_(progress_line(what_, percent, time_left(fraction, watch_.milliseconds())));
}

} // namespace scanout::app
