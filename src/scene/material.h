// Materials and textures as the files name them. Colours are linear; map_Kd is sRGB.
#pragma once

#include "image/image.h"
#include "math/vec.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace scanout::scene {

// What lies beyond the edges of a texture.
enum class Wrap : std::uint8_t { repeat, mirror, clamp };

// A texture map of a material: a texture of the scene and the options that the file gives it
// (MTL: -blendu -blendv -boost -mm -o -s -t -texres -clamp -bm -imfchan -type).
struct TextureMap {
    std::int32_t texture = -1; // index into Scene::textures; -1: none was read
    bool missing = false;      // it was wanted, but could not be read
    std::string path;          // as the file names it
    std::size_t line = 0;      // where it does
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    bool blend_u = true, blend_v = true, colour_correction = false;
    float boost = 0, base = 0, gain = 1, bump_multiplier = 1;
    float normal_scale = 1; // glTF: of a normal map's x and y
    Vec3 offset{0}, scale{1}, turbulence{0};
    int resolution = 0;
    char channel = 0; // r g b m l z, 0: not given
    std::string reflection_type;
    bool given() const { return !path.empty(); }
};

// A map that a material may have. Most have few of the thirteen, so only a given one takes memory.
class MaterialMap {
public:
    MaterialMap() = default;
    ~MaterialMap() = default;
    MaterialMap(TextureMap map) : map_(std::make_unique<TextureMap>(std::move(map))) {}
    MaterialMap(const MaterialMap& o)
        : map_(o.map_ ? std::make_unique<TextureMap>(*o.map_) : nullptr) {}
    MaterialMap(MaterialMap&&) noexcept = default;
    MaterialMap& operator=(MaterialMap o) noexcept {
        map_ = std::move(o.map_);
        return *this;
    }
    bool given() const { return map_ != nullptr && map_->given(); }
    std::int32_t texture() const { return map_ != nullptr ? map_->texture : -1; }
    const TextureMap& operator*() const { return map_ != nullptr ? *map_ : kNone; }
    const TextureMap* operator->() const { return &**this; }
    operator const TextureMap&() const { return **this; }
    TextureMap& edit() { // makes one where there is none
        if (map_ == nullptr) map_ = std::make_unique<TextureMap>();
        return *map_;
    }

private:
    static const TextureMap kNone;
    std::unique_ptr<TextureMap> map_;
};
inline const TextureMap MaterialMap::kNone;

struct Material {
    std::string name;
    Vec3 diffuse{0.8f};                        // Kd
    Vec3 ambient{0};                           // Ka: read, not used
    Vec3 specular{0};                          // Ks
    float shininess = 0;                       // Ns
    float opacity = 1;                         // d, or 1 - Tr
    bool unlit = false;                        // its colour is seen as it is, whatever the light
    bool one_sided = false;                    // glTF: its back is not seen
    std::optional<float> alpha_cut;            // glTF: seen where alpha reaches it, whole; else not
    Vec3 transmission{1};                      // Tf
    Vec3 emission{0};                          // Ke
    float refraction = 1;                      // Ni
    int illumination = 2;                      // illum
    std::optional<float> roughness, metalness; // Pr, Pm: 0 to 1
    MaterialMap map_diffuse, map_ambient, map_specular, map_shininess, map_opacity, map_emission;
    MaterialMap map_roughness, map_metalness; // map_Pr, map_Pm
    MaterialMap map_bump, map_normal, map_displacement, map_decal, map_reflection;
};

// What a file gives no material: this colour, with a soft highlight, so that forms show.
inline constexpr float kUnnamedGrey = 0.6F;
inline Material unnamed_material(const Vec3& colour = Vec3(kUnnamedGrey)) {
    Material material;
    material.diffuse = colour;
    material.specular = Vec3(0.15F);
    material.shininess = 20;
    return material;
}

// By the name in the file; those that are not drawn are read for reports alone.
struct NamedMap {
    std::string_view name;
    MaterialMap Material::*map;
    bool drawn = true;
};
inline constexpr std::array kTextureMaps = {NamedMap{"map_Kd", &Material::map_diffuse},
                                            NamedMap{"map_Ka", &Material::map_ambient, false},
                                            NamedMap{"map_Ks", &Material::map_specular},
                                            NamedMap{"map_Ns", &Material::map_shininess},
                                            NamedMap{"map_d", &Material::map_opacity},
                                            NamedMap{"map_Ke", &Material::map_emission},
                                            NamedMap{"map_Pr", &Material::map_roughness},
                                            NamedMap{"map_Pm", &Material::map_metalness},
                                            NamedMap{"map_bump", &Material::map_bump},
                                            NamedMap{"norm", &Material::map_normal},
                                            NamedMap{"disp", &Material::map_displacement, false},
                                            NamedMap{"decal", &Material::map_decal, false},
                                            NamedMap{"refl", &Material::map_reflection, false}};

// Ns 0, or no Ns, would put a highlight everywhere. Exporters that write it beside a bright Ks
// (MeshLab does) mean no highlight. Between 0 and 1 it fades (shade/reflection/highlight-inl.h).
inline bool has_highlight(const Material& m) {
    return m.shininess > 0 && (m.specular.x > 0 || m.specular.y > 0 || m.specular.z > 0);
}

// The reflection of a material, by the fields that the file gives.
enum class Surface : std::uint8_t { matt, glossy, physical };
inline constexpr int kSurfaces = 3;
inline Surface surface_of(const Material& m) {
    if (m.roughness || m.metalness) return Surface::physical;
    return has_highlight(m) ? Surface::glossy : Surface::matt;
}

// Defaults of a physical material that gives only one of the two.
inline float roughness_of(const Material& m) {
    return m.roughness ? *m.roughness : 0.5F;
}
inline float metalness_of(const Material& m) {
    return m.metalness ? *m.metalness : 0.0F;
}

struct Texture {
    std::string path; // the file that was read
    image::Image image;
};

} // namespace scanout::scene
