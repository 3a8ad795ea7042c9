// Multiply: a surface is a filter. Its colour says which part of each channel of what lies behind
// it lets pass: white all, black none. Never brighter than what lies behind; the order of surfaces
// does not matter but for rounding. Cabanier and Andronikos 2015, 10.1.2: alpha mixes the product
// with what was there; where nothing is, the surface itself shows.
#include "shade/transparency.h"

namespace scanout::shade::blend {

extern const Blend multiply;
constinit const Blend multiply{
    {.axis = "blend",
     .name = "multiply",
     .blurb = "what lies behind times its colour: stained glass, shadows painted on",
     .source = "Cabanier and Andronikos 2015",
     .kind = Kind::model},
    nullptr,
    [](float behind, float behind_alpha, float colour, float alpha) {
        // White, black and an opaque background are exact.
        return behind * (1 - alpha * (1 - colour)) + alpha * (1 - behind_alpha) * colour;
    }};

} // namespace scanout::shade::blend
