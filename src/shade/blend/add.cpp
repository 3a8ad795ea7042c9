// Additive blending: the surface's light times its alpha is added, nothing behind it is dimmed, so
// the order does not matter. A transparent background stays transparent.
#include "shade/transparency.h"

namespace scanout::shade::blend {

extern const Blend add;
constinit const Blend add{{.axis = "blend",
                           .name = "add",
                           .blurb = "its light is added, nothing is taken: flames, sparks",
                           .source = "Porter and Duff 1984",
                           .kind = Kind::model},
                          [](float alpha, float transmittance) -> Blend::Weights {
                              return {transmittance * alpha, transmittance};
                          }};

} // namespace scanout::shade::blend
