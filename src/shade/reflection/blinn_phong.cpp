// Blinn-Phong as MTL's illum 2 means it: Lambert plus Ks max(n.h, 0)^Ns for every light, h halfway
// between light and eye, not normalised for energy. Blinn 1977, [A 11.1], [C 7].
#include "math/transcendental_f32.h"
#include "shade/reflection/diffuse.h"
#include "shade/stage.h"

#include <algorithm>
#include <cmath>

namespace scanout::shade::reflection {
namespace {

void run(Block& b, const FrameState& frame) {
    diffuse(b, frame);
    if (!b.lit || !scene::has_highlight(*b.material)) return;
    const Vec3 ks = b.material->specular;
    const float exponent = b.material->shininess;
    for (int i = 0; i < b.count; ++i) {
        const float rx = frame.orthographic ? 0.0F : b.ray_x[i],
                    ry = frame.orthographic ? 0.0F : b.ray_y[i];
        const float inverse = 1.0F / std::sqrt((rx * rx + ry * ry) + 1.0F);
        const float vx = -rx * inverse, vy = -ry * inverse,
                    vz = inverse; // from the surface to the eye
        for (const scene::Light& l : frame.lights) {
            const float hx = vx + l.towards.x, hy = vy + l.towards.y, hz = vz + l.towards.z;
            const float length = std::sqrt((hx * hx + hy * hy) + hz * hz);
            const float dot = (b.normal[0][i] * hx + b.normal[1][i] * hy) + b.normal[2][i] * hz;
            // length 0: the light shines straight into the eye through the surface; no highlight.
            const float cosine = length > 0x1p-20F ? dot / length : 0.0F;
            const float highlight = pow_f32(std::min(cosine, 1.0F), exponent);
            b.colour[0][i] += l.colour.x * ks.x * highlight;
            b.colour[1][i] += l.colour.y * ks.y * highlight;
            b.colour[2][i] += l.colour.z * ks.z * highlight;
        }
    }
}

} // namespace

extern const Stage blinn_phong;
constinit const Stage blinn_phong{
    {.axis = "reflection",
     .name = "blinn_phong",
     .blurb = "Lambert plus a highlight where the half vector meets the normal",
     .source = "Blinn 1977, [A 11.1]",
     .kind = Kind::model,
     .needs = {.normal = true}},
    run};

} // namespace scanout::shade::reflection
