// Blinn-Phong as MTL's illum 2 means it: Lambert plus Ks max(n.h, 0)^Ns for every light, h halfway
// between light and eye, not normalised for energy. Blinn 1977, [A 11.1], [C 7].
#include "shade/stage.h"

#define SIMD_FILE "shade/reflection/blinn_phong.cpp"
#include "simd/for_each_target.h"

#include "math/transcendental-inl.h"
#include "shade/reflection/diffuse-inl.h"

SIMD_BEGIN(scanout::shade::reflection)

struct Vector {
    F32 x, y, z;
};

// max(n.h, 0)^exponent; h from a unit vector to the eye and one to the light.
HWY_INLINE F32 highlight(const Vector& normal, const Vector& eye, const F32 (&light)[3],
                         float exponent) {
    const F32 hx = eye.x + light[0], hy = eye.y + light[1], hz = eye.z + light[2];
    const F32 length = sqrt((hx * hx + hy * hy) + hz * hz);
    const F32 dot = (normal.x * hx + normal.y * hy) + normal.z * hz;
    // length 0: the light shines straight into the eye through the surface; no highlight.
    const F32 cosine = select(length > F32(0x1p-20F), dot / length, F32(0.0F));
    return pow(minimum(F32(1.0F), cosine), F32(exponent)); // of NaN: 0
}

void blinn_phong_run(Block& b, const FrameState& frame) {
    diffuse(b, frame);
    if (!b.lit || !scene::has_highlight(*b.material)) return;
    const Vec3& ks = b.material->specular;
    const float exponent = b.material->shininess;
    const std::size_t light_count = frame.lights.size();
    const F32 zero = 0.0F;
    for (int i = 0; i < b.count; i += kLanes) {
        const F32 rx = frame.orthographic ? zero : load<F32>(b.ray_x + i);
        const F32 ry = frame.orthographic ? zero : load<F32>(b.ray_y + i);
        const F32 inverse = F32(1.0F) / sqrt((rx * rx + ry * ry) + F32(1.0F));
        const Vector eye = {-rx * inverse, -ry * inverse, inverse}; // from the surface
        const Vector normal = {load<F32>(b.normal[0] + i), load<F32>(b.normal[1] + i),
                               load<F32>(b.normal[2] + i)};
        F32 red = load<F32>(b.colour[0] + i), green = load<F32>(b.colour[1] + i),
            blue = load<F32>(b.colour[2] + i);
        for (std::size_t k = 0; k < light_count; ++k) {
            const Light l = light_at(b, frame, k, i);
            const F32 bright = highlight(normal, eye, l.towards, exponent);
            red = red + (l.colour[0] * F32(ks.x)) * bright;
            green = green + (l.colour[1] * F32(ks.y)) * bright;
            blue = blue + (l.colour[2] * F32(ks.z)) * bright;
        }
        store(red, b.colour[0] + i);
        store(green, b.colour[1] + i);
        store(blue, b.colour[2] + i);
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::reflection {

SIMD_REGISTER(blinn_phong_run);

extern const Stage blinn_phong;
constinit const Stage blinn_phong{
    {.axis = "reflection",
     .name = "blinn_phong",
     .blurb = "Lambert plus a highlight where the half vector meets the normal",
     .source = "Blinn 1977, [A 11.1]",
     .kind = Kind::model},
    {.normal = true, .ray = true},
    [](Block& block, const FrameState& frame) {
        SIMD_CALL(blinn_phong_run)
        (block, frame);
    }};

} // namespace scanout::shade::reflection
#endif
