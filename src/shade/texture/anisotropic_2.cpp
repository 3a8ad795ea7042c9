// Anisotropic filtering with up to 2 probes along the pixel's footprint (shade/anisotropy.h).
#include "shade/anisotropy.h"

namespace scanout::shade::texture {

extern const Filter anisotropic_2;
constinit const Filter anisotropic_2{
    {.axis = "texture",
     .name = "anisotropic_2",
     .blurb = "up to 2 trilinear probes along a slanted pixel's footprint",
     .source = "Heckbert 1989, McCormack et al. 1999",
     .kind = Kind::rung},
    {.uv = true, .footprint = true},
    [](Block& block, const BoundMap& map, TexelKind kind) {
        sample_anisotropic(block, map, kind, 2);
    }};

} // namespace scanout::shade::texture
