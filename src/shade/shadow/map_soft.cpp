// Soft shadows from one map (PCSS): a search finds the blocker nearest to the receiver, its
// distance gives the penumbra's width, and a disc (a square light: a square) of that width is
// filtered. Fernando 2005. Unlike there, only blockers between the receiver and some point of the
// light count: a wall that leans away from the receiver would else widen the penumbra by its far
// end, and let light through beside its near one. A light without size, and penumbrae narrower than
// the filter of map_pcf, give the bits of map_pcf. Its parts: this kernel, and the pass that draws
// the map (frame/pass/shadow_maps.h).
#include "shade/stage.h"

#define SIMD_FILE "shade/shadow/map_soft.cpp"
#include "simd/for_each_target.h"

#include "shade/shadow/map-inl.h"

SIMD_BEGIN(scanout::shade::shadow)

// A Fibonacci lattice on the square from -1 to 1: for a shadow edge of any direction, the points
// lie at distances from it that are all different and nearly even, so no bands show. Niederreiter
// 1992, ch. 5.
struct Lattice {
    static constexpr int kPoints = 89, kStep = 55;
    float x[kPoints]{}, y[kPoints]{};
    int count = 0;
    constexpr explicit Lattice(bool disc) {
        for (int i = 0; i < kPoints; ++i) {
            const double u = (2.0 * i + 1) / kPoints - 1;
            const double v = (2.0 * (i * kStep % kPoints) + 1) / kPoints - 1;
            if (disc && u * u + v * v > 1) continue;
            x[count] = static_cast<float>(u);
            y[count] = static_cast<float>(v);
            ++count;
        }
    }
};
constexpr Lattice kSquare(false), kDisc(true);

// The search must see a penumbra of two texels as well as one of two hundred, so its points are
// denser near the middle: their distances from it are squared.
constexpr Lattice drawn_in(const Lattice& even) {
    Lattice points = even;
    for (int i = 0; i < points.count; ++i) {
        const float x = points.x[i], y = points.y[i], ax = x < 0 ? -x : x, ay = y < 0 ? -y : y;
        const float far = ax > ay ? ax : ay;
        points.x[i] = x * far;
        points.y[i] = y * far;
    }
    return points;
}
constexpr Lattice kSquareSearch = drawn_in(kSquare), kDiscSearch = drawn_in(kDisc);

// The penumbra's radius, at most the map's half side.
SIMD_INLINE F32 radius(const ShadowMap& m, float texels, F32 depth) {
    return minimum(F32(texels) * maximum(depth, F32(0.0F)), F32(m.half));
}

// Is an occluder at this offset and depth in front of the light? One texel more each way, because
// it may stand anywhere in its texel.
SIMD_INLINE Mask<F32::Tag> before_light(const ShadowMap& m, bool square, F32 dx, F32 dy,
                                        F32 depth) {
    const F32 one = 1.0F, x = dx / (radius(m, m.soft_x, depth) + one),
              y = dy / (radius(m, m.soft_y, depth) + one);
    return square ? (abs(x) <= one) & (abs(y) <= one) : x * x + y * y <= one;
}

constexpr float kNone = 0x1p100F; // nothing hides the receiver

SIMD_INLINE F32 hidden_soft(const ShadowMap& m, const Receiver& r, const LightShadow& shadow,
                            int filter) {
    const F32 sharp = hidden_square(m, r, filter);
    if (!shadow.soft) return sharp;
    const bool square = shadow.shape == scene::LightShape::square;
    const Lattice& lattice = square ? kSquare : kDisc;
    const Lattice& search = square ? kSquareSearch : kDiscSearch;
    // The search radius: no blocker stands farther from the receiver than the one nearest to the
    // light.
    const F32 most = F32(m.nearest) - r.depth;
    const F32 search_x = radius(m, m.soft_x, most), search_y = radius(m, m.soft_y, most);
    F32 lowest = kNone;
    for (int i = 0; i < search.count; ++i) {
        const F32 dx = search_x * F32(search.x[i]), dy = search_y * F32(search.y[i]);
        const Texel t = texel_at(m, r, dx, dy);
        const F32 above = t.depth - r.depth;
        const auto hides = (t.depth > t.own) & before_light(m, square, dx, dy, above);
        lowest = minimum(lowest, select(hides, above, F32(kNone)));
    }
    const F32 wide_x = radius(m, m.soft_x, lowest), wide_y = radius(m, m.soft_y, lowest);
    const auto wide =
        (lowest < F32(kNone)) & (maximum(wide_x, wide_y) > F32(0.5F * static_cast<float>(filter)));
    if (!any(wide)) return sharp;
    // A point of the light behind the receiver's plane does not light it. What is at least half
    // as high as the nearest blocker is one, too, whatever is forgiven (Receiver): under a grazing
    // light that grows with the distance, up to any blocker's height.
    const F32 one = 1.0F, zero = 0.0F;
    F32 hides = 0.0F, shines = 0.0F;
    for (int i = 0; i < lattice.count; ++i) {
        const F32 dx = wide_x * F32(lattice.x[i]), dy = wide_y * F32(lattice.y[i]);
        const auto above = r.per_x * dx + r.per_y * dy <= lowest;
        shines = shines + select(above, one, zero);
        const Texel t = texel_at(m, r, dx, dy);
        const auto stands_in =
            (t.depth > t.own) | ((t.depth > t.plane) & (t.depth - r.depth >= lowest * F32(0.5F)));
        hides = hides + select(above & stands_in, one, zero);
    }
    return select(wide, hides / maximum(shines, one), sharp);
}

void map_soft_run(ShadingBlock& b, const FrameState& frame) {
    const int k = frame.shadow_filter;
    shadow_by_maps(b, frame,
                   [k](const ShadowMap& m, const Receiver& r, const LightShadow& shadow)
                       SIMD_LAMBDA { return hidden_soft(m, r, shadow, k); });
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::shadow {

SIMD_REGISTER(map_soft_run);

extern const ShadowStage map_soft;
constinit const ShadowStage map_soft{
    {{.axis = "shadow",
      .name = "map_soft",
      .blurb = "penumbrae as wide as the light's size and the distance "
               "make them",
      .source = "Fernando 2005",
      .kind = Kind::rung},
     Pass::shadow,
     {.position = true, .facing = true},
     [](ShadingBlock& block, const FrameState& frame) { SIMD_CALL(map_soft_run, block, frame); }},
    {.by = ShadowBy::maps, .filtered = true, .soft = true}};

} // namespace scanout::shade::shadow
#endif
