// Bilinear filtering: the four nearest texels, weighted by the overlap of a texel-sized square
// around the sample, in linear light. Heckbert, "Fundamentals of Texture Mapping", 1989; [A 3.3],
// [C 9].
#include "shade/stage.h"
#include "shade/texel.h"

namespace scanout::shade::texture {
namespace {

void run(Block& b, const FrameState&) {
    if (b.texture == nullptr) return;
    const TexelReader reader(b.texture->image, b.material->map_diffuse);
    for (int i = 0; i < b.count; ++i) {
        const float x = reader.x(b.u[i]) - 0.5F, y = reader.y(b.v[i]) - 0.5F;
        const std::int32_t x0 = floor_to_int(x), y0 = floor_to_int(y);
        const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
        float t00[3], t10[3], t01[3], t11[3];
        reader.read(x0, y0, t00);
        reader.read(x0 + 1, y0, t10);
        reader.read(x0, y0 + 1, t01);
        reader.read(x0 + 1, y0 + 1, t11);
        for (int c = 0; c < 3; ++c) {
            const float lower = t00[c] + fx * (t10[c] - t00[c]);
            const float upper = t01[c] + fx * (t11[c] - t01[c]);
            b.albedo[c][i] *= lower + fy * (upper - lower);
        }
    }
}

} // namespace

extern const Stage bilinear;
constinit const Stage bilinear{{.axis = "texture",
                                .name = "bilinear",
                                .blurb = "four texels, weighted by overlap, in linear light",
                                .source = "Heckbert 1989, [A 3.3]",
                                .kind = Kind::rung,
                                .needs = {.uv = true}},
                               run};

} // namespace scanout::shade::texture
