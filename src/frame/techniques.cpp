#include "frame/techniques.h"

#include "frame/anti_aliasing.h"
#include "frame/stencil.h"
#include "image/convolution.h"
#include "image/dither.h"
#include "raster/coverage/depth_rule.h"
#include "raster/culling/cull.h"
#include "shade/output.h"
#include "shade/sides.h"
#include "shade/stage.h"
#include "shade/transparency.h"

#include <fmt/format.h>

namespace scanout::frame {

const std::vector<const Technique*>& techniques() {
    static const std::vector<const Technique*> all = [] {
        std::vector<const Technique*> found;
        for (const shade::Filter* filter : shade::filters())
            found.push_back(&filter->card);
        for (const shade::Source* source : shade::sources())
            found.push_back(&source->card);
        for (const shade::Wrapping* wrapping : shade::wrappings())
            found.push_back(&wrapping->card);
        for (const shade::Stage* stage : shade::stages())
            found.push_back(&stage->card);
        for (const shade::LitSides* sides : shade::lit_sides())
            found.push_back(&sides->card);
        for (const raster::CullRow* cull : raster::cullings())
            found.push_back(&cull->card);
        for (const raster::DepthFormatRow* format : raster::depth_formats())
            found.push_back(&format->card);
        for (const raster::DepthTestRow* test : raster::depth_tests())
            found.push_back(&test->card);
        for (const shade::Blend* blend : shade::blends())
            found.push_back(&blend->card);
        for (const Stencil* stencil : stencils())
            found.push_back(&stencil->card);
        for (const shade::Transparency* transparency : shade::transparencies())
            found.push_back(&transparency->card);
        for (const AntiAliasing* aa : anti_aliasings())
            found.push_back(&aa->card);
        for (const image::Convolution* convolution : image::convolutions())
            found.push_back(&convolution->card);
        for (const shade::BlendSpace* space : shade::blend_spaces())
            found.push_back(&space->card);
        for (const shade::Encoding* encoding : shade::encodings())
            found.push_back(&encoding->card);
        for (const image::Dither* dither : image::dithers())
            found.push_back(&dither->card);
        return found;
    }();
    return all;
}

shade::Attributes reads(const Technique& technique) {
    for (const shade::Stage* stage : shade::stages())
        if (&stage->card == &technique) return stage->needs;
    for (const shade::Filter* filter : shade::filters())
        if (&filter->card == &technique) return filter->needs;
    return {};
}

std::string names_of(std::string_view axis) {
    std::string names;
    for (const Technique* technique : techniques())
        if (technique->axis == axis) names += fmt::format(" {}", technique->name);
    return names;
}

} // namespace scanout::frame
