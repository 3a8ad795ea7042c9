// Light at the corners or in the middle of a block's triangles, where it is not evaluated at every
// pixel: the frame's light stages and the material's reflection model run over items that are
// vertices or faces instead of pixels, so that all rungs of the axis `shading` share them.
//
// Every model is linear in the albedo: colour = plain + albedo * tinted. Both parts are kept apart,
// so that the albedo, which textures change from pixel to pixel, is multiplied at every pixel.
#pragma once

#include "shade/stage.h"

namespace scanout::shade {

struct VertexLighting {
    // The light of one triangle: [channel][vertex]; for a face, vertex 0 stands for all.
    struct Triangle {
        float plain[3][3], tinted[3][3];
    };
    Triangle triangle[kBlockSize];
    std::uint8_t of_run[kBlockSize]; // place in `triangle`

    // Lanes that are vertices or faces.
    ShadingBlock items;
    alignas(64) float eye[3][kPaddedBlock];
};

// Lights every triangle of the block once, and notes which triangle each run shows.
void light_vertices(ShadingBlock& block, const FrameState& frame);
void light_faces(ShadingBlock& block, const FrameState& frame);

} // namespace scanout::shade
