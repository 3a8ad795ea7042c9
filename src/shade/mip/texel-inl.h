// Texel addressing that the texture filters share: texel centres lie at half-integers, v runs up
// and rows run down (HARD-CASES T15), repeat, mirror or clamp, the options -o and -s of the map.
#if defined(SCANOUT_SHADE_MIP_TEXEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_MIP_TEXEL_INL_H
#undef SCANOUT_SHADE_MIP_TEXEL_INL_H
#else
#define SCANOUT_SHADE_MIP_TEXEL_INL_H
#endif

#include "shade/stage.h"

#include "math/srgb-inl.h"
#include "simd/quads-inl.h"

SIMD_BEGIN(scanout::shade::texture)

// x where |x| < 2^30; larger and NaN give 0: conversions are clamped, the same on every CPU.
SIMD_INLINE F32 convertible(F32 x) {
    return select((x > F32(-0x1p30F)) & (x < F32(0x1p30F)), x, F32(0.0F));
}
SIMD_INLINE F32 floor(F32 x) {
    return F32(hn::Floor(x.raw));
}
SIMD_INLINE I32 floor_to_int(F32 x) { // convertible
    return to_i32(floor(x));
}

SIMD_INLINE F32 mix(F32 t, F32 from, F32 to) {
    return from + t * (to - from);
}

// What a filter reads of a texel: red, green and blue, or alpha alone.
template <int kChannels>
struct Texel {
    F32 channel[kChannels];
};
template <int kChannels>
SIMD_INLINE Texel<kChannels> mix(F32 t, const Texel<kChannels>& from, const Texel<kChannels>& to) {
    Texel<kChannels> mixed;
    for (int c = 0; c < kChannels; ++c)
        mixed.channel[c] = mix(t, from.channel[c], to.channel[c]);
    return mixed;
}
template <int kChannels>
SIMD_INLINE void store_sample(const Texel<kChannels>& texel, ShadingBlock& b, int item) {
    for (int c = 0; c < kChannels; ++c)
        store(texel.channel[c], b.sampled[kChannels == 1 ? 3 : c] + item);
}

class TexelReader {
public:
    TexelReader(const BoundMap& bound, TexelKind kind)
        : texels_(reinterpret_cast<const std::int32_t*>(bound.texture->image.pixels().data())),
          decode_(kind == TexelKind::colour ? ::scanout::detail::kSrgb.decode
                                            : ::scanout::detail::kSrgb.linear),
          width_(bound.texture->image.width()), height_(bound.texture->image.height()),
          wrap_u_(bound.wrap_u), wrap_v_(bound.wrap_v), scale_x_(bound.map->scale.x),
          scale_y_(bound.map->scale.y), offset_x_(bound.map->offset.x),
          offset_y_(bound.map->offset.y) {}

    std::int32_t width() const { return width_; }
    std::int32_t height() const { return height_; }

    // u and v with the map's options, in repeats of the texture.
    SIMD_INLINE F32 repeats_x(F32 u) const { return u * F32(scale_x_) + F32(offset_x_); }
    SIMD_INLINE F32 repeats_y(F32 v) const { return v * F32(scale_y_) + F32(offset_y_); }

    // Into [0, 1]: repeats by removing whole repeats first, so that large coordinates keep their
    // precision; mirrors or clamps where the map says so. NaN gives 0.
    SIMD_INLINE F32 unit_x(F32 t) const { return unit(t, wrap_u_); }
    SIMD_INLINE F32 unit_y(F32 t) const { return unit(t, wrap_v_); }
    SIMD_INLINE static F32 unit(F32 t, Wrap wrap) {
        if (wrap == Wrap::clamp) return minimum(maximum(t, F32(0.0F)), F32(1.0F));
        const F32 safe = convertible(t);
        if (wrap == Wrap::repeat) return safe - floor(safe);
        const F32 there_and_back = safe - F32(2.0F) * floor(safe * F32(0.5F));
        return select(there_and_back > F32(1.0F), F32(2.0F) - there_and_back, there_and_back);
    }

