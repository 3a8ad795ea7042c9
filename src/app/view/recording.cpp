#include "app/view/recording.h"

#include "app/message.h"
#include "base/mapping.h"

#include <cerrno>
#include <charconv>

namespace scanout::app {
namespace {

constexpr std::string_view kFirstLine = "scanout-actions 1";
constexpr std::int64_t kLastStep = std::int64_t{1} << 40;

// Takes the step off the front of a line, where it has one.
Result<std::int64_t> take_step(std::string_view& line, std::int64_t last) {
    const bool relative = line.starts_with('+');
    const std::string_view digits = line.substr(relative ? 1 : 0);
    if (digits.empty() || digits[0] < '0' || digits[0] > '9') {
        if (relative) return fail(Exit::unreadable, "+ wants a number of steps, as in +30");
        return last;
    }
    std::int64_t number = 0;
    const auto [stop, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const std::int64_t step = relative ? last + std::min(number, kLastStep) : number;
    if (error != std::errc() || step > kLastStep)
        return fail(Exit::unreadable, "the step is too large: at most {} is", kLastStep);
    if (step < last)
        return fail(Exit::unreadable,
                    "step {} comes after step {}: steps do not go back, "
                    "put the lines in order",
                    step, last);
    line = trimmed({stop, static_cast<std::size_t>(digits.data() + digits.size() - stop)});
    return step;
}

Result<TimedAction> parse_line(std::string_view line, std::int64_t last) {
    TRY(const std::int64_t step, take_step(line, last));
    if (line.empty())
        return fail(Exit::unreadable, "an action is missing after the step, as in 7 quit");
    TRY(Action action, parse_action(line));
    return TimedAction{step, std::move(action)};
}

} // namespace

Result<Script> parse_script(std::string_view text, const std::string& name) {
    Script script;
    std::int64_t last = 0;
    bool first = true;
    for (int number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (first && line != kFirstLine)
            return fail(Exit::unreadable, "{}:{}: a recording begins with the line '{}'", name,
                        number, kFirstLine);
        if (!std::exchange(first, false) && !line.empty() && line[0] != '#') {
            Result<TimedAction> action = parse_line(line, last);
            if (!action)
                return fail(Exit::unreadable, "{}:{}: {}", name, number, action.error().what);
            last = action->step;
            script.push_back(*std::move(action));
        }
    }
    if (first)
        return fail(Exit::unreadable, "{}: is empty; a recording begins with the line '{}'", name,
                    kFirstLine);
    return script;
}

Result<Script> load_script(const std::string& path) {
    TRY(const Mapping file, Mapping::open(path));
    return parse_script(file.text(), path);
}

Result<Recorder> Recorder::create(const std::string& path) {
    std::FILE* file = std::fopen(path.c_str(), "we");
    if (file == nullptr)
        return fail(Exit::unreadable, "{}: cannot be written: {}; name another file", path,
                    std::strerror(errno));
    Recorder recorder(file, path);
    TRY_VOID(recorder.put(std::string(kFirstLine)));
    return recorder;
}

Result<void> Recorder::write(const TimedAction& action) {
    return put(fmt::format("{} {}", action.step, to_text(action.action)));
}

Result<void> Recorder::put(const std::string& line) {
    std::fputs((line + "\n").c_str(), file_.get());
    if (std::fflush(file_.get()) != 0)
        return fail(Exit::unreadable, "{}: cannot be written: {}; name another file", path_,
                    std::strerror(errno));
    return {};
}

} // namespace scanout::app
