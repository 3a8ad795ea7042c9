// Clamp: light above 1 becomes 1 where codes are made, so no stage runs for it.
#include "shade/stage.h"

namespace scanout::shade::tone {

extern const ToneStage clamp;
constinit const ToneStage clamp{{{.axis = "tone",
                                  .name = "clamp",
                                  .blurb = "light above 1 is cut off, all below is exact",
                                  .source = "Microsoft 2015, 3.2.3.6",
                                  .kind = Kind::model,
                                  .least = true},
                                 Pass::tone,
                                 {},
                                 nullptr},
                                {}};

} // namespace scanout::shade::tone
