#include "shade/mip/downsample.h"

#define SIMD_FILE "shade/mip/downsample.cpp"
#include "simd/for_each_target.h"

SIMD_BEGIN(scanout::shade)

// The weights of the texels, from 2i on, that texel i of half as many covers. Of an odd number 2m +
// 1 each of the m covers 2 + 1/m: the middle weights shift from the first to the third (Guthe and
// Heckbert 2005). Weights add up to 1, and over the line every texel counts alike.
template <class Number>
struct Weights {
    int count;
    Number weight[3];
};
template <class Number>
SIMD_INLINE Weights<Number> weights_of(Number i, int size) {
    const Number none = 0.0, half = 0.5, one = 1.0;
    if (size == 1) return {1, {one, none, none}};
    if (size % 2 == 0) return {2, {half, half, none}};
    const Number m = static_cast<double>(size / 2), whole = static_cast<double>(size);
    return {3, {(m - i) / whole, m / whole, (i + one) / whole}};
}

// Four channels of a register of texels.
struct Texels {
    F64x8 channel[4];
};
SIMD_INLINE void store_texels(const F64x8 (&texel)[4], float* to) {
    hn::StoreInterleaved4(to_f32(texel[0]).raw, to_f32(texel[1]).raw, to_f32(texel[2]).raw,
                          to_f32(texel[3]).raw, F32x8::Tag(), to);
}

// Codes of an image.
struct Codes {
    const std::int32_t* codes;
    const double *colour, *alpha;

    SIMD_INLINE Texels decoded(I32x8 code) const {
        const I32x8 mask = 255;
        return {{gather(colour, code & mask), gather(colour, shift_right<8>(code) & mask),
                 gather(colour, shift_right<16>(code) & mask),
                 gather(alpha, shift_right<24>(code) & mask)}};
    }
    SIMD_INLINE Texels at(I32x8 place) const { return decoded(gather(codes, place)); }
    // Means of 2 x 2 texels each, for a register of texels; the first square begins at `place`.
    SIMD_INLINE void means(std::ptrdiff_t place, int width, float* out) const {
        const auto pairs = [&](std::ptrdiff_t from, F64x8(&sum)[4]) SIMD_LAMBDA {
            I32x8 even, odd;
            hn::LoadInterleaved2(I32x8::Tag(), codes + from, even.raw, odd.raw);
            const Texels left = decoded(even), right = decoded(odd);
            SIMD_FOR (int c = 0; c < 4; ++c)
                sum[c] = left.channel[c] + right.channel[c];
        };
        F64x8 upper[4], lower[4];
        pairs(place, upper);
        pairs(place + width, lower);
        SIMD_FOR (int c = 0; c < 4; ++c)
            upper[c] = (upper[c] + lower[c]) * F64x8(0.25);
        store_texels(upper, out);
    }
};

// Four floats a texel.
struct Floats {
    const float* texels;

    SIMD_INLINE Texels at(I32x8 place) const {
        const I32x8 first = shift_left<2>(place);
        return {{to_f64(gather(texels, first)), to_f64(gather(texels + 1, first)),
                 to_f64(gather(texels + 2, first)), to_f64(gather(texels + 3, first))}};
    }
    SIMD_INLINE void means(std::ptrdiff_t place, int width, float* out) const {
        constexpr int kTexels = kLanesX8 / 4; // of a register
        const auto pairs = [&](const float* from) SIMD_LAMBDA {
            const F32x8::Tag tag;
            const auto low = hn::LoadU(tag, from), high = hn::LoadU(tag, from + kLanesX8);
            if constexpr (kTexels == 1)
                return to_f64(F32x8(low)) + to_f64(F32x8(high));
            else
                return to_f64(F32x8(hn::ConcatLowerLower(tag, high, low))) +
                       to_f64(F32x8(hn::ConcatUpperUpper(tag, high, low)));
        };
        const float* const upper = texels + 4 * place;
        const float* const lower = upper + std::ptrdiff_t{4} * width;
        SIMD_FOR (int i = 0; i < 4; ++i) { // kTexels each
            const int at = 2 * i * kLanesX8;
            const F64x8 sum = pairs(upper + at) + pairs(lower + at);
            store(to_f32(sum * F64x8(0.25)), out + i * kLanesX8);
        }
    }
};

SIMD_INLINE void add(F64x8 (&sum)[4], F64x8 weight, const Texels& texels) {
    SIMD_FOR (int c = 0; c < 4; ++c)
        sum[c] = sum[c] + weight * texels.channel[c];
}

// The sums are in double, so the mean of equal floats is that float.
template <class Read>
SIMD_INLINE void downsample(const LevelAbove& above, int y, int width, float* row,
                            const Read& read) {
    int i = 0;
    if (above.width % 2 == 0 && above.height % 2 == 0) // every weight is a quarter
        for (; i + kLanesX8 <= width; i += kLanesX8)
            read.means(std::ptrdiff_t{2} * (std::ptrdiff_t{y} * above.width + i), above.width,
                       row + 4 * i);
    const Weights<double> down = weights_of(static_cast<double>(y), above.height);
    for (; i < width; i += kLanesX8) {
        const bool whole = i + kLanesX8 <= width;
        const I32x8 column = minimum(iota<I32x8>(i), I32x8(width - 1));
        const Weights<F64x8> across = weights_of(to_f64(column), above.width);
        F64x8 sum[4] = {0.0, 0.0, 0.0, 0.0};
        for (int k = 0; k < down.count; ++k) {
            const int above_row = (2 * y + k) * above.width;
            F64x8 line[4] = {0.0, 0.0, 0.0, 0.0};
            const I32x8 first = I32x8(above_row) + shift_left<1>(column);
            for (int l = 0; l < across.count; ++l)
                add(line, across.weight[l], read.at(first + I32x8(l)));
            SIMD_FOR (int c = 0; c < 4; ++c)
                sum[c] = sum[c] + F64x8(down.weight[k]) * line[c];
        }
        float scratch[4 * kLanesX8]; // a row ends where the next one begins
        float* const to = whole ? row + 4 * i : scratch;
        store_texels(sum, to);
        if (whole) continue;
        for (int k = 0; k < 4 * (width - i); ++k)
            row[4 * i + k] = scratch[k];
    }
}

void downsample_any(const LevelAbove& above, int y, int width, float* row) {
    if (above.codes != nullptr)
        downsample(above, y, width, row, Codes{above.codes, above.colour, above.alpha});
    else
        downsample(above, y, width, row, Floats{above.texels});
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade {

SIMD_REGISTER(downsample_any);

void downsample_row(const LevelAbove& above, int y, int width, float* row) {
    SIMD_CALL(downsample_any, above, y, width, row);
}

} // namespace scanout::shade
#endif
