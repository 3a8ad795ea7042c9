// False colours in place of light. Of all but depth a triangle has one colour, which the frame
// finds before (frame/pass/triangle_colours.h). Their codes in the picture are exact: the stages
// write the light that has the code.
#include "rows.h"

#include "math/srgb.h"
#include "shade/colour_by.h"

#include <algorithm>

namespace scanout::shade::colour_by {
namespace {

using Of = ColourByTraits::Of;

// Lines and points keep their colour.
bool copy_unlit(ShadingBlock& b) {
    if (b.lit) return false;
    for (int c = 0; c < 3; ++c)
        std::copy_n(b.albedo[c], b.count, b.colour[c]);
    return true;
}

void colour_triangles(ShadingBlock& b, const FrameState& frame) {
    if (copy_unlit(b)) return;
    for (int r = 0; r < b.runs; ++r) {
        const Run& run = b.run[r];
        const Vec3& colour = frame.triangle_colours[run.primitive->id];
        for (int c = 0; c < 3; ++c)
            std::fill_n(b.colour[c] + run.first, run.count, colour[c]);
    }
}

// White at the nearest point of the model's box, black at the farthest; codes fall evenly.
void colour_depth(ShadingBlock& b, const FrameState& frame) {
    if (copy_unlit(b)) return;
    for (int i = 0; i < b.count; ++i) {
        const float nearness = (frame.farthest + b.position[2][i]) * frame.codes_a_unit;
        const float code = std::min(std::max(nearness, 0.0F), 255.0F);
        const float grey = srgb_decode(static_cast<std::uint8_t>(code + 0.5F));
        for (auto& channel : b.colour)
            channel[i] = grey;
    }
}

constexpr ColourBy row(std::string_view name, std::string_view blurb, std::string_view source,
                       const Attributes& needs,
                       void (*run)(ShadingBlock& block, const FrameState& frame), Of of) {
    return {
        {{.axis = "colour_by", .name = name, .blurb = blurb, .source = source, .kind = Kind::model},
         Pass::shading,
         needs,
         run},
        {of}};
}
constexpr ColourBy of_triangles(std::string_view name, std::string_view blurb,
                                std::string_view source, Of of) {
    return row(name, blurb, source, {.primitive = true}, colour_triangles, of);
}

} // namespace

constinit const ColourBy light{
    row("light", "surfaces in the light", "Foley et al. 1990", {}, nullptr, Of::light)};
constinit const ColourBy normal{
    of_triangles("normal",
                 "the direction in which a face looks: along x, y, z of the file as red, green, "
                 "blue, 128 is none",
                 "Saito and Takahashi 1990", Of::normal)};
constinit const ColourBy depth{row("depth", "distance: white is near, black is far",
                                   "Saito and Takahashi 1990", {.position = true}, colour_depth,
                                   Of::depth)};
constinit const ColourBy side{of_triangles("side",
                                           "which side of a face is seen: fronts blue, backs red",
                                           "Saito and Takahashi 1990", Of::side)};
constinit const ColourBy material{of_triangles("material",
                                               "a colour for each material, grey for none",
                                               "Saito and Takahashi 1990", Of::material)};
constinit const ColourBy part{of_triangles("part",
                                           "a colour for each part: faces that are connected",
                                           "Saito and Takahashi 1990", Of::part)};

} // namespace scanout::shade::colour_by
