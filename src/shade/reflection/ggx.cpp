// A rough surface of tiny mirrors: GGX distribution of their slopes, Smith's masking and shadowing
// with correlated heights, Schlick's Fresnel reflection. Of materials that say roughness (Pr) and
// metalness (Pm): alpha = Pr^2; a metal mirrors its colour, everything else mirrors 4 % straight on
// and scatters the rest. Of others, where the user asks for it: alpha = sqrt(2 / (Ns + 2)), which
// gives a highlight as wide as Blinn-Phong's, and Ks is what is mirrored straight on.
//
// What is scattered has passed the surface twice, so it is dimmed by 1 - F of both directions: that
// keeps it reciprocal, linear in the albedo, and from reflecting more than arrives. Light's
// convention as in blinn_phong_normalised.cpp. Trowbridge and Reitz 1975; Walter et al. 2007; Heitz
// 2014; Schlick 1994.
#include "math/transcendental.h"
#include "shade/stage.h"

#define SIMD_FILE "shade/reflection/ggx.cpp"
#include "simd/for_each_target.h"

#include "shade/reflection/highlight-inl.h"

SIMD_BEGIN(scanout::shade::reflection)

struct Mirrors {
    bool physical;                         // it says roughness or metalness: Ks and Ns do not count
    float metal;                           // share, where no map says it
    alignas(64) float alpha[kPaddedBlock]; // roughness of the distribution
};

SIMD_INLINE float clamped(float x, float low, float high) {
    return x < low ? low : (x > high ? high : x);
}

void find_mirrors(const ShadingBlock& b, Mirrors& out) {
    constexpr float kMinAlpha = 0x1p-9F; // a mirror's image of a point would be a point
    const scene::Material& m = *b.material;
    out.physical = scene::surface_of(m) == scene::Surface::physical;
    out.metal = out.physical ? clamped(scene::metalness_of(m), 0, 1) : 0;
    if (out.physical) {
        const bool mapped = b.map[kRoughnessMap].texture != nullptr;
        const F32 own = scene::roughness_of(m);
        for (int i = 0; i < b.count; i += kLanes) {
            const F32 roughness = mapped ? load<F32>(b.roughness + i) : own;
            store(minimum(maximum(roughness * roughness, F32(kMinAlpha)), F32(1.0F)),
                  out.alpha + i);
        }
        return;
    }
    for_exponents(
        b,
        [](double ns) {
            return clamped(static_cast<float>(scanout::sqrt(2 / (ns + 2))), kMinAlpha, 1);
        },
        out.alpha);
}

// What a surface that is no metal mirrors straight on.
SIMD_INLINE Vec3F32 straight_on(const ShadingBlock& b, const Mirrors& m, int item) {
    if (m.physical) return splat(F32(0.04F));
    const Vec3F32 ks = specular_at(b, item);
    const auto share = [](F32 a) SIMD_LAMBDA { return minimum(maximum(a, F32(0.0F)), F32(1.0F)); };
    return {share(ks.x), share(ks.y), share(ks.z)};
}

SIMD_INLINE F32 metal_at(const ShadingBlock& b, const Mirrors& m, int item) {
    if (!m.physical || b.map[kMetalnessMap].texture == nullptr) return F32(m.metal);
    return minimum(maximum(load<F32>(b.metalness + item), F32(0.0F)), F32(1.0F));
}

// (1 - x)^5
SIMD_INLINE F32 schlick(F32 x) {
    const F32 y = maximum(F32(1.0F) - x, F32(0.0F)), y2 = y * y;
    return (y2 * y2) * y;
}

// pi D V n.l: what mirrors would reflect if each reflected all.
SIMD_INLINE F32 mirrored(const Vec3F32& normal, const Vec3F32& half, F32 half_square, F32 n_e,
                         F32 n_l, F32 alpha2) {
    // 1 - (n.h)^2 as the square of n x h: nothing cancels where the highlight is sharp.
    const F32 sine_square = length_squared(cross(normal, half)), n_h = dot(normal, half);
    const F32 spread = (sine_square + alpha2 * (n_h * n_h)) / half_square;
    const F32 d = maximum(spread, F32(0.5F) * alpha2); // only what is no unit normal is less
    const F32 rest = F32(1.0F) - alpha2;
    const F32 seen = n_l * sqrt(n_e * n_e * rest + alpha2);
    const F32 lit = n_e * sqrt(n_l * n_l * rest + alpha2);
    const F32 all = (alpha2 / (d * d)) * (F32(0.5F) * n_l / (seen + lit));
    return select(n_h > F32(0.0F), all, F32(0.0F));
}

void ggx_run(ShadingBlock& b, const FrameState& frame) {
    if (!b.lit || scene::surface_of(*b.material) == scene::Surface::matt) return diffuse(b, frame);
    Mirrors m;
    find_mirrors(b, m);
    const F32 one = 1.0F;
    const std::size_t light_count = frame.lights.size();
    const Ambient ambient = ambient_of(b);
    for (int i = 0; i < b.count; i += kLanes) {
        const Vec3F32 eye = eye_at(b, frame, i), normal = load_vec3<Vec3F32>(b.normal, i);
        const F32 alpha = load<F32>(m.alpha + i), alpha2 = alpha * alpha;
        const F32 metal = metal_at(b, m, i), other = one - metal;
        const Vec3F32 f0 = straight_on(b, m, i), enters = splat(one) - f0;
        const F32 n_e = minimum(maximum(dot(normal, eye), F32(0x1p-10F)), one);
        const F32 leaves = one - schlick(n_e);
        // Part of the albedo that comes back, and what comes back without it.
        Vec3F32 tinted = ambient_at(b, ambient, i), plain = splat(F32(0.0F));
        for (std::size_t k = 0; k < light_count; ++k) {
            const Light l = light_at(b, frame, k, i);
            const F32 n_l = minimum(maximum(dot(normal, l.towards), F32(0.0F)), one);
            const Vec3F32 half = eye + l.towards;
            const F32 half_square = maximum(length_squared(half), F32(0x1p-40F));
            const F32 all = mirrored(normal, half, half_square, n_e, n_l, alpha2);
            const F32 grazing = schlick(F32(0.5F) * sqrt(half_square)); // e.h = |e + l| / 2
            const F32 scattered = other * (one - schlick(n_l)) * leaves * n_l;
            const Vec3F32 fresnel = f0 + enters * grazing;
            const Vec3F32 of_albedo =
                (enters * enters) * scattered + splat(metal * (one - grazing) * all);
            tinted = tinted + l.colour * of_albedo;
            plain = plain + l.colour * ((fresnel * other + splat(metal * grazing)) * all);
        }
        store_vec3(load_vec3<Vec3F32>(b.albedo, i) * tinted + plain, b.colour, i);
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::reflection {

SIMD_REGISTER(ggx_run);

extern const ReflectionStage ggx;
constinit const ReflectionStage ggx{
    {{.axis = "reflection",
      .name = "ggx",
      .blurb = "rough mirrors, for materials that say roughness and metalness",
      .source = "Trowbridge and Reitz 1975, Walter et al. 2007, Heitz 2014",
      .kind = Kind::model},
     Pass::called,
     {.normal = true, .ray = true},
     [](ShadingBlock& block, const FrameState& frame) { SIMD_CALL(ggx_run, block, frame); }},
    {.physical = true}};

} // namespace scanout::shade::reflection
#endif
