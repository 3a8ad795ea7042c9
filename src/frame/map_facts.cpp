#include "frame/map_facts.h"

namespace scanout::frame {

std::string_view map_effect(shade::Map map) {
    switch (map) {
    case shade::kNormalMap:
        return "normal_map";
    case shade::kBumpMap:
        return "bump_map";
    case shade::kSpecularMap:
        return "specular_map";
    case shade::kShininessMap:
        return "gloss_map";
    default:
        return {};
    }
}

MapFacts::Content MapFacts::content_of(const image::Image& image) {
    Content all;
    if (image.empty()) return all;
    const image::Rgba8 first = image.at(0, 0);
    for (const image::Rgba8& p : image.pixels()) {
        all.constant = all.constant && p == first;
        all.white = all.white && p.r == 255 && p.g == 255 && p.b == 255;
        all.black = all.black && p.r == 0 && p.g == 0 && p.b == 0;
        all.flat = all.flat && p.r == 128 && p.g == 128;
        all.opaque = all.opaque && p.a == 255;
        if (!(all.constant || all.white || all.black || all.flat || all.opaque)) break;
    }
    return all;
}

MapFacts::MapFacts(const scene::Scene& scene) {
    for (const scene::Texture& texture : scene.textures)
        content_.push_back(content_of(texture.image));
}

bool MapFacts::matters(const scene::Material& m, shade::Map map) const {
    const std::int32_t texture = (m.*shade::map_slots()[map].map).texture;
    if (texture < 0) return false;
    const Content& content = content_[static_cast<std::size_t>(texture)];
    switch (map) {
    case shade::kNormalMap:
        return !content.flat;
    case shade::kBumpMap:
        return !content.constant && m.map_bump.bump_multiplier != 0;
    case shade::kSpecularMap:
    case shade::kShininessMap:
        return !content.white && has_highlight(m);
    default:
        return false;
    }
}

} // namespace scanout::frame
