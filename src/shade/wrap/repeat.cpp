// The texture is tiled, as MTL means it (Wavefront 1995): the fraction of u and v counts, and the
// last texel's neighbour is the first. The arithmetic stands in shade/texel-inl.h, inside every
// filter.
#include "shade/stage.h"

namespace scanout::shade::wrap {

extern const Wrapping repeat;
constinit const Wrapping repeat{{.axis = "wrap",
                                 .name = "repeat",
                                 .blurb = "the texture again and again, edge to opposite edge",
                                 .source = "Wavefront 1995",
                                 .kind = Kind::model,
                                 .least = true},
                                Wrap::repeat};

} // namespace scanout::shade::wrap
