// Texel addressing that the texture filters share: texel centres lie at half-integers, v runs up
// and rows run down (TOPICS T15), repeat or clamp, the options -o and -s of the map.
#if defined(SCANOUT_SHADE_TEXEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_TEXEL_INL_H
#undef SCANOUT_SHADE_TEXEL_INL_H
#else
#define SCANOUT_SHADE_TEXEL_INL_H
#endif

#include "shade/stage.h"

#include "math/srgb-inl.h"

SIMD_BEGIN(scanout::shade::texture)

// x where |x| < 2^30; larger and NaN give 0: conversions are clamped, the same on every CPU.
HWY_INLINE F32 convertible(F32 x) {
    return select((x > F32(-0x1p30F)) & (x < F32(0x1p30F)), x, F32(0.0F));
}
// floor, for convertible x.
HWY_INLINE I32 floor_to_int(F32 x) {
    const I32 whole = to_i32(x);
    return whole - select(to_f32(whole) > x, I32(1), I32(0));
}

// What a kind of texel has: red, green and blue, or alpha alone.
template <bool kAlpha>
inline constexpr int kFirstChannel = kAlpha ? 3 : 0;
template <bool kAlpha>
inline constexpr int kEndChannel = kAlpha ? 4 : 3;

struct Texel {
    F32 channel[4];
};

class TexelReader {
public:
    TexelReader(const BoundMap& bound, TexelKind kind)
        : texels_(reinterpret_cast<const std::int32_t*>(bound.texture->image.pixels().data())),
          decode_(kind == TexelKind::colour ? ::scanout::detail::kSrgb.decode
                                            : ::scanout::detail::kSrgb.linear),
          width_(bound.texture->image.width()), height_(bound.texture->image.height()),
          clamp_(bound.map->clamp), scale_x_(bound.map->scale.x), scale_y_(bound.map->scale.y),
          offset_x_(bound.map->offset.x), offset_y_(bound.map->offset.y) {}

    // Texel coordinates, in texels: x right from the left edge, y up from the bottom edge.
    HWY_INLINE F32 x(F32 u) const {
        return unit(u * F32(scale_x_) + F32(offset_x_)) * F32(static_cast<float>(width_));
    }
    HWY_INLINE F32 y(F32 v) const {
        return unit(v * F32(scale_y_) + F32(offset_y_)) * F32(static_cast<float>(height_));
    }
    // Addressed beyond the edges, by at most the picture's size: the column of a texel counted from
    // the left, and where the row begins that is counted from the bottom. At most 2^28, an image
    // has up to 2^14 x 2^14 texels.
    HWY_INLINE I32 column(I32 x) const { return address(x, width_); }
    HWY_INLINE I32 row(I32 y) const {
        return (I32(height_ - 1) - address(y, height_)) * I32(width_);
    }
    // Linear light of a texel, or its alpha.
    template <bool kAlpha>
    HWY_INLINE Texel read(I32 column, I32 row) const {
        const I32 texel = gather(texels_, row + column), code_mask = 255;
        Texel t;
        if constexpr (kAlpha) {
            t.channel[3] = gather(decode_, shift_right<24>(texel) & code_mask);
        } else {
            t.channel[0] = gather(decode_, texel & code_mask);
            t.channel[1] = gather(decode_, shift_right<8>(texel) & code_mask);
            t.channel[2] = gather(decode_, shift_right<16>(texel) & code_mask);
        }
        return t;
    }

private:
    // Into [0, 1]: repeats by removing whole turns first, so that large coordinates keep their
    // precision; clamps where the map says so. NaN gives 0.
    HWY_INLINE F32 unit(F32 t) const {
        if (clamp_) return minimum(maximum(t, F32(0.0F)), F32(1.0F));
        const F32 safe = convertible(t);
        return safe - to_f32(floor_to_int(safe));
    }
    HWY_INLINE I32 address(I32 i, std::int32_t size) const {
        if (clamp_) return minimum(maximum(i, I32(0)), I32(size - 1));
        const I32 turn = size;
        return select(i < I32(0), i + turn, select(i >= turn, i - turn, i));
    }

    const std::int32_t* texels_; // image::Rgba8, red in the lowest byte
    const float* decode_;        // of 256 codes
    std::int32_t width_, height_;
    bool clamp_;
    float scale_x_, scale_y_, offset_x_, offset_y_;
};

SIMD_END

#endif