    // Texel coordinates, in texels: x right from the left edge, y up from the bottom edge.
    SIMD_INLINE F32 x(F32 u) const {
        return unit_x(repeats_x(u)) * F32(static_cast<float>(width_));
    }
    SIMD_INLINE F32 y(F32 v) const {
        return unit_y(repeats_y(v)) * F32(static_cast<float>(height_));
    }

    // A texel counted from an edge, `size` texels from the other; beyond them by at most `size`.
    SIMD_INLINE I32 address_x(I32 i, I32 size) const { return address(i, size, wrap_u_); }
    SIMD_INLINE I32 address_y(I32 i, I32 size) const { return address(i, size, wrap_v_); }
    SIMD_INLINE static I32 address(I32 i, I32 size, Wrap wrap) {
        if (wrap != Wrap::repeat) return minimum(maximum(i, I32(0)), size - I32(1));
        return select(i < I32(0), i + size, select(i >= size, i - size, i));
    }
    // Texel i and the one behind it, for i of -1 to size - 1.
    struct Neighbours {
        I32 first, second;
    };
    SIMD_INLINE Neighbours neighbours_x(I32 i, I32 size) const {
        return neighbours(i, size, wrap_u_);
    }
    SIMD_INLINE Neighbours neighbours_y(I32 i, I32 size) const {
        return neighbours(i, size, wrap_v_);
    }
    SIMD_INLINE static Neighbours neighbours(I32 i, I32 size, Wrap wrap) {
        const I32 next = i + I32(1);
        if (wrap != Wrap::repeat) return {maximum(i, I32(0)), minimum(next, size - I32(1))};
        return {i + (shift_right<31>(i) & size), select(next == size, I32(0), next)};
    }
    // The column of a texel counted from the left, and where the row begins that is counted from
    // the bottom. At most 2^28, an image has up to 2^14 x 2^14 texels.
    SIMD_INLINE I32 column(I32 x) const { return address_x(x, I32(width_)); }
    SIMD_INLINE I32 row(I32 y) const {
        return (I32(height_ - 1) - address_y(y, I32(height_))) * I32(width_);
    }
    // Linear light of a register of texels.
    template <int kChannels>
    SIMD_INLINE Texel<kChannels> read(I32 texel) const {
        const I32 codes = gather(texels_, texel), code_mask = 255;
        if constexpr (kChannels == 1) {
            return {{gather(::scanout::detail::kSrgb.linear, shift_right<24>(codes) & code_mask)}};
        } else {
            return {{gather(decode_, codes & code_mask),
                     gather(decode_, shift_right<8>(codes) & code_mask),
                     gather(decode_, shift_right<16>(codes) & code_mask)}};
        }
    }
    SIMD_INLINE Texel<1> alpha(I32 texel) const { return read<1>(texel); }
    // Red, green and blue of one texel, in a block of 128 bits; the fourth is any.
    static constexpr int kWords = 1; // a texel
    template <class Tag>
    SIMD_INLINE hn::Vec<Tag> block(Tag tag, std::int32_t word) const {
        const auto codes = static_cast<std::uint32_t>(texels_[word]);
        const auto light = [&](int shift)
                               SIMD_LAMBDA { return hn::Set(tag, decode_[codes >> shift & 255]); };
        return hn::ConcatLowerLower(tag, light(16), hn::InterleaveLower(tag, light(0), light(8)));
    }

private:
    const std::int32_t* texels_; // image::Rgba8, red in the lowest byte
    const float* decode_;        // of 256 codes
    std::int32_t width_, height_;
    Wrap wrap_u_, wrap_v_;
    float scale_x_, scale_y_, offset_x_, offset_y_;
};

