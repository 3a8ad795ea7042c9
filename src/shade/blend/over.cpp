// Over: a surface shows by its alpha, the surfaces behind it by 1 - alpha. Porter and Duff 1984,
// [Primer 1.6].
#include "shade/transparency.h"

namespace scanout::shade::blend {

extern const Blend over;
constinit const Blend over{{.axis = "blend",
                            .name = "over",
                            .blurb = "alpha of the surface, the rest of the background",
                            .source = "Porter and Duff 1984",
                            .kind = Kind::model},
                           [](float alpha, float transmittance) -> Blend::Weights {
                               return {transmittance * alpha, transmittance * (1 - alpha)};
                           },
                           nullptr,
                           Hides::by_alpha};

} // namespace scanout::shade::blend
