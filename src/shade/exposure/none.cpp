// Exposure "none": light is shown as it is. No stage runs for it.
#include "shade/stage.h"

namespace scanout::shade::exposure {

extern const Stage none;
constinit const Stage none{{.axis = "exposure",
                            .name = "none",
                            .blurb = "light is shown as bright as it is",
                            .source = "Wavefront 1995",
                            .kind = Kind::effect},
                           Pass::exposure,
                           {},
                           nullptr};

} // namespace scanout::shade::exposure
