#include "frame/catalogue.h"

#include "base/check.h"
#include "frame/anti_aliasing.h"
#include "frame/edges.h"
#include "frame/render_scale.h"
#include "frame/stencil.h"
#include "image/convolution.h"
#include "image/dither.h"
#include "raster/coverage/depth_rule.h"
#include "raster/culling/cull.h"
#include "rows.h"
#include "shade/ambient_occlusion.h"
#include "shade/colour_by.h"
#include "shade/resolve/output.h"
#include "shade/sides.h"
#include "shade/stage.h"
#include "shade/transparency.h"

#include <type_traits>

#include <fmt/format.h>

namespace scanout::frame {

const std::vector<const Technique*>& techniques() {
    static const std::vector<const Technique*> all = [] {
        std::vector<const Technique*> found;
#define SCANOUT_ADD(module, axis, LIST, Row, choice, help)                                         \
    for (const module::Row* row : module::axis::kRows)                                             \
        found.push_back(&row->card);
        SCANOUT_AXES(SCANOUT_ADD)
#undef SCANOUT_ADD
        return found;
    }();
    return all;
}

shade::Attributes reads(const Technique& technique) {
    for (const shade::Stage* stage : shade::stages())
        if (&stage->card == &technique) return stage->needs;
    for (const shade::Filter* filter : shade::texture::kRows)
        if (&filter->card == &technique) return filter->needs;
    return {};
}

std::vector<std::string_view> names_on(std::string_view axis) {
    std::vector<std::string_view> names;
    for (const Technique* technique : techniques())
        if (technique->axis == axis) names.push_back(technique->name);
    return names;
}

std::string_view first_on(std::string_view axis) {
    for (const Technique* technique : techniques())
        if (technique->axis == axis) return technique->name;
    CHECK(false && "an axis without techniques");
    return {};
}

} // namespace scanout::frame
