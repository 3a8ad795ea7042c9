// "Gamma 2": the square root, the cheapest curve that looks like sRGB, up to 10 codes off
// (HARD-CASES 47).
#include "shade/resolve/output.h"

#define SIMD_FILE "shade/encode/square_root.cpp"
#include "simd/for_each_target.h"

#include "shade/encode/encode-inl.h"

SIMD_BEGIN(scanout::shade::encode)

struct RootCodes {
    static SIMD_INLINE I32 nearest(F32 light) { return to_i32(fraction(light) + F32(0.5F)); }
    static SIMD_INLINE F32 fraction(F32 light) { return F32(255.0F) * sqrt(clamped(light)); }
};

void square_root_rows(const Light& light, int count, std::uint32_t* out) {
    encode_all<RootCodes>(light, count, out);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::encode {

SIMD_REGISTER(square_root_rows);

extern const Encoding square_root;
constinit const Encoding square_root{{.axis = "encode",
                                      .name = "square_root",
                                      .blurb = "the root of light, up to 10 codes beside sRGB",
                                      .source = "Poynton 1993, with a gamma of 2",
                                      .kind = Kind::rung},
                                     [](std::uint8_t code) {
                                         const float root = static_cast<float>(code) / 255;
                                         return root * root;
                                     },
                                     [](const Light& light, int count, std::uint32_t* out) {
                                         SIMD_CALL(square_root_rows, light, count, out);
                                     }};

} // namespace scanout::shade::encode
#endif
