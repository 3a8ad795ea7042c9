// Mixes samples in linear light, as light itself mixes, and encodes the mean once (HARD-CASES 70).
#include "shade/resolve/output.h"

namespace scanout::shade::blend_space {

extern const BlendSpace linear;
constinit const BlendSpace linear{{.axis = "blend_space",
                                   .name = "linear",
                                   .blurb = "samples are mixed in linear light, then encoded",
                                   .source = "Porter and Duff 1984; Gritz and d'Eon 2007",
                                   .kind = Kind::rung},
                                  nullptr,
                                  nullptr};

} // namespace scanout::shade::blend_space
