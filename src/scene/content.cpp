#include "scene/content.h"

#include "image/hash.h"

#include <span>
#include <type_traits>

namespace scanout::scene {
namespace {

// Adds the number of elements before the elements: what ends one list cannot begin the next.
class ContentHasher {
public:
    template <class T>
    void list(const std::vector<T>& values) {
        static_assert(std::has_unique_object_representations_v<T> || std::is_same_v<T, Vec2> ||
                      std::is_same_v<T, Vec3> || std::is_same_v<T, DVec2>); // no padding
        value(values.size());
        hasher_.add(std::as_bytes(std::span(values)));
    }
    void text(const std::string& value_of) {
        value(value_of.size());
        hasher_.add(std::as_bytes(std::span(value_of)));
    }
    template <class T>
    void value(const T& one) {
        static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, Vec3> ||
                      std::is_same_v<T, DVec3>);
        hasher_.add(std::as_bytes(std::span(&one, 1)));
    }
    template <class... T>
    void values(const T&... all) {
        (value(all), ...);
    }
    void optional(const std::optional<float>& one) {
        value(one.has_value());
        value(one.value_or(0));
    }
    void picture(const image::Image& picture) {
        values(picture.width(), picture.height());
        hasher_.add(std::as_bytes(picture.pixels()));
    }
    std::uint64_t hash() const { return hasher_.hash(); }

private:
    image::Hasher hasher_;
};

void add(const geom::Mesh& mesh, ContentHasher& hash) {
    hash.list(mesh.position);
    hash.list(mesh.normal);
    hash.list(mesh.uv);
    hash.list(mesh.exact_uv);
    hash.list(mesh.colour);
    hash.list(mesh.index);
    hash.list(mesh.material);
    hash.list(mesh.face);
    hash.list(mesh.line_index);
    hash.list(mesh.line_material);
    hash.list(mesh.point_index);
    hash.list(mesh.point_material);
    hash.values(mesh.centre, mesh.exponent, mesh.radius);
}

void add(const TextureMap& map, ContentHasher& hash) {
    hash.values(map.texture, map.blend_u, map.blend_v, map.wrap_u, map.wrap_v,
                map.colour_correction, map.boost, map.base, map.gain, map.bump_multiplier,
                map.offset, map.scale, map.turbulence, map.resolution, map.channel);
    hash.text(map.reflection_type);
    hash.value(map.normal_scale);
}

void add(const Material& m, ContentHasher& hash) {
    hash.values(m.diffuse, m.ambient, m.specular, m.shininess, m.opacity, m.transmission,
                m.emission, m.refraction, m.illumination);
    hash.optional(m.roughness);
    hash.optional(m.metalness);
    hash.values(m.unlit, m.one_sided);
    hash.optional(m.alpha_cut);
    for (const NamedMap& row : kTextureMaps)
        add(*(m.*row.map), hash);
}

} // namespace

std::uint64_t content_hash(const Scene& scene) {
    ContentHasher hash;
    add(scene.mesh, hash);
    add(scene.unnamed, hash);
    hash.value(scene.materials.size());
    for (const Material& material : scene.materials)
        add(material, hash);
    hash.value(scene.textures.size());
    for (const Texture& texture : scene.textures)
        hash.picture(texture.image);
    return hash.hash();
}

} // namespace scanout::scene
