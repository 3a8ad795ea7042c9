// Screen: the opposite of a filter. Multiplies the differences from white: 1 - (1 - a)(1 - b), as
// two projectors on one screen that cannot exceed white. The result is never darker than the
// backdrop, and black changes nothing; the order of surfaces matters only for rounding. Cabanier
// and Andronikos 2015, 10.1.3: only alpha times colour of the surface counts, whatever the
// backdrop's alpha.
#include "shade/transparency.h"

namespace scanout::shade::blend {

extern const Blend screen;
constinit const Blend screen{
    {.axis = "blend",
     .name = "screen",
     .blurb = "the inverses of both colours multiplied: brighter, never above white",
     .source = "Cabanier and Andronikos 2015",
     .kind = Kind::model},
    nullptr,
    [](float behind, float /*behind_alpha*/, float colour, float alpha) {
        return behind + alpha * colour * (1 - behind); // black is exact
    }};

} // namespace scanout::shade::blend
