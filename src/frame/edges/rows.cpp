// Which edges are drawn over the shading; frame/pass/annotations.h draws them.
#include "rows.h"

#include "frame/edges.h"

namespace scanout::frame::edges {

static constexpr Edges row(std::string_view name, std::string_view blurb, std::string_view source,
                           Edges::Of of) {
    return {{.axis = "edges", .name = name, .blurb = blurb, .source = source, .kind = Kind::model},
            of};
}

constinit const Edges none{
    row("none", "no edges are drawn", "Segal and Akeley 1992", Edges::Of::nothing)};
constinit const Edges feature{
    row("feature",
        "the edges at which the surface ends or bends by more than --edge-angle, where they are "
        "visible",
        "Gooch and Gooch 2001", Edges::Of::features)};
constinit const Edges all{row("all", "every edge of a face of the file, where it is visible",
                              "Segal and Akeley 1992", Edges::Of::faces)};

} // namespace scanout::frame::edges
