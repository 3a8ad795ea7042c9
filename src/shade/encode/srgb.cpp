// sRGB, exactly: the nearest code of the piecewise curve (IEC 1999; Microsoft 2015, 3.2.3.8, allows
// 0.6 code; this is 0.5).
#include "shade/resolve/output.h"

#define SIMD_FILE "shade/encode/srgb.cpp"
#include "simd/for_each_target.h"

#include "math/srgb-inl.h"
#include "math/transcendental-inl.h"
#include "shade/encode/encode-inl.h"

SIMD_BEGIN(scanout::shade::encode)

struct SrgbCodes {
    static SIMD_INLINE I32 nearest(F32 light) { return srgb_encode(light); }
    static SIMD_INLINE F32 fraction(F32 light) {
        const F32 x = clamped(light);
        const F32 curve = F32(269.025F) * pow_of_share(x, F32(1 / 2.4F)) - F32(14.025F);
        const F32 start = F32(12.92F * 255) * x;
        return minimum(select(x > F32(0.0031308F), curve, start), F32(255.0F));
    }
};

void srgb_rows(const Light& light, int count, std::uint32_t* out) {
    encode_all<SrgbCodes>(light, count, out);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::encode {

SIMD_REGISTER(srgb_rows);

extern const Encoding srgb;
constinit const Encoding srgb{{.axis = "encode",
                               .name = "srgb",
                               .blurb = "the nearest code of the sRGB curve, exactly",
                               .source = "IEC 1999; Microsoft 2015, 3.2.3.8",
                               .kind = Kind::rung},
                              srgb_decode,
                              [](const Light& light, int count, std::uint32_t* out) {
                                  SIMD_CALL(srgb_rows, light, count, out);
                              }};

} // namespace scanout::shade::encode
#endif
