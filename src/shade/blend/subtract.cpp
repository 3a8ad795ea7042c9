// Subtractive blending: the surface's light times its alpha is subtracted from the light behind, in
// any order; results below black are black.
#include "shade/transparency.h"

namespace scanout::shade::blend {

extern const Blend subtract;
constinit const Blend subtract{{.axis = "blend",
                                .name = "subtract",
                                .blurb = "its light is taken away, not below black",
                                .source = "Microsoft 2015, 17",
                                .kind = Kind::model},
                               [](float alpha, float transmittance) -> Blend::Weights {
                                   return {transmittance * -alpha, transmittance};
                               }};

} // namespace scanout::shade::blend
