#include "shade/shrink.h"

#define SIMD_FILE "shade/shrink.cpp"
#include "simd/for_each_target.h"

SIMD_BEGIN(scanout::shade)

// The texels of a line that one of half as many covers, from 2i on, and their shares. Of an odd
// number 2m + 1 each of the m covers 2 + 1/m: the middle ones' shares shift from the first to the
// third (Guthe and Heckbert, "Non-power-of-two mipmapping", 2005). Shares add up to 1, and over the
// line every texel counts alike.
template <class Number>
struct Shares {
    int count;
    Number share[3];
};
template <class Number>
SIMD_INLINE Shares<Number> shares_of(Number i, int size) {
    const Number none = 0.0, half = 0.5, one = 1.0;
    if (size == 1) return {1, {one, none, none}};
    if (size % 2 == 0) return {2, {half, half, none}};
    const Number m = static_cast<double>(size / 2), whole = static_cast<double>(size);
    return {3, {(m - i) / whole, m / whole, (i + one) / whole}};
}

// Four channels of a register of texels.
struct Texels {
    F32x8 channel[4];
};
// Those of even and of odd number of two registers' width in a row.
struct TexelPairs {
    Texels even, odd;
};

// Codes of an image.
struct Codes {
    const std::int32_t* codes;
    const float* decode;

    SIMD_INLINE Texels decoded(I32x8 code) const {
        const I32x8 mask = 255;
        const auto colour = [&](I32x8 c) SIMD_LAMBDA { return gather(decode, c & mask); };
        return {{colour(code), colour(shift_right<8>(code)), colour(shift_right<16>(code)),
                 to_f32(shift_right<24>(code) & mask) / F32x8(255.0F)}};
    }
    SIMD_INLINE Texels at(I32x8 place) const { return decoded(gather(codes, place)); }
    SIMD_INLINE TexelPairs pairs_from(std::ptrdiff_t place) const {
        I32x8 even, odd;
        hn::LoadInterleaved2(I32x8::Tag(), codes + place, even.raw, odd.raw);
        return {decoded(even), decoded(odd)};
    }
};

// Four floats a texel.
struct Floats {
    const float* texels;

    SIMD_INLINE Texels at(I32x8 place) const {
        const I32x8 first = shift_left<2>(place);
        return {{gather(texels, first), gather(texels + 1, first), gather(texels + 2, first),
                 gather(texels + 3, first)}};
    }
    SIMD_INLINE TexelPairs pairs_from(std::ptrdiff_t place) const {
        const F32x8::Tag tag;
        Texels low, high;
        const auto load = [&](const float* from, F32x8(&to)[4]) SIMD_LAMBDA {
            hn::LoadInterleaved4(tag, from, to[0].raw, to[1].raw, to[2].raw, to[3].raw);
        };
        load(texels + 4 * place, low.channel);
        load(texels + 4 * (place + kLanesX8), high.channel);
        TexelPairs pairs;
        SIMD_UNROLL
        for (int c = 0; c < 4; ++c) {
            const auto l = low.channel[c].raw, h = high.channel[c].raw;
            pairs.even.channel[c] = F32x8(hn::ConcatEven(tag, h, l));
            pairs.odd.channel[c] = F32x8(hn::ConcatOdd(tag, h, l));
        }
        return pairs;
    }
};

SIMD_INLINE void add(F64x8 (&sum)[4], F64x8 share, const Texels& texels) {
    SIMD_UNROLL
    for (int c = 0; c < 4; ++c)
        sum[c] = sum[c] + share * to_f64(texels.channel[c]);
}

// The sums are in double, so the mean of equal floats is that float.
template <class Read>
SIMD_INLINE void shrink(const LevelAbove& above, int y, int width, float* row, const Read& read) {
    const Shares<double> down = shares_of(static_cast<double>(y), above.height);
    for (int i = 0; i < width; i += kLanesX8) {
        const bool whole = i + kLanesX8 <= width;
        const I32x8 column = minimum(iota<I32x8>(i), I32x8(width - 1));
        const Shares<F64x8> across = shares_of(to_f64(column), above.width);
        F64x8 sum[4] = {0.0, 0.0, 0.0, 0.0};
        for (int k = 0; k < down.count; ++k) {
            const int above_row = (2 * y + k) * above.width;
            F64x8 line[4] = {0.0, 0.0, 0.0, 0.0};
            if (whole && above.width % 2 == 0) { // what is read lies side by side
                const TexelPairs pairs = read.pairs_from(above_row + 2 * i);
                add(line, across.share[0], pairs.even);
                add(line, across.share[1], pairs.odd);
            } else {
                const I32x8 first = I32x8(above_row) + shift_left<1>(column);
                for (int l = 0; l < across.count; ++l)
                    add(line, across.share[l], read.at(first + I32x8(l)));
            }
            SIMD_UNROLL
            for (int c = 0; c < 4; ++c)
                sum[c] = sum[c] + F64x8(down.share[k]) * line[c];
        }
        float room[4 * kLanesX8]; // a row ends where the next one begins
        float* const to = whole ? row + 4 * i : room;
        hn::StoreInterleaved4(to_f32(sum[0]).raw, to_f32(sum[1]).raw, to_f32(sum[2]).raw,
                              to_f32(sum[3]).raw, F32x8::Tag(), to);
        if (whole) continue;
        for (int k = 0; k < 4 * (width - i); ++k)
            row[4 * i + k] = room[k];
    }
}

void shrink_any(const LevelAbove& above, int y, int width, float* row) {
    if (above.codes != nullptr)
        shrink(above, y, width, row, Codes{above.codes, above.decode});
    else
        shrink(above, y, width, row, Floats{above.texels});
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade {

SIMD_REGISTER(shrink_any);

void shrink_row(const LevelAbove& above, int y, int width, float* row) {
    SIMD_CALL(shrink_any)(above, y, width, row);
}

} // namespace scanout::shade
#endif
