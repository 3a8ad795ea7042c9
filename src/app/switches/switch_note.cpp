#include "app/switches/switch_note.h"

#include "frame/plan/ignored_options.h"

#include <fmt/format.h>

namespace scanout::app {

std::string switch_note(const frame::FramePlan& plan, std::string_view axis) {
    const frame::Decision* const decision = plan.decision(axis);
    if (decision == nullptr) return "";
    const std::string off = fmt::format(" (off: {})", decision->because);
    std::string asked;
    for (const frame::AskedAxis& row : frame::asked_axes())
        if (row.axis == axis) asked = plan.options.*row.asked;
    if (frame::is_auto(asked))
        return decision->on() ? fmt::format(" ({})", decision->technique) : off;
    const std::string option = fmt::format("--{} {} ", frame::option_of(axis), asked);
    for (const std::string& line : frame::ignored_options(plan))
        if (line.starts_with(option)) return fmt::format(" ({})", line.substr(option.size()));
    return decision->on() || asked == "none" ? "" : off;
}

} // namespace scanout::app