// The 2 x 2 texels about a point, and the weights between them.
struct BilinearTaps {
    I32 left, right, bottom, top; // columns; where rows begin
    F32 x, y;
};
// In texels numbered from `begin` on, row by row from the top; s, t in [0, 1].
SIMD_INLINE BilinearTaps bilinear_taps(const TexelReader& reader, F32 s, F32 t, I32 width,
                                       I32 height, I32 begin) {
    const F32 x = s * to_f32(width) - F32(0.5F), y = t * to_f32(height) - F32(0.5F);
    const F32 x0 = floor(x), y0 = floor(y);
    const auto column = reader.neighbours_x(to_i32(x0), width);
    const auto line = reader.neighbours_y(to_i32(y0), height);
    const auto row = [&](I32 from_bottom)
                         SIMD_LAMBDA { return begin + (height - I32(1) - from_bottom) * width; };
    return {column.first, column.second, row(line.first), row(line.second), x - x0, y - y0};
}
SIMD_INLINE BilinearTaps bilinear_taps(const TexelReader& reader, F32 s, F32 t) { // in the image
    return bilinear_taps(reader, s, t, I32(reader.width()), I32(reader.height()), I32(0));
}
// The four texels of BilinearTaps in the memory of Texels, by the number of their first word:
// bottom left and right, top left and right. Of kCount lanes.
template <class Texels, int kCount>
struct TapWords {
    std::int32_t word[4][kCount];
    SIMD_INLINE void store_taps(const BilinearTaps& at, int item) {
        static_assert(Texels::kWords == 1 || Texels::kWords == 4);
        const auto words = [](I32 texel) SIMD_LAMBDA {
            return Texels::kWords == 4 ? shift_left<2>(texel) : texel;
        };
        store(words(at.bottom + at.left), word[0] + item);
        store(words(at.bottom + at.right), word[1] + item);
        store(words(at.top + at.left), word[2] + item);
        store(words(at.top + at.right), word[3] + item);
    }
};
// All channels, blended, of the lanes kRow, kRow + 4, ... of a register, in blocks of 128 bits.
// lane: where the register begins in `words_of_taps`; x, y: its lanes', as in BilinearTaps.
// texels.block(tag, word): one texel.
template <int kRow, class Texels, int kCount>
SIMD_INLINE F32 blend_row(const Texels& texels, const TapWords<Texels, kCount>& words_of_taps,
                          int item, F32 x, F32 y) {
    const auto read = [&](int k) SIMD_LAMBDA {
        return F32(load_row(F32::Tag(), item + kRow, [&](auto tag, int number) SIMD_LAMBDA {
            return texels.block(tag, words_of_taps.word[k][number]);
        }));
    };
    const F32 across = broadcast_in_quad<kRow>(x), up = broadcast_in_quad<kRow>(y);
    return mix(up, mix(across, read(0), read(1)), mix(across, read(2), read(3)));
}
// Whole texels one by one: a gather of each channel would take far longer. Not inline: of its
// hundreds of loads every filter would hold several copies.
template <class Texels>
HWY_NOINLINE Texel<3> blend_blocks(const Texels& texels, const BilinearTaps& at) {
    TapWords<Texels, kLanes> words_of_taps;
    words_of_taps.store_taps(at, 0);
    const auto found = quads_of_rows<F32::Tag>([&](auto number) SIMD_LAMBDA {
        return blend_row<decltype(number)::value>(texels, words_of_taps, 0, at.x, at.y);
    });
    return {{from_bits(found.word(0)), from_bits(found.word(1)), from_bits(found.word(2))}};
}
template <int kChannels, class Texels>
SIMD_INLINE Texel<kChannels> blend(const Texels& texels, const BilinearTaps& at) {
    if constexpr (kChannels == 3) {
        return blend_blocks(texels, at);
    } else {
        static_assert(kChannels == 1);
        const auto read = [&](I32 texel) SIMD_LAMBDA { return texels.alpha(texel); };
        return mix(at.y, mix(at.x, read(at.bottom + at.left), read(at.bottom + at.right)),
                   mix(at.x, read(at.top + at.left), read(at.top + at.right)));
    }
}

SIMD_END

#endif
