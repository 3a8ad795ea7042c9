// Anisotropic filtering with up to 16 probes along the pixel's footprint (shade/anisotropy.h).
#include "shade/anisotropy.h"

namespace scanout::shade::texture {

extern const Filter anisotropic_16;
constinit const Filter anisotropic_16{
    {.axis = "texture",
     .name = "anisotropic_16",
     .blurb = "up to 16 trilinear probes along a slanted pixel's footprint",
     .source = "Heckbert 1989, McCormack et al. 1999",
     .kind = Kind::rung},
    {.uv = true, .footprint = true},
    [](Block& block, const BoundMap& map, TexelKind kind) {
        sample_anisotropic(block, map, kind, 16);
    }};

} // namespace scanout::shade::texture
