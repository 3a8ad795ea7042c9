#include "frame/options.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace scanout::frame {

namespace {

#define SCANOUT_NAME(name) #name,
constexpr std::string_view kCulls[] = {SCANOUT_CULL(SCANOUT_NAME)}; // [Cull]
#undef SCANOUT_NAME

// Null where the axis is not asked.
std::string FrameOptions::*asked_on(std::string_view axis) {
    for (const AskedAxis& row : asked_axes())
        if (row.axis == axis) return row.asked;
    return nullptr;
}

} // namespace

std::span<const AskedAxis> asked_axes() {
#define SCANOUT_ROW_asked(axis) {#axis, &FrameOptions::axis},
#define SCANOUT_ROW_listed(axis)
#define SCANOUT_ROW_planned(axis)
#define SCANOUT_ROW(module, axis, LIST, Row, choice, help) SCANOUT_ROW_##choice(axis)
    static constexpr AskedAxis kAxes[] = {SCANOUT_AXES(SCANOUT_ROW)};
#undef SCANOUT_ROW
#undef SCANOUT_ROW_asked
#undef SCANOUT_ROW_listed
#undef SCANOUT_ROW_planned
    return kAxes;
}

bool ask(FrameOptions& options, std::string_view axis, std::string_view technique) {
    if (axis == "cull") {
        const auto* const found = std::find(std::begin(kCulls), std::end(kCulls),
                                            is_auto(technique) ? kCulls[0] : technique);
        if (found == std::end(kCulls)) return false;
        options.cull = static_cast<Cull>(found - std::begin(kCulls));
        return true;
    }
    std::string FrameOptions::*const asked = asked_on(axis);
    if (asked == nullptr) return false;
    options.*asked = technique;
    if (asked == &FrameOptions::aa) options.samples = 1; // another way to ask for the same
    return true;
}

std::string asked_for(const FrameOptions& options, std::string_view axis) {
    if (axis == "cull")
        return std::string(options.cull == Cull{} ? "auto"
                                                  : kCulls[static_cast<std::size_t>(options.cull)]);
    std::string FrameOptions::*const asked = asked_on(axis);
    if (asked == &FrameOptions::aa && is_auto(options.aa) && options.samples != 1)
        return fmt::format("samples_{}", options.samples);
    return asked != nullptr ? options.*asked : "auto";
}

std::string option_of(std::string_view axis) {
    std::string name(axis);
    std::replace(name.begin(), name.end(), '_', '-');
    return name;
}

} // namespace scanout::frame
