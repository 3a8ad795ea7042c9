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
    case shade::kRoughnessMap:
        return "roughness_map";
    case shade::kMetalnessMap:
        return "metalness_map";
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
        all.white = all.white && p == image::Rgba8{255, 255, 255, 255};
        all.flat = all.flat && p.r == 128 && p.g == 128;
        if (!(all.constant || all.white || all.flat)) break;
    }
    return all;
}

MapFacts::MapFacts(const scene::Scene& scene) : content_(scene.textures.size()) {
    std::vector<bool> known(scene.textures.size(), false);
    for (const scene::Material& material : scene.materials) {
        for (std::size_t i = 0; i < shade::kMaps; ++i) {
            const std::int32_t texture = (material.*shade::map_slots()[i].map).texture;
            if (texture < 0 || map_effect(static_cast<shade::Map>(i)).empty()) continue;
            const auto t = static_cast<std::size_t>(texture);
            if (!known[t]) content_[t] = content_of(scene.textures[t].image);
            known[t] = true;
        }
    }
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
        return !content.white && surface_of(m) == scene::Surface::glossy;
    case shade::kRoughnessMap:
        return !content.white && surface_of(m) == scene::Surface::physical && roughness_of(m) > 0;
    case shade::kMetalnessMap:
        return !content.white && surface_of(m) == scene::Surface::physical && metalness_of(m) > 0;
    default:
        return false;
    }
}

} // namespace scanout::frame
