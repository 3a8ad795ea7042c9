#include "app/progress_bar.h"

#include "app/message.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace scanout::app {
namespace {

// Two brackets, blanks, "100 %"; and ", 99999 s left".
constexpr std::size_t kBar = 30, kBehindWhat = kBar + 10 + 14;
constexpr double kWorthTelling = 5000; // milliseconds: work that takes longer says how long

std::string shortened(const std::string& what) {
    constexpr std::size_t kMax = ProgressBar::kWidth - kBehindWhat;
    if (what.size() <= kMax) return what;
    std::size_t from = what.size() - kMax + 3;
    while (from < what.size() && (static_cast<unsigned char>(what[from]) & 0xc0) == 0x80)
        ++from; // the middle of a character
    return "..." + what.substr(from);
}

} // namespace

std::string time_left(double fraction, double milliseconds) {
    if (milliseconds < kWorthTelling || !(fraction > 0)) return {};
    const double left = milliseconds / 1000 * (1 - fraction) / fraction;
    return fmt::format(", {:.0f} s left", std::min(left, 99999.0));
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
    if (!write_ || percent == shown_ || watch_.milliseconds() < patience_) return;
    shown_ = percent;
    const std::size_t full = kBar * static_cast<std::size_t>(percent) / 100;
    write_(fmt::format("{}  [{}{}] {:3} %{}", shortened(what_), std::string(full, '#'),
                       std::string(kBar - full, '.'), percent,
                       time_left(fraction, watch_.milliseconds())));
}

} // namespace scanout::app
