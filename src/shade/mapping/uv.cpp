// The model's own coordinates: the interpolation stage writes them, and no mapping stage runs.
#include "shade/stage.h"

namespace scanout::shade::mapping {

extern const Stage uv;
constinit const Stage uv{{.axis = "mapping",
                          .name = "uv",
                          .blurb = "the coordinates that the model gives",
                          .source = "Catmull 1974",
                          .kind = Kind::model},
                         Pass::mapping,
                         {},
                         nullptr};

} // namespace scanout::shade::mapping
