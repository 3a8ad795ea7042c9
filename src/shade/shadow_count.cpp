#include "shade/shadow_count.h"

#include "base/check.h"

namespace scanout::shade {
namespace {

// Is the light on the side of the triangle that the eye sees?
bool lit(const Primitive& t, const FrameState& frame, const scene::ViewLight& light) {
    const DVec3 facing(t.facing[0], t.facing[1], t.facing[2]);
    DVec3 normal;
    for (int r = 0; r < 3; ++r) {
        const float* row = frame.normal_matrix[r];
        normal[r] = dot3(DVec3(row[0], row[1], row[2]), facing);
    }
    if (light.kind == scene::LightKind::directional) return dot3(normal, DVec3(light.towards)) > 0;
    const DVec3 corner(t.position[0][0], t.position[1][0], t.position[2][0]);
    return dot3(normal, DVec3(light.position) - corner) > 0;
}

// Of the samples of a pixel that show the triangle, the share over which nothing was counted.
float share_lit(const TileShadow& shadow, const float* count, std::uint32_t id, int x, int y) {
    const raster::VisibilityTile& tile = *shadow.tile;
    const auto at =
        static_cast<std::size_t>((y - tile.area().y0) * raster::kTileSize + (x - tile.area().x0));
    int shown = 0, bright = 0;
    for (int s = 0; s < tile.samples(); ++s) {
        if (tile.id(x, y, s) != id) continue;
        ++shown;
        if (count[at + static_cast<std::size_t>(s) * raster::VisibilityTile::kPlane] == 0) ++bright;
    }
    CHECK(shown > 0);
    return static_cast<float>(bright) / static_cast<float>(shown);
}

} // namespace

void shadow_by_counts(Block& b, const FrameState& frame) {
    if (!b.lit || frame.shadows.empty()) return;
    CHECK(b.shadow != nullptr);
    const TileShadow& shadow = *b.shadow;
    for (std::size_t k = 0; k < frame.lights.size(); ++k) {
        if (!frame.shadows[k].casts) continue;
        CHECK(shadow.count[k] != nullptr);
        for (int i = 0; i < b.runs; ++i) {
            const Run& run = b.run[i];
            const std::uint32_t id = run.primitive->id;
            if (!shadow.receives.empty() && shadow.receives[id] == 0) continue;
            const bool faces = lit(*run.primitive, frame, frame.lights[k]);
            for (int lane = run.first; lane < run.first + run.count; ++lane) {
                const int x = b.x[lane] >> raster::kSubpixelBits,
                          y = b.y[lane] >> raster::kSubpixelBits;
                const float share = faces ? share_lit(shadow, shadow.count[k], id, x, y) : 0.0F;
                for (auto& colour : b.light[k].colour)
                    colour[lane] *= share;
            }
        }
    }
}

} // namespace scanout::shade
