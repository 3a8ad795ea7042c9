// Mixes samples as sRGB codes, like renderers without gamma correction: edges between light and
// dark come out too dark. Half black, half white is 128 instead of 188; a quarter of white loses
// most, 73.
#include "shade/resolve/output.h"

#define SIMD_FILE "shade/blend_space/encoded.cpp"
#include "simd/for_each_target.h"

#include "shade/encode/encode-inl.h"

SIMD_BEGIN(scanout::shade::blend_space)

// Here a pixel's light is already a mean of codes.
struct OfCodes {
    static SIMD_INLINE I32 nearest(F32 code) { return to_i32(fraction(code) + F32(0.5F)); }
    static SIMD_INLINE F32 fraction(F32 code) {
        return minimum(maximum(code, F32(0.0F)), F32(255.0F));
    }
};

void code_rows(const Light& light, int count, std::uint32_t* out) {
    encode::HWY_NAMESPACE::encode_all<OfCodes>(light, count, out);
}

void enter_codes(ShadingBlock& b, const std::uint32_t* code) {
    for (int i = 0; i < b.count; i += kLanes) {
        const I32 word = load<I32>(code + i), digits = 255;
        store(to_f32(word & digits), b.colour[0] + i);
        store(to_f32(shift_right<8>(word) & digits), b.colour[1] + i);
        store(to_f32(shift_right<16>(word) & digits), b.colour[2] + i);
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::blend_space {

SIMD_REGISTER(code_rows);
SIMD_REGISTER(enter_codes);

static constinit const Encoding kMeanOfCodes{
    {},
    [](std::uint8_t code) { return static_cast<float>(code); },
    [](const Light& light, int count, std::uint32_t* out) {
        SIMD_CALL(code_rows, light, count, out);
    }};

extern const BlendSpace encoded;
constinit const BlendSpace encoded{
    {.axis = "blend_space",
     .name = "encoded",
     .blurb = "samples are mixed as codes, up to 73 codes too dark",
     .source = "Gritz and d'Eon 2007, as the mistake to avoid",
     .kind = Kind::rung},
    [](ShadingBlock& block, const std::uint32_t* code) { SIMD_CALL(enter_codes, block, code); },
    &kMeanOfCodes,
    255};

} // namespace scanout::shade::blend_space
#endif
