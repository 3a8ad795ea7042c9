// Multiply: a surface is a filter. Its colour is the part of each channel that passes through it
// from behind: white passes all, black none. The result is never brighter than the light from
// behind; the order of surfaces matters only for rounding. Cabanier and Andronikos 2015, 10.1.2:
// alpha mixes the product with the backdrop; where there is no backdrop, the surface itself shows.
#include "shade/transparency.h"

namespace scanout::shade::blend {

extern const Blend multiply;
constinit const Blend multiply{
    {.axis = "blend",
     .name = "multiply",
     .blurb = "the background times the surface's colour: stained glass, painted shadows",
     .source = "Cabanier and Andronikos 2015",
     .kind = Kind::model},
    nullptr,
    [](float behind, float behind_alpha, float colour, float alpha) {
        // White, black and an opaque background are exact.
        return behind * (1 - alpha * (1 - colour)) + alpha * (1 - behind_alpha) * colour;
    }};

} // namespace scanout::shade::blend
