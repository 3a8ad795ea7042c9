#include "shade/shadow/shadow_count.h"

#include "base/check.h"
#include "shade/shadow.h"
#include "shade/transparency/transparency_pass.h"

#include <algorithm>
#include <bit>

namespace scanout::shade {
namespace {

// The triangle's own normal, towards the eye, in view space.
DVec3 normal_of(const Primitive& t, const FrameState& frame) {
    const DVec3 facing(t.facing[0], t.facing[1], t.facing[2]);
    DVec3 normal;
    for (int r = 0; r < 3; ++r) {
        const float* row = frame.normal_matrix[r];
        normal[r] = dot3(DVec3(row[0], row[1], row[2]), facing);
    }
    return normal;
}

// Is the light on the side of the triangle that the eye sees?
bool lit(const Primitive& t, const DVec3& normal, const scene::ViewLight& light) {
    if (light.kind == scene::LightKind::directional) return dot3(normal, DVec3(light.towards)) > 0;
    const DVec3 corner(t.position[0][0], t.position[1][0], t.position[2][0]);
    return dot3(normal, DVec3(light.position) - corner) > 0;
}

// Of an item whose face turns away from the light: does its smooth normal receive it
// (terminator-inl.h)?
bool lit_as_round(const ShadingBlock& b, const DVec3& facing, std::size_t k, int item) {
    if (b.map[kNormalMap].texture != nullptr || b.map[kBumpMap].texture != nullptr) return false;
    const DVec3 normal(b.normal[0][item], b.normal[1][item], b.normal[2][item]);
    const auto& towards = b.light[k].towards;
    return dot3(normal, DVec3(towards[0][item], towards[1][item], towards[2][item])) > 0 &&
           dot3(normal, facing) > 0;
}

// The number of a pixel's samples that show the triangle, and of those outside of all shadows.
struct VisibleSamples {
    int samples = 0, bright = 0;
    // In the edge of the body's face that turns to the light, that one may not be counted.
    VisibleSamples without_edge(float most) const {
        return {samples, most > 0 && bright < samples ? 0 : bright};
    }
};

VisibleSamples visible_at(const TileShadow& shadow, const float* count, float most,
                          std::uint32_t id, int x, int y) {
    const raster::VisibilityTile& tile = *shadow.tile;
    const auto at =
        static_cast<std::size_t>((y - tile.area().y0) * raster::kTileSize + (x - tile.area().x0));
    const std::uint32_t* const ids = tile.ids(0).data();
    const auto end = static_cast<std::size_t>(tile.samples()) * raster::VisibilityTile::kPlane;
    VisibleSamples visible;
    for (std::size_t sample = at; sample < end; sample += raster::VisibilityTile::kPlane) {
        if (ids[sample] != id) continue;
        ++visible.samples;
        visible.bright += count[sample] <= most ? 1 : 0;
    }
    return visible.without_edge(most);
}

// The same for a blended surface, which stands in front of the counted surfaces.
VisibleSamples visible_blended(const TileShadow& shadow, const TilePolygons& polygons, float most,
                               const BlendedPixels& blended, std::uint32_t id, int x, int y) {
    const raster::VisibilityTile& tile = *shadow.tile;
    const int pixel = (y - tile.area().y0) * raster::kTileSize + (x - tile.area().x0);
    const BlendFragment* fragment = nullptr;
    for (const std::uint32_t i : blended.fragments(pixel))
        if (blended.list.fragments[i].id == id) fragment = &blended.list.fragments[i];
    CHECK(fragment != nullptr);
    VisibleSamples visible;
    for (unsigned left = fragment->visible; left != 0; left &= left - 1) {
        const int s = std::countr_zero(left);
        const raster::SampleOffset at = tile.pattern()[static_cast<std::size_t>(s)];
        const double depth = blended.list.depth_at(*fragment, s);
        float count = 0;
        for (const std::uint32_t i : polygons.here)
            count += stencil_at(polygons.all[i], x * raster::kSubpixel + at.x,
                                y * raster::kSubpixel + at.y, depth, id, polygons.where);
        ++visible.samples;
        if (count <= most) ++visible.bright; // blended triangles throw none
    }
    return visible.without_edge(most);
}

// The same for a part of a pixel, shaded at one place (1/256 pixel). Needs no depth, since shadow
// volumes do not run with areas.
VisibleSamples visible_by_area(const TileShadow& shadow, std::size_t k, std::uint32_t id,
                               std::int32_t x, std::int32_t y) {
    const TilePolygons& polygons = shadow.polygons[k];
    CHECK(polygons.where == raster::StencilWhere::everywhere);
    const image::Rect& area = shadow.tile->area();
    constexpr std::int32_t kInPixel = raster::kSubpixel - 1;
    if (raster::SampleOffset{x & kInPixel, y & kInPixel} == raster::kPixelCentre) { // most are
        const int column = (x >> raster::kSubpixelBits) - area.x0,
                  row = (y >> raster::kSubpixelBits) - area.y0;
        const float count = shadow.count[k][row * raster::kTileSize + column];
        return {.samples = 1, .bright = count == 0 ? 1 : 0};
    }
    const auto covers = [&](std::uint32_t i) {
        return stencil_at(polygons.all[i], x, y, 0, id, polygons.where) != 0;
    };
    const bool dark = std::any_of(polygons.here.begin(), polygons.here.end(), covers);
    return {.samples = 1, .bright = dark ? 0 : 1};
}

// Of an item's pixel, by samples.
VisibleSamples visible_by_samples(const ShadingBlock& b, std::size_t k, float most,
                                  std::uint32_t id, int item) {
    const TileShadow& shadow = *b.shadow;
    const int x = b.x[item] >> raster::kSubpixelBits, y = b.y[item] >> raster::kSubpixelBits;
    const VisibleSamples visible = visible_at(shadow, shadow.count[k], most, id, x, y);
    if (visible.samples > 0) return visible;
    CHECK(b.blended != nullptr);
    return visible_blended(shadow, shadow.polygons[k], most, *b.blended, id, x, y);
}

// Takes the light k from a run's items as far as it is not visible from them: visible_of(item).
template <class VisibleOf>
void shade_items(ShadingBlock& b, const Run& run, std::size_t k, const VisibleOf& visible_of) {
    for (int item = run.first; item < run.first + run.count; ++item) {
        const VisibleSamples visible = visible_of(item);
        CHECK_LT(0, visible.samples);
        const float visibility =
            static_cast<float>(visible.bright) / static_cast<float>(visible.samples);
        for (auto& colour : b.light[k].colour)
            colour[item] *= visibility;
    }
}

void shade_run(ShadingBlock& b, const FrameState& frame, const Run& run, std::size_t k) {
    const TileShadow& shadow = *b.shadow;
    const std::uint32_t id = run.primitive->id;
    if (!shadow.receives.empty() && shadow.receives[id] == 0) return;
    const DVec3 normal = normal_of(*run.primitive, frame);
    const bool face = lit(*run.primitive, normal, frame.lights[k]);
    const float most = face ? 0 : shadow.polygons[k].of_body;
    shade_items(b, run, k, [&](int item) {
        if (!face && !lit_as_round(b, normal, k, item))
            return VisibleSamples{.samples = 1, .bright = 0};
        return shadow.areas ? visible_by_area(shadow, k, id, b.x[item], b.y[item])
                            : visible_by_samples(b, k, most, id, item);
    });
}

} // namespace

void shadow_by_counts(ShadingBlock& b, const FrameState& frame) {
    if (!b.lit || frame.shadows == nullptr) return;
    CHECK(b.shadow != nullptr);
    for (std::size_t k = 0; k < frame.lights.size(); ++k) {
        if (!frame.shadows[k].casts) continue;
        CHECK(b.shadow->count[k] != nullptr);
        for (int i = 0; i < b.runs; ++i)
            shade_run(b, frame, b.run[i], k);
    }
}

} // namespace scanout::shade
