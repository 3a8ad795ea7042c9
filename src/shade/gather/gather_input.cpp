#include "shade/gather/gather_input.h"

#include "raster/clipped/clipped_triangle.h"

#include <algorithm>

namespace scanout::shade {

using raster::kSubpixel;

BoundMap bound_map(const GatherInput& in, Map map, const scene::Material& material) {
    const scene::TextureMap& options = material.*map_slots()[map].map;
    return {&in.textures[static_cast<std::size_t>(options.texture)], &options,
            in.mips->find(mip_use(map, options)), in.wrap.value_or(options.wrap_u),
            in.wrap.value_or(options.wrap_v)};
}

const scene::Material& GatherInput::material(std::int32_t index) const {
    return index >= 0 ? materials[static_cast<std::size_t>(index)] : *unnamed;
}

DVec2 GatherInput::uv_step(std::int32_t index) const {
    if (!frame->exact_uv || wrap == Wrap::clamp) return DVec2(0);
    return index >= 0 ? uv_steps[static_cast<std::size_t>(index)] : DVec2(2);
}

// Does a clipped triangle cover the point (1/256 pixel)?
static bool covers(const GatherInput& in, std::uint32_t triangle, std::int32_t x, std::int32_t y) {
    const raster::ClippedTriangles clipped = in.geometry->clipped_of(triangle);
    return std::any_of(clipped.begin(), clipped.end(), [&](const raster::ClippedTriangle& one) {
        return raster::covers(one, x, y);
    });
}

raster::SampleOffset place_in_pixel(const GatherInput& in, const Primitive& t, int x, int y,
                                    raster::SampleOffset sample) {
    const raster::SampleOffset centre = {x * kSubpixel + raster::kPixelCentre.x,
                                         y * kSubpixel + raster::kPixelCentre.y};
    // The weights of what was clipped are rounded: there the exact edges decide.
    const auto inside = [&](int k) {
        return (t.a[k] * centre.x + t.b[k] * centre.y) + t.c[k] >= t.least[k];
    };
    const bool covered =
        t.clipped ? covers(in, t.id, centre.x, centre.y) : inside(0) && inside(1) && inside(2);
    return covered ? centre
                   : raster::SampleOffset{x * kSubpixel + sample.x, y * kSubpixel + sample.y};
}

} // namespace scanout::shade
