// Gouraud shading: lights the vertices and interpolates in between: a highlight inside a triangle
// is lost. Gouraud 1971, [Primer 7.3]. The parts with and without albedo are interpolated
// separately, so textures stay sharp.
#include "shade/shading/vertex_lighting.h"
#include "shade/stage.h"

#define SIMD_FILE "shade/shading/gouraud.cpp"
#include "simd/for_each_target.h"

#include "shade/interpolate/weights-inl.h"

SIMD_BEGIN(scanout::shade::shading)

void gouraud_run(ShadingBlock& b) {
    for (int r = 0; r < b.runs; ++r) {
        const Run& run = b.run[r];
        const Primitive& t = *run.primitive;
        const VertexLighting::Triangle& light =
            b.vertex_lighting->triangle[b.vertex_lighting->of_run[r]];
        for (int i = run.first; i < run.first + run.count; i += kLanes) {
            const auto w = interpolate::HWY_NAMESPACE::weights(t, to_f64(load<I32>(b.x + i)),
                                                               to_f64(load<I32>(b.y + i)),
                                                               {i, run.first + run.count - i});
            for (int c = 0; c < 3; ++c)
                store(load<F32>(b.albedo[c] + i) *
                              interpolate::HWY_NAMESPACE::mix(w, light.tinted[c]) +
                          interpolate::HWY_NAMESPACE::mix(w, light.plain[c]),
                      b.colour[c] + i);
        }
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::shading {

SIMD_REGISTER(gouraud_run);

extern const ShadingStage gouraud;
constinit const ShadingStage gouraud{{{.axis = "shading",
                                       .name = "gouraud",
                                       .blurb = "light at the vertices, interpolated in between",
                                       .source = "Gouraud 1971",
                                       .kind = Kind::rung},
                                      Pass::shading,
                                      {.vertices = true},
                                      [](ShadingBlock& block, const FrameState& frame) {
                                          if (!block.lit) return block.model->run(block, frame);
                                          light_vertices(block, frame);
                                          SIMD_CALL(gouraud_run, block);
                                      }},
                                     {.unit_vertex_normals = true}};

} // namespace scanout::shade::shading
#endif
