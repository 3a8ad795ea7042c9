// No marks: no buffer is made.
#include "frame/stencil.h"

namespace scanout::frame::stencil {

extern const Stencil none;
constinit const Stencil none{{.axis = "stencil",
                              .name = "none",
                              .blurb = "nothing is marked",
                              .source = "Segal and Akeley 1992",
                              .kind = Kind::model}};

} // namespace scanout::frame::stencil
