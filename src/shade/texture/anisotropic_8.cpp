// Anisotropic filtering with up to 8 probes along the pixel's footprint (shade/anisotropy.h).
#include "shade/anisotropy.h"

namespace scanout::shade::texture {

extern const Filter anisotropic_8;
constinit const Filter anisotropic_8{
    {.axis = "texture",
     .name = "anisotropic_8",
     .blurb = "up to 8 trilinear probes along a slanted pixel's footprint",
     .source = "Heckbert 1989, McCormack et al. 1999",
     .kind = Kind::rung},
    {.uv = true, .footprint = true},
    [](Block& block, const BoundMap& map, TexelKind kind) {
        sample_anisotropic(block, map, kind, 8);
    }};

} // namespace scanout::shade::texture
