// The texture that the material names, read from its file.
#include "shade/stage.h"

namespace scanout::shade::source {

extern const Source image;
constinit const Source image{{.axis = "source",
                              .name = "image",
                              .blurb = "the picture that the material names",
                              .source = "[A 11.2], [C 9.3]",
                              .kind = Kind::model},
                             {},
                             nullptr};

} // namespace scanout::shade::source
