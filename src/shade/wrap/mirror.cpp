// The texture is tiled, every second tile turned round, so that any picture joins itself. The
// arithmetic stands in shade/texel-inl.h, inside every filter.
#include "shade/stage.h"

namespace scanout::shade::wrap {

extern const Wrapping mirror;
constinit const Wrapping mirror{{.axis = "wrap",
                                 .name = "mirror",
                                 .blurb = "every second tile is turned round: no seam",
                                 .source = "Microsoft 2015, 7.18.9",
                                 .kind = Kind::model},
                                Wrap::mirror};

} // namespace scanout::shade::wrap
