#include "frame/facts/map_facts.h"

#include "math/srgb.h"

#include <algorithm>

namespace scanout::frame {
namespace {

using Codes = std::array<std::uint8_t, 4>;

// Does this hold for a channel of the texels that a scalar map is read from: the channel of
// -imfchan, else red, green or blue?
bool any_channel(const scene::TextureMap& map, const Codes& codes, bool (*holds)(std::uint8_t)) {
    switch (map.channel) {
    case 'r':
        return holds(codes[0]);
    case 'g':
        return holds(codes[1]);
    case 'b':
        return holds(codes[2]);
    case 'm':
        return holds(codes[3]);
    default:
        return holds(codes[0]) || holds(codes[1]) || holds(codes[2]);
    }
}

bool less_than_1(std::uint8_t code) {
    return code < 255;
}
bool above_0(std::uint8_t code) {
    return code > 0;
}

// Whether multiplying a colour by a texel as dark as this one changes the colour.
bool darkened(const Vec3& colour, const Codes& min) {
    for (std::size_t c = 0; c < 3; ++c)
        if (colour[static_cast<int>(c)] > 0 && min[c] < 255) return true;
    return false;
}

} // namespace

std::string_view map_effect(shade::Map map) {
    switch (map) {
    case shade::kDiffuseMap:
        return "texture";
    case shade::kNormalMap:
        return "normal_map";
    case shade::kBumpMap:
        return "bump_map";
    case shade::kSpecularMap:
        return "specular_map";
    case shade::kShininessMap:
        return "gloss_map";
    case shade::kRoughnessMap:
        return "roughness_map";
    case shade::kMetalnessMap:
        return "metalness_map";
    default:
        return {};
    }
}

MapFacts::Range MapFacts::range_of(const image::Image& image) {
    Range all;
    for (const image::Rgba8& p : image.pixels()) {
        const Codes codes{p.r, p.g, p.b, p.a};
        for (std::size_t c = 0; c < 4; ++c) {
            all.min[c] = std::min(all.min[c], codes[c]);
            all.max[c] = std::max(all.max[c], codes[c]);
        }
    }
    return all;
}

MapFacts::MapFacts(const scene::Scene& scene)
    : coordinates_(!scene.mesh.uv.empty()), ranges_(scene.textures.size()) {
    for (std::size_t i = 0; i < ranges_.size(); ++i)
        ranges_[i] = range_of(scene.textures[i].image);
}

const MapFacts::Range* MapFacts::range(const scene::Material& m, shade::Map map) const {
    const std::int32_t texture = (m.*shade::map_slots()[map].map).texture();
    return texture < 0 ? nullptr : &ranges_[static_cast<std::size_t>(texture)];
}

bool MapFacts::constant(std::int32_t texture) const {
    const Range& range = ranges_[static_cast<std::size_t>(texture)];
    return range.min == range.max;
}

bool MapFacts::is_black(const Vec3& colour, const Range* range) const {
    for (std::size_t c = 0; c < 3; ++c)
        if (colour[static_cast<int>(c)] > 0 &&
            (range == nullptr || !coordinates_ || range->max[c] > 0))
            return false;
    return true;
}

bool MapFacts::reflects(const scene::Material& m) const {
    return !is_black(m.diffuse, range(m, shade::kDiffuseMap));
}

bool MapFacts::shines(const scene::Material& m) const {
    return surface_of(m) == scene::Surface::physical || shines_by_ks(m);
}

bool MapFacts::shines_by_ks(const scene::Material& m) const {
    if (!has_highlight(m)) return false;
    const Range* const exponent = range(m, shade::kShininessMap);
    const bool dull = exponent != nullptr && coordinates_ &&
                      !any_channel(m.map_shininess, exponent->max, above_0);
    return !dull && !is_black(m.specular, range(m, shade::kSpecularMap));
}

bool MapFacts::emits(const scene::Material& m) const {
    return (m.unlit && reflects(m)) || !is_black(m.emission, range(m, shade::kEmissionMap));
}

Vec3 MapFacts::brightest(const scene::Material& m) const {
    const Range* const texels = range(m, shade::kDiffuseMap);
    if (texels == nullptr) return m.diffuse;
    const auto at_most = [&](std::size_t c) { return srgb_decode(texels->max[c]); };
    return m.diffuse * Vec3(at_most(0), at_most(1), at_most(2));
}

bool MapFacts::matters_by_ks(const scene::Material& m, shade::Map map) const {
    const Range* const texels = range(m, map);
    if (texels == nullptr || !shines_by_ks(m)) return false;
    return map == shade::kSpecularMap ? darkened(m.specular, texels->min)
                                      : any_channel(m.map_shininess, texels->min, less_than_1);
}

bool MapFacts::matters(const scene::Material& m, shade::Map map) const {
    const Range* const texels = range(m, map);
    if (texels == nullptr) return false;
    const scene::Surface surface = surface_of(m);
    // The surface reflects some light, and how much depends on the direction of its normal.
    const bool lit = m.diffuse != Vec3(0) || shines(m);
    switch (map) {
    case shade::kDiffuseMap:
        return darkened(m.diffuse, texels->min);
    case shade::kEmissionMap:
        return darkened(m.emission, texels->min);
    case shade::kNormalMap: // red and green of 128: no slope
        return lit && m.map_normal->normal_scale != 0 &&
               !(texels->min[0] == 128 && texels->max[0] == 128 && texels->min[1] == 128 &&
                 texels->max[1] == 128);
    case shade::kBumpMap:
        return lit && texels->min != texels->max && m.map_bump->bump_multiplier != 0;
    case shade::kSpecularMap:
    case shade::kShininessMap:
        return surface == scene::Surface::glossy && matters_by_ks(m, map);
    case shade::kRoughnessMap:
        return surface == scene::Surface::physical && roughness_of(m) > 0 &&
               any_channel(m.map_roughness, texels->min, less_than_1);
    case shade::kMetalnessMap:
        return surface == scene::Surface::physical && metalness_of(m) > 0 &&
               any_channel(m.map_metalness, texels->min, less_than_1);
    default:
        return false;
    }
}

} // namespace scanout::frame
