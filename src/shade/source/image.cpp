// The texture that the material names, read from its file. [Compendium 11.2], [Primer 9.3].
#include "shade/stage.h"

namespace scanout::shade::source {

extern const Source image;
constinit const Source image{{.axis = "source",
                              .name = "image",
                              .blurb = "the picture that the material names",
                              .source = "Catmull 1974",
                              .kind = Kind::model},
                             {},
                             nullptr};

} // namespace scanout::shade::source
