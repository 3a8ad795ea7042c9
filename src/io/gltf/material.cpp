#include "io/gltf/material.h"

#include "io/gltf/textures.h"
#include "io/text.h"
#include "io/vertex_colours.h"
#include "math/transcendental.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace scanout::io::gltf {
namespace {

constexpr double kMaxNumber = 1e6; // of emission, and how far a normal leans

float clamped(double value, double most) {
    return value > kDarkest ? static_cast<float>(std::min(value, most)) : 0;
}
Vec3 colour_of(const double* rgb, double times, double most) {
    return {clamped(rgb[0] * times, most), clamped(rgb[1] * times, most),
            clamped(rgb[2] * times, most)};
}

UvUse uv_of(const TextureInfo& info) {
    const TextureTransform& t = info.transform;
    UvUse use;
    use.set = info.set;
    if (t == TextureTransform()) return use;
    const double s = scanout::sin(t.rotation), c = scanout::cos(t.rotation);
    use.x = DVec2(c, -s) * t.scale.x;
    use.y = DVec2(s, c) * t.scale.y;
    use.offset = t.offset;
    return use;
}

// -s and -o of a map that reads coordinates made for another: `own` after the inverse of `made`.
// Nothing where that turns or shears, or reads another set.
struct Placement {
    DVec2 scale{1}, offset{0};
};
std::optional<Placement> placement(const UvUse& own, const UvUse& made) {
    if (own == made) return Placement(); // even where it has no inverse
    if (own.set != made.set) return std::nullopt;
    const double det = made.x.x * made.y.y - made.y.x * made.x.y;
    // Columns of own * made^-1, times the determinant.
    const DVec2 x = own.x * made.y.y - own.y * made.x.y, y = own.y * made.x.x - own.x * made.y.x;
    if (det == 0 || !std::isfinite(1 / det)) return std::nullopt;
    Placement p;
    p.scale = DVec2(x.x / det, y.y / det);
    const double most = std::max(std::abs(p.scale.x), std::abs(p.scale.y));
    if (std::max(std::abs(x.y / det), std::abs(y.x / det)) > most * 1e-9) return std::nullopt;
    p.offset = own.offset - p.scale * made.offset;
    return p;
}

class LookReader {
public:
    LookReader(const Document& document, Buffers& buffers, const std::string& path,
               Warnings& warnings, const Reading& how, Budget& budget)
        : d_(document), path_(path), warnings_(warnings),
          textures_(document, buffers, path, warnings, how, budget) {}

    Looks read(const std::vector<bool>& used) {
        Looks out;
        out.of.assign(d_.materials.size(), -1);
        out.uv.resize(d_.materials.size());
        for (std::size_t i = 0; i < used.size(); ++i) {
            if (!used[i]) continue;
            number_ = i;
            uv_ = {};
            out.of[i] = static_cast<std::int32_t>(out.materials.size());
            out.materials.push_back(material(d_.materials[i]));
            out.uv[i] = uv_;
        }
        out.bytes = textures_.bytes();
        out.textures = textures_.take();
        return out;
    }

private:
    scene::Material material(const MaterialInfo& m);
    scene::MaterialMap map(const TextureInfo& info, std::string_view name, Role role,
                           char channel = 0);

    const Document& d_;
    const std::string& path_;
    Warnings& warnings_;
    Textures textures_;
    std::size_t number_ = 0; // of the material that is read
    UvUse uv_;               // its faces' coordinates
};

scene::Material LookReader::material(const MaterialInfo& m) {
    for (const TextureInfo* first :
         {&m.emissive_texture, &m.normal, &m.metallic_roughness, &m.base_texture})
        if (first->texture >= 0) uv_ = uv_of(*first);
    scene::Material out;
    out.name = m.name;
    out.one_sided = !m.double_sided;
    const bool opaque = m.alpha_mode == AlphaMode::opaque;
    out.diffuse = colour_of(m.base_colour.data(), 1, 1);
    out.opacity = opaque ? 1 : clamped(m.base_colour[3], 1);
    if (m.alpha_mode == AlphaMode::mask) out.alpha_cut = clamped(m.alpha_cutoff, kMaxNumber);
    out.map_diffuse = map(m.base_texture, "baseColorTexture", opaque ? Role::opaque : Role::cut);
    if (m.unlit) {
        out.unlit = true;
        return out;
    }
    out.roughness = clamped(m.roughness, 1);
    out.metalness = clamped(m.metallic, 1);
    if (*out.roughness > 0)
        out.map_roughness = map(m.metallic_roughness, "metallicRoughnessTexture", Role::plain, 'g');
    if (*out.metalness > 0)
        out.map_metalness = map(m.metallic_roughness, "metallicRoughnessTexture", Role::plain, 'b');
    out.map_normal = map(m.normal, "normalTexture", Role::plain);
    if (out.map_normal.given())
        out.map_normal.edit().normal_scale =
            static_cast<float>(std::clamp(m.normal.scale, -kMaxNumber, kMaxNumber));
    out.emission = colour_of(m.emissive.data(), m.emissive_strength, kMaxNumber);
    if (out.emission != Vec3(0))
        out.map_emission = map(m.emissive_texture, "emissiveTexture", Role::plain);
    if (out.map_emission->missing) out.emission = Vec3(0); // not all of it is meant to shine
    return out;
}

scene::MaterialMap LookReader::map(const TextureInfo& info, std::string_view name, Role role,
                                   char channel) {
    if (info.texture < 0) return {};
    scene::TextureMap out;
    out.path = textures_.name_of(info.texture);
    out.channel = channel;
    const auto place = placement(uv_of(info), uv_);
    if (!place) {
        warnings_.add("glTF texture coordinates",
                      fmt::format("{}: materials[{}].{} has other texture coordinates than its "
                                  "first map; drawn without",
                                  path_, number_, name));
        out.missing = true;
        return out;
    }
    // In v, which runs up here.
    out.scale = Vec3(place->scale.x, place->scale.y, 1);
    out.offset = Vec3(place->offset.x, 1 - place->scale.y - place->offset.y, 0);
    const Index index = d_.textures[static_cast<std::size_t>(info.texture)].sampler;
    if (index >= 0) {
        const Sampler& sampler = d_.samplers[static_cast<std::size_t>(index)];
        out.wrap_u = sampler.wrap_s;
        out.wrap_v = sampler.wrap_t;
    }
    out.texture = textures_.find(info.texture, role);
    out.missing = out.texture < 0;
    return out;
}

} // namespace

Looks read_looks(const Document& document, const std::vector<bool>& used, Buffers& buffers,
                 const std::string& path, Warnings& warnings, const Reading& how, Budget& budget) {
    return LookReader(document, buffers, path, warnings, how, budget).read(used);
}

} // namespace scanout::io::gltf
