// Alpha test: a sample shows the surface where its alpha, evaluated there, reaches a threshold;
// only then is depth written, so that nothing has to be sorted. Exact where alpha is only 0 or 1,
// also far away: alpha is read from the texture itself, never from a smaller level, so that threads
// and holes finer than a pixel keep their share on average. Elsewhere it errs by the light that it
// leaves out, up to half of any colour. Segal and Akeley 1992, [Primer 1.6].
#include "shade/transparency.h"

namespace scanout::shade::transparency {

extern const Transparency cut_out;
constinit const Transparency cut_out{
    {.axis = "transparency",
     .name = "cut_out",
     .blurb = "a sample shows where its alpha reaches --alpha-cut; nothing is blended",
     .source = "Segal and Akeley 1992, the alpha test",
     .kind = Kind::rung},
    nullptr,
    nullptr,
    true};

} // namespace scanout::shade::transparency
