#include "frame/facts/alpha_facts.h"

#include "frame/facts/back_faces.h"

#include <algorithm>

namespace scanout::frame {
namespace {

AlphaClass of_codes(bool some_between, bool some_less) {
    return some_between ? AlphaClass::blended
                        : (some_less ? AlphaClass::cut_out : AlphaClass::opaque);
}

template <class Code>
AlphaClass of_texels(const image::Image& image, Code code) {
    bool some_between = false, some_less = false;
    for (const image::Rgba8& texel : image.pixels()) {
        const int c = code(texel);
        some_less |= c < 255;
        some_between |= c > 0 && c < 255;
        if (some_between) break;
    }
    return of_codes(some_between, some_less);
}

AlphaClass of_channel(const image::Image& image, char channel) {
    switch (channel) {
    case 'm':
        return of_texels(image, [](const image::Rgba8& t) { return int{t.a}; });
    case 'r':
        return of_texels(image, [](const image::Rgba8& t) { return int{t.r}; });
    case 'g':
        return of_texels(image, [](const image::Rgba8& t) { return int{t.g}; });
    case 'b':
        return of_texels(image, [](const image::Rgba8& t) { return int{t.b}; });
    default: // luminance: 0 and 1 are black and white alone
        return of_texels(image, [](const image::Rgba8& t) {
            const int least = std::min({t.r, t.g, t.b}), most = std::max({t.r, t.g, t.b});
            return most == 0 ? 0 : (least == 255 ? 255 : 128);
        });
    }
}

// Scans each texture once for each channel, however many materials use it.
class TextureClasses {
public:
    explicit TextureClasses(const scene::Scene& scene) : scene_(scene) {}

    AlphaClass of(const scene::TextureMap& map, char channel) {
        if (map.texture < 0 || scene_.mesh.uv.empty()) return AlphaClass::opaque;
        for (const Known& known : known_)
            if (known.texture == map.texture && known.channel == channel) return known.found;
        const auto& texture = scene_.textures[static_cast<std::size_t>(map.texture)];
        known_.push_back({map.texture, channel, of_channel(texture.image, channel)});
        return known_.back().found;
    }

private:
    struct Known {
        std::int32_t texture;
        char channel;
        AlphaClass found;
    };
    const scene::Scene& scene_;
    std::vector<Known> known_;
};

} // namespace

AlphaFacts alpha_facts(const scene::Scene& scene) {
    AlphaFacts facts;
    std::vector<std::size_t> uses(scene.materials.size() + 1, 0);
    for (std::size_t t = 0; t < scene.mesh.triangles(); ++t)
        if (!geom::is_collapsed(scene.mesh, t))
            ++uses[static_cast<std::size_t>(scene.mesh.material[t] + 1)];
    facts.of_material.assign(uses.size(), AlphaClass::opaque);
    facts.maps.resize(uses.size());
    TextureClasses textures(scene);
    for (std::size_t i = 0; i < uses.size(); ++i) {
        if (uses[i] == 0) continue;
        ++facts.materials;
        if (i == 0) continue; // the default material is opaque
        const scene::Material& m = scene.materials[i - 1];
        AlphaClass found = AlphaClass::unseen;
        if (m.alpha_cut ? m.opacity >= *m.alpha_cut : m.opacity > 0) {
            const AlphaClass diffuse = textures.of(m.map_diffuse, 'm');
            const AlphaClass opacity = textures.of(m.map_opacity, m.map_opacity->channel);
            found = m.opacity < 1 ? AlphaClass::blended : std::max(diffuse, opacity);
            if (m.alpha_cut && found != AlphaClass::opaque) found = AlphaClass::cut_out;
            facts.maps[i] = {diffuse != AlphaClass::opaque, opacity != AlphaClass::opaque};
        }
        facts.of_material[i] = found;
        const bool cut = found == AlphaClass::cut_out, blended = found == AlphaClass::blended,
                   unseen = found == AlphaClass::unseen;
        facts.cut_out_triangles += cut ? uses[i] : 0;
        facts.blended_triangles += blended ? uses[i] : 0;
        facts.unseen_triangles += unseen ? uses[i] : 0;
        facts.cut_out_materials += cut ? 1 : 0;
        facts.blended_materials += blended ? 1 : 0;
        facts.unseen_materials += unseen ? 1 : 0;
        if (!blended) continue;
        facts.min_opacity = std::min(facts.min_opacity, m.opacity);
        facts.blended_by_maps += m.opacity < 1 ? 0 : 1;
    }
    return facts;
}

} // namespace scanout::frame
