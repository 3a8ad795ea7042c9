// "Gamma 2.2": a plain power instead of sRGB's curve, up to 9 codes off, in the darks
// (HARD-CASES 47).
#include "math/transcendental.h"
#include "shade/resolve/output.h"

#define SIMD_FILE "shade/encode/power_2_2.cpp"
#include "simd/for_each_target.h"

#include "math/transcendental-inl.h"
#include "shade/encode/encode-inl.h"

SIMD_BEGIN(scanout::shade::encode)

struct PowerCodes {
    static SIMD_INLINE I32 nearest(F32 light) { return to_i32(fraction(light) + F32(0.5F)); }
    static SIMD_INLINE F32 fraction(F32 light) {
        return minimum(F32(255.0F) * pow_of_share(clamped(light), F32(1 / 2.2F)), F32(255.0F));
    }
};

void power_2_2_rows(const Light& light, int count, std::uint32_t* out) {
    encode_all<PowerCodes>(light, count, out);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::encode {

SIMD_REGISTER(power_2_2_rows);

extern const Encoding power_2_2;
constinit const Encoding power_2_2{
    {.axis = "encode",
     .name = "power_2_2",
     .blurb = "light to the power 1/2.2, up to 9 codes beside sRGB",
     .source = "Poynton 1993",
     .kind = Kind::rung,
     .may_err_more = {"square_root", "in the dark: it rises from black more steeply than the "
                                     "root, and sRGB is a line there"}},
    [](std::uint8_t code) { return static_cast<float>(pow(code / 255.0, 2.2)); },
    [](const Light& light, int count, std::uint32_t* out) {
        SIMD_CALL(power_2_2_rows, light, count, out);
    }};

} // namespace scanout::shade::encode
#endif
