#include "shade/check_lanes.h"

#ifdef SCANOUT_CHECK_LANES
#include "base/check.h"

#include <cmath>
#include <string>
#include <string_view>

namespace scanout::shade {
namespace {

void check(const float* lanes, std::size_t count, std::string_view what, std::string_view stage) {
    for (std::size_t i = 0; i < count; ++i)
        if (!std::isfinite(lanes[i]))
            check_failed(__FILE__, __LINE__, "every live lane is finite",
                         fmt::format("{} of lane {} is {} after {}", what, i, lanes[i], stage));
}

// What a stage of the axis light writes: the lights of its kind that vary.
void check_light(const Block& b, const FrameState& frame, std::string_view kind,
                 std::string_view stage) {
    for (std::size_t k = 0; k < frame.varies.size(); ++k) {
        if (!frame.varies[k] || name_of(frame.lights[k].kind) != kind) continue;
        for (int c = 0; c < 3; ++c) {
            check(b.light[k].towards[c], static_cast<std::size_t>(b.count), "direction", stage);
            check(b.light[k].colour[c], static_cast<std::size_t>(b.count), "light", stage);
        }
    }
}

} // namespace

void check_rays(const Block& b, const FrameState& frame) {
    if (!b.lit || !frame.attributes.ray) return;
    const auto count = static_cast<std::size_t>(b.count);
    check(b.ray_x, count, "ray x", "place_lanes");
    check(b.ray_y, count, "ray y", "place_lanes");
}

void check_lanes(const Block& b, const FrameState& frame, const Stage& stage) {
    const std::string name = fmt::format("{} {}", stage.card.axis, stage.card.name);
    const auto count = static_cast<std::size_t>(b.count);
    for (int c = 0; c < 3; ++c) {
        check(b.albedo[c], count, "albedo", name);
        if (b.lit && frame.attributes.normal) check(b.normal[c], count, "normal", name);
        if (b.lit && stage.card.axis == "map" && stage.card.name == "emission")
            check(b.colour[c], count, "colour", name);
        if (b.lit && frame.attributes.position) check(b.position[c], count, "position", name);
        if (stage.card.axis == "shading" || stage.card.axis == "tone")
            check(b.colour[c], count, "colour", name);
    }
    if (stage.card.name == "gloss" && b.map[kShininessMap].texture != nullptr)
        check(b.shininess, count, "exponent", name);
    if (b.lit && stage.card.axis == "light") check_light(b, frame, stage.card.name, name);
    if (!wants_uv(b, frame)) return;
    check(b.u, count, "u", name);
    check(b.v, count, "v", name);
    if (frame.attributes.footprint)
        for (const float* slope : {b.u_x, b.v_x, b.u_y, b.v_y})
            check(slope, count, "slope of u or v", name);
    if (stage.card.axis != "map") return;
    if (stage.card.name == "opacity") return check(b.alpha, count, "alpha", name);
    // Where one number counts, it may be the sample's alpha alone.
    if (stage.card.name == "gloss" || stage.card.name == "bump") return;
    for (int c = 0; c < 3; ++c)
        check(b.sampled[c], count, "sampled", name);
}

void check_sums(const PixelSums& sums, std::size_t count) {
    for (const auto* channel : {&sums.red, &sums.green, &sums.blue})
        check(channel->data(), count, "sum", "the sums of samples");
}

} // namespace scanout::shade
#endif
