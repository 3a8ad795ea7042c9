#include "shade/shrink.h"

#include "math/srgb.h"

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

// read(place, texel): red, green, blue, alpha of texels of the level above. The sums are in double,
// so the mean of equal floats is that float.
template <class Read>
SIMD_INLINE void shrink(const LevelAbove& above, int y, int width, float* row, const Read& read) {
    const Shares<double> down = shares_of(static_cast<double>(y), above.height);
    for (int i = 0; i < width; i += kLanesX8) {
        const I32x8 column = minimum(iota<I32x8>(i), I32x8(width - 1));
        const Shares<F64x8> across = shares_of(to_f64(column), above.width);
        F64x8 sum[4] = {0.0, 0.0, 0.0, 0.0};
        for (int k = 0; k < down.count; ++k) {
            const I32x8 first = I32x8((2 * y + k) * above.width) + shift_left<1>(column);
            F64x8 line[4] = {0.0, 0.0, 0.0, 0.0};
            for (int l = 0; l < across.count; ++l) {
                F32x8 texel[4];
                read(first + I32x8(l), texel);
                SIMD_UNROLL
                for (int c = 0; c < 4; ++c)
                    line[c] = line[c] + across.share[l] * to_f64(texel[c]);
            }
            SIMD_UNROLL
            for (int c = 0; c < 4; ++c)
                sum[c] = sum[c] + F64x8(down.share[k]) * line[c];
        }
        float room[4 * kLanesX8]; // a row ends where the next one begins
        float* const to = i + kLanesX8 <= width ? row + 4 * i : room;
        hn::StoreInterleaved4(to_f32(sum[0]).raw, to_f32(sum[1]).raw, to_f32(sum[2]).raw,
                              to_f32(sum[3]).raw, F32x8::Tag(), to);
        if (to != room) continue;
        for (int k = 0; k < 4 * (width - i); ++k)
            row[4 * i + k] = room[k];
    }
}

void shrink_any(const LevelAbove& above, int y, int width, float* row) {
    if (above.codes != nullptr)
        shrink(above, y, width, row, [&](I32x8 place, F32x8(&texel)[4]) SIMD_LAMBDA {
            const I32x8 codes = gather(above.codes, place), code_mask = 255;
            texel[0] = gather(above.decode, codes & code_mask);
            texel[1] = gather(above.decode, shift_right<8>(codes) & code_mask);
            texel[2] = gather(above.decode, shift_right<16>(codes) & code_mask);
            texel[3] = gather(::scanout::detail::kSrgb.linear, shift_right<24>(codes) & code_mask);
        });
    else
        shrink(above, y, width, row, [&](I32x8 place, F32x8(&texel)[4]) SIMD_LAMBDA {
            const I32x8 first = shift_left<2>(place);
            SIMD_UNROLL
            for (int c = 0; c < 4; ++c)
                texel[c] = gather(above.texels + c, first);
        });
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
