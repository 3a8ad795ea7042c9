// Flat shading: lights each face once, at its middle, with its own normal. Bouknight 1970, [Primer
// 7.3].
#include "shade/shading/vertex_lighting.h"
#include "shade/stage.h"

#define SIMD_FILE "shade/shading/flat.cpp"
#include "simd/for_each_target.h"

#include "simd/lanes-inl.h"

SIMD_BEGIN(scanout::shade::shading)

void flat_run(ShadingBlock& b) {
    for (int r = 0; r < b.runs; ++r) {
        const Run& run = b.run[r];
        const VertexLighting::Triangle& light =
            b.vertex_lighting->triangle[b.vertex_lighting->of_run[r]];
        for (int i = run.first; i < run.first + run.count; i += kLanesX8)
            for (int c = 0; c < 3; ++c)
                store(load<F32x8>(b.albedo[c] + i) * F32x8(light.tinted[c][0]) +
                          F32x8(light.plain[c][0]),
                      b.colour[c] + i);
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::shading {

SIMD_REGISTER(flat_run);

extern const ShadingStage flat;
constinit const ShadingStage flat{{{.axis = "shading",
                                    .name = "flat",
                                    .blurb = "light once a face",
                                    .source = "Bouknight 1970",
                                    .kind = Kind::rung},
                                   Pass::shading,
                                   {.vertices = true},
                                   [](ShadingBlock& block, const FrameState& frame) {
                                       if (!block.lit) return block.model->run(block, frame);
                                       light_faces(block, frame);
                                       SIMD_CALL(flat_run, block);
                                   }},
                                  {}};

} // namespace scanout::shade::shading
#endif
