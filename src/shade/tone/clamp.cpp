// What is brighter than 1 becomes 1 where codes are made: no stage runs for it.
#include "shade/stage.h"

namespace scanout::shade::tone {

extern const Stage clamp;
constinit const Stage clamp{{.axis = "tone",
                             .name = "clamp",
                             .blurb = "light above 1 is cut off, all below is exact",
                             .source = "Microsoft 2015, 3.2.3.6",
                             .kind = Kind::model},
                            {},
                            [](Block& /*block*/, const FrameState& /*frame*/) {}};

} // namespace scanout::shade::tone
