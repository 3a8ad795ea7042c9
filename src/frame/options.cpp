#include "frame/options.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace scanout::frame {

namespace {

constexpr std::string_view kSides[] = {"auto", "back", "front"}; // [Cull]

// What is asked for on an axis; null where it has no option. Of const options, a const string.
template <class Options>
auto find_axis(Options& o, std::string_view axis) -> decltype(&o.texture) {
    const std::pair<std::string_view, decltype(&o.texture)> axes[] = {
        {"interpolate", &o.interpolate},
        {"texture", &o.texture},
        {"wrap", &o.wrap},
        {"source", &o.source},
        {"mapping", &o.mapping},
        {"reflection", &o.reflection},
        {"shading", &o.shading},
        {"shadow", &o.shadow},
        {"transparency", &o.transparency},
        {"blend", &o.blend},
        {"stencil", &o.stencil},
        {"depth", &o.depth},
        {"depth_test", &o.depth_test},
        {"aa", &o.aa},
        {"tone", &o.tone},
        {"blend_space", &o.blend_space},
        {"encode", &o.encode},
        {"dither", &o.dither},
        {"convolution", &o.convolution}};
    for (const auto& [name, asked] : axes)
        if (name == axis) return asked;
    return nullptr;
}

} // namespace

bool ask(FrameOptions& options, std::string_view axis, std::string_view technique) {
    if (axis == "cull") {
        const auto* const side = std::find(std::begin(kSides), std::end(kSides), technique);
        if (side == std::end(kSides)) return false;
        options.cull = static_cast<Cull>(side - std::begin(kSides));
        return true;
    }
    std::string* asked = find_axis(options, axis);
    if (asked == nullptr) return false;
    *asked = technique;
    if (axis == "aa") options.samples = 1; // another way to ask for the same
    return true;
}

std::string asked_for(const FrameOptions& options, std::string_view axis) {
    if (axis == "cull") return std::string(kSides[static_cast<std::size_t>(options.cull)]);
    if (axis == "aa" && options.aa == "auto" && options.samples != 1)
        return fmt::format("samples_{}", options.samples);
    const std::string* asked = find_axis(options, axis);
    return asked != nullptr ? *asked : "auto";
}

std::string option_of(std::string_view axis) {
    std::string name(axis);
    std::replace(name.begin(), name.end(), '_', '-');
    return name;
}

} // namespace scanout::frame
