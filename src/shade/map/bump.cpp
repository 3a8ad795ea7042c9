// Bump mapping (map_bump): a texture gives heights, white above black, whose slopes tilt
// the normals: Blinn 1978, [Compendium 11.2]. The file gives no unit: a height of 1 is as high as
// -bm texels are wide, so that the picture does not depend on the model's size. The slope is the
// difference of the heights half a texel to both sides; half a pixel where pixels are larger.
#include "shade/map/bump_neighbours.h"
#include "shade/map/scalar.h"

#define SIMD_FILE "shade/map/bump.cpp"
#include "simd/for_each_target.h"

#include "shade/map/scalar-inl.h"
#include "shade/map/tangent-inl.h"
#include "shade/setup/footprint-inl.h"

SIMD_BEGIN(scanout::shade::map)

// Moves u and v by so many steps.
void bump_move(ShadingBlock& b, const BumpNeighbours& neighbours, float offset_u, float offset_v) {
    for (int i = 0; i < b.count; i += kLanes) {
        const F32 step = load<F32>(neighbours.step + i);
        store(load<F32>(neighbours.u + i) + step * F32(offset_u * neighbours.texel_u), b.u + i);
        store(load<F32>(neighbours.v + i) + step * F32(offset_v * neighbours.texel_v), b.v + i);
    }
}

void bump_keep(ShadingBlock& b, float* height) {
    for (int i = 0; i < b.count; i += kLanes)
        store(scalar_at(b, b.map[kBumpMap], i), height + i);
}

// Keeps the lanes' uv, and computes the distance to their neighbours, in texels.
void bump_begin(ShadingBlock& b, BumpNeighbours& neighbours) {
    const BoundMap& map = b.map[kBumpMap];
    const auto per_texel = [](float scale, int size) {
        const float texels = scale * static_cast<float>(size);
        return texels == 0 ? 0.0F : 1.0F / texels;
    };
    neighbours.texel_u = per_texel(map.map->scale.x, map.texture->image.width());
    neighbours.texel_v = per_texel(map.map->scale.y, map.texture->image.height());
    const F32 size_u = map.map->scale.x * static_cast<float>(map.texture->image.width());
    const F32 size_v = map.map->scale.y * static_cast<float>(map.texture->image.height());
    for (int i = 0; i < b.count; i += kLanes) {
        store(load<F32>(b.u + i), neighbours.u + i);
        store(load<F32>(b.v + i), neighbours.v + i);
        const F32 level = texture::HWY_NAMESPACE::level_of_detail<F32::Tag>(
            {load<F32>(b.u_x + i) * size_u, load<F32>(b.v_x + i) * size_v,
             load<F32>(b.u_y + i) * size_u, load<F32>(b.v_y + i) * size_v});
        store(exp2(maximum(level, F32(0.0F))) * F32(0.5F), neighbours.step + i);
    }
}

void bump_run(ShadingBlock& b, const FrameState& frame, const BumpNeighbours& neighbours) {
    write_tangents(b, frame);
    const scene::TextureMap& map = *b.map[kBumpMap].map;
    const float strength = map.bump_multiplier * 0.5F;
    const F32 along_u = map.scale.x < 0 ? -strength : strength,
              along_v = map.scale.y < 0 ? -strength : strength;
    for (int i = 0; i < b.count; i += kLanes) {
        const F32 inverse = F32(1.0F) / load<F32>(neighbours.step + i);
        const auto slope = [&](const float(&beyond)[kPaddedBlock],
                               const float(&before)[kPaddedBlock], F32 factor) SIMD_LAMBDA {
            return (load<F32>(before + i) - load<F32>(beyond + i)) * inverse * factor;
        };
        lean_normal(b, i,
                    {slope(neighbours.height[0], neighbours.height[1], along_u),
                     slope(neighbours.height[2], neighbours.height[3], along_v), F32(1.0F)});
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::map {

SIMD_REGISTER(bump_begin);
SIMD_REGISTER(bump_move);
SIMD_REGISTER(bump_keep);
SIMD_REGISTER(bump_run);

static void bump_texture(ShadingBlock& block, const FrameState& frame) {
    const BoundMap& map = block.map[kBumpMap];
    if (map.texture == nullptr) return;
    BumpNeighbours neighbours;
    SIMD_CALL(bump_begin, block, neighbours);
    constexpr float kOffset[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    for (int k = 0; k < 4; ++k) {
        SIMD_CALL(bump_move, block, neighbours, kOffset[k][0], kOffset[k][1]);
        frame.filter->sample(block, map, scalar_kind(map));
        SIMD_CALL(bump_keep, block, neighbours.height[k]);
    }
    SIMD_CALL(bump_move, block, neighbours, 0, 0);
    SIMD_CALL(bump_run, block, frame, neighbours);
}

extern const Stage bump;
constinit const Stage bump{
    {.axis = "map",
     .name = "bump",
     .blurb = "map_bump: the surface leans as if a texture's heights stood on it",
     .source = "Blinn 1978",
     .kind = Kind::effect},
    Pass::maps,
    {.normal = true,
     .uv = true,
     .ray = true,
     .facing = true,
     .footprint = true,
     .maps = bit_of(kBumpMap)},
    bump_texture};

} // namespace scanout::shade::map
#endif
