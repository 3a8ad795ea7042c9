// Reading a texture at a level of detail, which differs from lane to lane: what the filters for
// minified textures share. Level 0 is the image itself and read as `bilinear` reads it, to the bit.
#if defined(SCANOUT_SHADE_MIP_MIP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_MIP_MIP_INL_H
#undef SCANOUT_SHADE_MIP_MIP_INL_H
#else
#define SCANOUT_SHADE_MIP_MIP_INL_H
#endif

#include "shade/mip/mip_chain.h"

#include "shade/mip/texel-inl.h"
#include "shade/setup/footprint-inl.h"

SIMD_BEGIN(scanout::shade::texture)

// Levels 1 and on.
struct ChainTexels {
    static constexpr int kWords = 4; // a texel: red, green, blue and alpha
    const float* texels;
    SIMD_INLINE Texel<1> alpha(I32 texel) const {
        return {{gather(texels + 3, shift_left<2>(texel))}};
    }
    template <class Tag>
    SIMD_INLINE hn::Vec<Tag> block(Tag tag, std::int32_t word) const {
        return hn::LoadU(tag, texels + word);
    }
};

class MipReader {
public:
    MipReader(const BoundMap& bound, TexelKind kind)
        : image_(bound, kind), chain_(bound.mips),
          // A texel of the image in texels of the map: its options scale the footprint, too.
          size_x_(bound.map->scale.x * static_cast<float>(image_.width())),
          size_y_(bound.map->scale.y * static_cast<float>(image_.height())) {}

    const TexelReader& image() const { return image_; }
    float last() const { return chain_ == nullptr ? 0 : static_cast<float>(chain_->last); }

    // In texels of the image.
    SIMD_INLINE UvSlopes<F32::Tag> slopes(const ShadingBlock& b, int item) const {
        return {load<F32>(b.u_x + item) * F32(size_x_), load<F32>(b.v_x + item) * F32(size_y_),
                load<F32>(b.u_y + item) * F32(size_x_), load<F32>(b.v_y + item) * F32(size_y_)};
    }

    // Bilinear in a level of each lane; s and t in repeats of the texture.
    template <int kChannels>
    SIMD_INLINE Texel<kChannels> bilinear(F32 s, F32 t, I32 level) const {
        s = image_.unit_x(s);
        t = image_.unit_y(t);
        const auto whole = level == I32(0);
        if (all(whole)) return bilinear_in_image<kChannels>(s, t);
        // Lanes of level 0 read level 1, which is discarded below.
        const Levels in = levels(maximum(level, I32(1)));
        Texel<kChannels> found = blend<kChannels>(texels(), taps_in_chain(s, t, in));
        if (any(whole)) {
            const Texel<kChannels> direct = bilinear_in_image<kChannels>(s, t);
            for (int c = 0; c < kChannels; ++c)
                found.channel[c] = select(whole, direct.channel[c], found.channel[c]);
        }
        return found;
    }

    // Between the two nearest levels; `level` in [0, last].
    template <int kChannels>
    SIMD_INLINE Texel<kChannels> trilinear(F32 s, F32 t, F32 level) const {
        const I32 sharp = to_i32(level);
        const Texel<kChannels> near = bilinear<kChannels>(s, t, sharp);
        const F32 fraction = level - to_f32(sharp);
        if (all(fraction == F32(0.0F))) return near; // nowhere minified, above all
        const I32 blurred = minimum(sharp + I32(1), to_i32(F32(last())));
        return mix(fraction, near, bilinear<kChannels>(s, t, blurred));
    }

    // Levels of the chain, 1 to last, lane by lane: sizes, and which number the first texel has.
    struct Levels {
        I32 width, height, begin;
    };
    SIMD_INLINE Levels levels(I32 level) const {
        const auto halved = [&](std::int32_t size) SIMD_LAMBDA {
            return maximum(I32(hn::Shr(I32(size).raw, level.raw)), I32(1));
        };
        return {halved(image_.width()), halved(image_.height()), gather(chain_->begin, level)};
    }
    // Those behind; the last one stays.
    SIMD_INLINE Levels next(const Levels& at) const {
        return {maximum(shift_right<1>(at.width), I32(1)),
                maximum(shift_right<1>(at.height), I32(1)),
                minimum(at.begin + at.width * at.height, I32(chain_->begin[chain_->last]))};
    }

    // For filters that read the chain themselves; s, t in [0, 1].
    SIMD_INLINE BilinearTaps taps_in_chain(F32 s, F32 t, const Levels& in) const {
        return bilinear_taps(image_, s, t, in.width, in.height, in.begin);
    }
    ChainTexels texels() const { return {chain_->texels.data()}; }

private:
    // s, t in [0, 1].
    template <int kChannels>
    SIMD_INLINE Texel<kChannels> bilinear_in_image(F32 s, F32 t) const {
        return blend<kChannels>(image_, bilinear_taps(image_, s, t));
    }

    TexelReader image_;
    const MipChain* chain_;
    float size_x_, size_y_;
};

SIMD_END

#endif
