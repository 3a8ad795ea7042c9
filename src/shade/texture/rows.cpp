// Anisotropic filtering with a given number of probes along the pixel's footprint. The arithmetic
// is in shade/mip/anisotropy.h.
#include "rows.h"

#include "shade/mip/anisotropy.h"

namespace scanout::shade::texture {

namespace {

constexpr Technique card(std::string_view name, std::string_view blurb,
                         LadderException may_err_more = {}) {
    return {"texture",  name,  blurb,       "Heckbert 1989, McCormack et al. 1999",
            Kind::rung, false, may_err_more};
}

} // namespace

constinit const Filter anisotropic_2{
    card("anisotropic_2", "up to 2 trilinear probes along a slanted pixel's footprint",
         {"bilinear", "it blurs as trilinear does, half as far along slanted surfaces"}),
    {.uv = true, .footprint = true},
    [](ShadingBlock& block, const BoundMap& map, TexelKind kind) {
        sample_anisotropic(block, map, kind, 2);
    }};

constinit const Filter anisotropic_4{
    card("anisotropic_4", "up to 4 trilinear probes along a slanted pixel's footprint"),
    {.uv = true, .footprint = true},
    [](ShadingBlock& block, const BoundMap& map, TexelKind kind) {
        sample_anisotropic(block, map, kind, 4);
    }};

constinit const Filter anisotropic_8{
    card("anisotropic_8", "up to 8 trilinear probes along a slanted pixel's footprint"),
    {.uv = true, .footprint = true},
    [](ShadingBlock& block, const BoundMap& map, TexelKind kind) {
        sample_anisotropic(block, map, kind, 8);
    }};

constinit const Filter anisotropic_16{
    card("anisotropic_16", "up to 16 trilinear probes along a slanted pixel's footprint"),
    {.uv = true, .footprint = true},
    [](ShadingBlock& block, const BoundMap& map, TexelKind kind) {
        sample_anisotropic(block, map, kind, 16);
    }};

} // namespace scanout::shade::texture
