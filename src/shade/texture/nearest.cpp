// Nearest texel: the one that the sample falls into. [A 3.3], [C 9].
#include "shade/stage.h"
#include "shade/texel.h"

namespace scanout::shade::texture {
namespace {

void run(Block& b, const FrameState&) {
    if (b.texture == nullptr) return;
    const TexelReader reader(b.texture->image, b.material->map_diffuse);
    for (int i = 0; i < b.count; ++i) {
        float texel[3];
        reader.read(floor_to_int(reader.x(b.u[i])), floor_to_int(reader.y(b.v[i])), texel);
        for (int c = 0; c < 3; ++c)
            b.albedo[c][i] *= texel[c];
    }
}

} // namespace

extern const Stage nearest;
constinit const Stage nearest{{.axis = "texture",
                               .name = "nearest",
                               .blurb = "the texel that the sample falls into",
                               .source = "[A 3.3]",
                               .kind = Kind::rung,
                               .needs = {.uv = true}},
                              run};

} // namespace scanout::shade::texture
