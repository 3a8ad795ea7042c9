// No blending: at each sample the nearest surface shows, as if it were opaque.
#include "shade/transparency.h"

namespace scanout::shade::blend {

extern const Blend none;
constinit const Blend none{{.axis = "blend",
                            .name = "none",
                            .blurb = "nothing is mixed: the nearest surface is shown whole",
                            .source = "Segal and Akeley 1992",
                            .kind = Kind::model},
                           [](float /*alpha*/, float transmittance) -> Blend::Weights {
                               return {transmittance, 0};
                           },
                           nullptr,
                           Hides::always};

} // namespace scanout::shade::blend
