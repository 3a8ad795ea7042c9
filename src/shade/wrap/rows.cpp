// Wrap modes, beyond the edges of a texture. The arithmetic is in shade/mip/texel-inl.h.
#include "rows.h"

#include "shade/stage.h"

namespace scanout::shade::wrap {

namespace {

constexpr Technique card(std::string_view name, std::string_view blurb, std::string_view source,
                         bool least = false) {
    return {"wrap", name, blurb, source, Kind::model, least};
}

} // namespace

// The texture repeats, as MTL means it (Wavefront 1995): only the fraction of u and v counts, and
// the last texel's neighbour is the first.
constinit const Wrapping repeat{
    card("repeat", "the texture again and again, edge to opposite edge", "Wavefront 1995", true),
    Wrap::repeat};

// The texture repeats, and every second tile is mirrored, so that any picture joins itself.
constinit const Wrapping mirror{
    card("mirror", "every second tile is turned round: no seam", "Microsoft 2015, 7.18.9"),
    Wrap::mirror};

// Beyond an edge the edge's texel repeats: -clamp on of MTL (Wavefront 1995).
constinit const Wrapping clamp{
    card("clamp", "beyond an edge the edge's texel goes on", "Wavefront 1995, -clamp on"),
    Wrap::clamp};

} // namespace scanout::shade::wrap
