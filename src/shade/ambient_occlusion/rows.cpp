// Rungs of ambient occlusion in screen space: how many directions a pixel looks in for what hides
// the light from everywhere, and how often in each. The method is the same: horizon.h.
#include "rows.h"

#include "shade/ambient_occlusion.h"
#include "shade/ambient_occlusion/attenuate.h"

namespace scanout::shade::ambient_occlusion {

static constexpr AmbientOcclusion horizons(std::string_view name, std::string_view blurb,
                                           int directions, int steps) {
    return {{{.axis = "ambient_occlusion",
              .name = name,
              .blurb = blurb,
              .source = "Bavoil et al. 2008; Jimenez et al. 2016",
              .kind = Kind::rung},
             Pass::shadow,
             {.position = true},
             attenuate},
            {directions, steps}};
}

constinit const AmbientOcclusion none{{{.axis = "ambient_occlusion",
                                        .name = "none",
                                        .blurb = "nothing keeps off the light from everywhere",
                                        .source = "Foley et al. 1990, ch. 16",
                                        .kind = Kind::rung},
                                       Pass::shadow,
                                       {},
                                       nullptr},
                                      {}};
constinit const AmbientOcclusion gtao_4{
    horizons("gtao_4", "by the horizon in 4 directions on the screen", 4, 4)};
constinit const AmbientOcclusion gtao_8{
    horizons("gtao_8", "by the horizon in 8 directions on the screen", 8, 6)};
constinit const AmbientOcclusion gtao_16{
    horizons("gtao_16", "by the horizon in 16 directions on the screen", 16, 8)};

} // namespace scanout::shade::ambient_occlusion
