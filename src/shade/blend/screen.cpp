// Screen: the opposite of a filter. What both lack of white is multiplied: 1 - (1 - a)(1 - b), as
// two projectors on one screen that cannot be brighter than white. Never darker than what lies
// behind, black changes nothing; the order of surfaces does not matter but for rounding. Cabanier
// and Andronikos 2015, 10.1.3: of the surface only its alpha times its colour counts, whatever
// alpha lies behind.
#include "shade/transparency.h"

namespace scanout::shade::blend {

extern const Blend screen;
constinit const Blend screen{
    {.axis = "blend",
     .name = "screen",
     .blurb = "what both lack of white is multiplied: light that never exceeds white",
     .source = "Cabanier and Andronikos 2015",
     .kind = Kind::model},
    nullptr,
    [](float behind, float /*behind_alpha*/, float colour, float alpha) {
        return behind + alpha * colour * (1 - behind); // black is exact
    }};

} // namespace scanout::shade::blend
