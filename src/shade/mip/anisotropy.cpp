// Anisotropic filtering: a pixel seen through a slanted surface is an ellipse on the texture:
// Heckbert 1989. Probes as wide as its minor axis are laid in a line along the major one: McCormack
// et al. 1999. Where the ellipse is longer than the probes reach, the probes grow until they reach.
#include "shade/mip/anisotropy.h"

#define SIMD_FILE "shade/mip/anisotropy.cpp"
#include "simd/for_each_target.h"

#include "shade/mip/mip-inl.h"

SIMD_BEGIN(scanout::shade::texture)

struct Probes {
    F32 count, level;
    F32 along_x, along_y; // from the first probe to the last, in texels
};

// The axes of the ellipse that the slopes' columns span: eigenvectors of J J^T.
SIMD_INLINE Probes probes_of(const UvSlopes<F32::Tag>& slopes, float most, float last) {
    const auto bounded = [](F32 x) SIMD_LAMBDA { // its fourth power is a float; NaN: the bound
        return minimum(maximum(x, F32(-0x1p30F)), F32(0x1p30F));
    };
    const F32 u_x = bounded(slopes.u_x), v_x = bounded(slopes.v_x);
    const F32 u_y = bounded(slopes.u_y), v_y = bounded(slopes.v_y);
    const F32 a = u_x * u_x + u_y * u_y, b = u_x * v_x + u_y * v_y, c = v_x * v_x + v_y * v_y;
    const F32 half = (a - c) * F32(0.5F);
    const F32 root = sqrt(half * half + b * b);
    const F32 largest = (a + c) * F32(0.5F) + root; // eigenvalue
    // Of the two expressions for the eigenvector, takes the one without cancellation.
    const auto wide = half > F32(0.0F);
    const F32 x = select(wide, half + root, b), y = select(wide, b, root - half);
    const F32 length = sqrt(x * x + y * y);
    const F32 major = sqrt(largest);
    const F32 minor = abs(u_x * v_y - u_y * v_x) / select(major > F32(0x1p-20F), major, F32(1.0F));
    // A probe is as wide as the minor axis; wider where there are too few probes, and never
    // narrower than a texel, since it would miss the texels between. Half as many probes again as
    // fit side by side halve the error against the mean over the pixel.
    const F32 width = maximum(maximum(minor, major * F32(1.0F / most)), F32(1.0F));
    const F32 ratio = major / width;
    const F32 wanted = minimum(ratio * F32(1.5F), F32(most));
    const F32 whole = to_f32(to_i32(wanted));
    const F32 count =
        select(ratio > F32(1.0F), select(whole < wanted, whole + F32(1.0F), whole), F32(1.0F));
    // Each probe stands in the middle of its part of the axis. A round footprint has no longer
    // axis, so the line grows from length 0: no direction comes from rounding errors.
    const F32 grown = minimum(F32(4.0F) * (ratio - F32(1.0F)), F32(1.0F));
    const F32 line = maximum(major - major / count, F32(0.0F)) * maximum(grown, F32(0.0F));
    const F32 scale = select(length > F32(0x1p-40F), line / length, F32(0.0F));
    return {count, minimum(log2(width), F32(last)), x * scale, y * scale};
}

template <int kChannels>
SIMD_INLINE void anisotropic_lanes(ShadingBlock& b, const MipReader& reader, int most) {
    const F32 texel_x = 1.0F / static_cast<float>(reader.image().width());
    const F32 texel_y = 1.0F / static_cast<float>(reader.image().height());
    for (int i = 0; i < b.count; i += kLanes) {
        const Probes line = probes_of(reader.slopes(b, i), static_cast<float>(most), reader.last());
        const F32 s = reader.image().repeats_x(load<F32>(b.u + i));
        const F32 t = reader.image().repeats_y(load<F32>(b.v + i));
        const F32 step_x = line.along_x * texel_x, step_y = line.along_y * texel_y;
        const F32 weight = F32(1.0F) / line.count;
        const F32 spacing = F32(1.0F) / maximum(line.count - F32(1.0F), F32(1.0F));
        const auto probe = [&](float number) SIMD_LAMBDA {
            const F32 offset = F32(number) * spacing - F32(0.5F);
            return reader.trilinear<kChannels>(s + offset * step_x, t + offset * step_y,
                                               line.level);
        };
        // Adds the others as differences from the first, so that the mean of equal texels is that
        // texel.
        Texel<kChannels> mean = probe(0);
        const Texel<kChannels> first = mean;
        Texel<kChannels> sum;
        for (int c = 0; c < kChannels; ++c)
            sum.channel[c] = F32(0.0F);
        for (int k = 1; k < most; ++k) {
            const auto number = static_cast<float>(k);
            const auto used = F32(number) < line.count;
            if (!any(used)) break;
            const Texel<kChannels> next = probe(number);
            for (int c = 0; c < kChannels; ++c)
                sum.channel[c] =
                    sum.channel[c] + select(used, next.channel[c] - first.channel[c], F32(0.0F));
        }
        for (int c = 0; c < kChannels; ++c)
            mean.channel[c] = first.channel[c] + sum.channel[c] * weight;
        store_sample(mean, b, i);
    }
}

void anisotropic(ShadingBlock& b, const BoundMap& map, TexelKind kind, int most) {
    const MipReader reader(map, kind);
    if (kind == TexelKind::alpha)
        anisotropic_lanes<1>(b, reader, most);
    else
        anisotropic_lanes<3>(b, reader, most);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade {

namespace texture {
SIMD_REGISTER(anisotropic);
static void run(ShadingBlock& block, const BoundMap& map, TexelKind kind, int probes) {
    SIMD_CALL(anisotropic, block, map, kind, probes);
}
} // namespace texture

void sample_anisotropic(ShadingBlock& block, const BoundMap& map, TexelKind kind, int probes) {
    texture::run(block, map, kind, probes);
}

} // namespace scanout::shade
#endif
