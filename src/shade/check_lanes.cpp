#include "shade/check_lanes.h"

#ifdef SCANOUT_CHECK_LANES
#include "base/check.h"

#include <cmath>
#include <string_view>

namespace scanout::shade {
namespace {

void check(const float* lanes, int count, std::string_view what, const Stage& stage) {
    for (int i = 0; i < count; ++i)
        if (!std::isfinite(lanes[i]))
            check_failed(__FILE__, __LINE__, "every live lane is finite",
                         fmt::format("{} of lane {} is {} after {} {}", what, i, lanes[i],
                                     stage.card.axis, stage.card.name));
}

} // namespace

void check_lanes(const Block& b, const FrameState& frame, const Stage& stage) {
    for (int c = 0; c < 3; ++c) {
        check(b.albedo[c], b.count, "albedo", stage);
        if (b.lit && frame.attributes.normal) check(b.normal[c], b.count, "normal", stage);
        if (b.lit && frame.attributes.position) check(b.position[c], b.count, "position", stage);
        if (stage.card.axis == "reflection") check(b.colour[c], b.count, "colour", stage);
    }
    if (b.lit && frame.attributes.ray) {
        check(b.ray_x, b.count, "ray x", stage);
        check(b.ray_y, b.count, "ray y", stage);
    }
    if (b.map[kDiffuseMap].texture != nullptr) {
        check(b.u, b.count, "u", stage);
        check(b.v, b.count, "v", stage);
    }
}

} // namespace scanout::shade
#endif
