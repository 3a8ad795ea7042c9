// Beyond an edge the edge's texel goes on: -clamp on of MTL (Wavefront 1995). The arithmetic stands
// in shade/texel-inl.h, inside every filter.
#include "shade/stage.h"

namespace scanout::shade::wrap {

extern const Wrapping clamp;
constinit const Wrapping clamp{{.axis = "wrap",
                                .name = "clamp",
                                .blurb = "beyond an edge the edge's texel goes on",
                                .source = "Wavefront 1995, -clamp on",
                                .kind = Kind::model},
                               Wrap::clamp};

} // namespace scanout::shade::wrap
