#include "frame/facts/facts.h"

#include "frame/facts/map_facts.h"

#include <algorithm>
#include <array>

namespace scanout::frame {
namespace {

// Which materials and triangles of a scene call for an effect.
class Census {
public:
    explicit Census(const scene::Scene& scene) : scene_(scene), uses_(scene.materials.size(), 0) {
        for (std::size_t t = 0; t < scene.mesh.triangles(); ++t) {
            if (geom::is_collapsed(scene.mesh, t)) continue;
            const std::int32_t material = scene.mesh.material[t];
            ++(material < 0 ? unnamed_ : uses_[static_cast<std::size_t>(material)]);
        }
    }
    std::size_t all() const {
        return count([](const scene::Material&) { return true; });
    }
    bool all_have_materials() const { return unnamed_ == 0; }

    // Notes the materials for which `calls` holds under the effect's name; returns how many
    // triangles have one of them.
    template <class Predicate>
    std::size_t count(SceneFacts::MaterialSets& sets, std::string_view effect,
                      Predicate calls) const {
        MaterialSet set(uses_.size() + 1, false);
        for (std::size_t i = 0; i < uses_.size(); ++i)
            set[i] = calls(scene_.materials[i]);
        set.back() = calls(scene_.unnamed);
        sets.emplace(effect, std::move(set));
        return count(calls);
    }
    template <class Predicate>
    std::size_t count(Predicate calls) const {
        std::size_t triangles = 0;
        for (std::size_t i = 0; i < uses_.size(); ++i)
            if (calls(scene_.materials[i])) triangles += uses_[i];
        if (calls(scene_.unnamed)) triangles += unnamed_;
        return triangles;
    }

    // Reflectance of the materials that triangles have, times the brightest vertex colour. No
    // surface reflects more light than it receives: values above 1 in a file count as 1.
    template <class Diffuse>
    float brightest(Diffuse diffuse_of) const {
        const auto largest = [](const Vec3& c) { return std::max({c.x, c.y, c.z}); };
        const geom::Mesh& mesh = scene_.mesh;
        float diffuse = 0, colour = mesh.colour.empty() ? 1.0F : 0.0F;
        for (std::size_t i = 0; i < uses_.size(); ++i)
            if (uses_[i] > 0) diffuse = std::max(diffuse, largest(diffuse_of(scene_.materials[i])));
        if (unnamed_ > 0) diffuse = std::max(diffuse, largest(diffuse_of(scene_.unnamed)));
        for (const Vec3& c : mesh.colour)
            colour = std::max(colour, largest(c));
        return std::min(diffuse * colour, 1.0F);
    }

private:
    const scene::Scene& scene_;
    std::vector<std::size_t> uses_; // triangles of each material; collapsed ones are not counted
    std::size_t unnamed_ = 0;       // triangles without a material
};

} // namespace

static std::vector<bool> lets_through(const geom::Mesh& mesh, const AlphaFacts& alpha) {
    if (alpha.see_through_triangles() == 0) return {};
    std::vector<bool> of(mesh.triangles());
    for (std::size_t t = 0; t < of.size(); ++t)
        of[t] =
            alpha.of_material[static_cast<std::size_t>(mesh.material[t] + 1)] != AlphaClass::opaque;
    return of;
}

static std::optional<std::int32_t> only_material(const geom::Mesh& mesh) {
    if (mesh.material.empty() || mesh.lines() > 0 || mesh.points() > 0) return std::nullopt;
    const std::int32_t first = mesh.material.front();
    const bool all = std::all_of(mesh.material.begin(), mesh.material.end(),
                                 [&](std::int32_t material) { return material == first; });
    return all ? std::optional(first) : std::nullopt;
}

SceneFacts facts(const scene::Scene& scene, const std::optional<FilePlane>& shadow_plane) {
    SceneFacts facts;
    const geom::Mesh& mesh = scene.mesh;
    facts.triangles = mesh.triangles();
    facts.lines = mesh.lines();
    facts.points = mesh.points();
    facts.centre = mesh.centre;
    facts.exponent = mesh.exponent;
    facts.radius = mesh.radius;
    facts.box_size = mesh.box_max - mesh.box_min;
    facts.uv = !mesh.uv.empty();
    facts.vertex_colours = !mesh.colour.empty();
    facts.white_colours =
        facts.vertex_colours && std::all_of(mesh.colour.begin(), mesh.colour.end(),
                                            [](const Vec3& c) { return c == Vec3(1); });
    facts.shadow_plane =
        shadow_plane ? find_shadow_plane(mesh, *shadow_plane) : find_shadow_plane(mesh);
    facts.surroundings = surroundings_of(mesh);
    facts.section = scene.section;
    const MapFacts maps(scene);
    facts.textured_surfaces = textured_surfaces(scene);
    for (TexturedSurface& surface : facts.textured_surfaces)
        surface.constant = maps.constant(surface.texture.texture);
    const Census census(scene);
    facts.unlit_triangles = census.count([](const scene::Material& m) { return m.unlit; });
    facts.all_unlit = facts.unlit_triangles > 0 && facts.unlit_triangles == census.all();
    facts.one_sided_triangles = census.count([](const scene::Material& m) { return m.one_sided; });
    facts.all_one_sided =
        facts.one_sided_triangles > 0 && facts.one_sided_triangles == census.all();
    facts.one_sided = {std::uint8_t{scene.unnamed.one_sided}};
    for (const scene::Material& m : scene.materials)
        facts.one_sided.push_back(std::uint8_t{m.one_sided});
    facts.specular_triangles = census.count(
        facts.materials_of, "highlight", [&](const scene::Material& m) { return maps.shines(m); });
    SceneFacts::ByKs& by_ks = facts.by_ks;
    by_ks.specular_triangles =
        census.count(by_ks.materials_of, "highlight",
                     [&](const scene::Material& m) { return maps.shines_by_ks(m); });
    for (auto [map, triangles] : {std::pair(shade::kSpecularMap, &by_ks.specular_maps),
                                  {shade::kShininessMap, &by_ks.gloss_maps}})
        *triangles = census.count(
            by_ks.materials_of, map_effect(map),
            [&, map = map](const scene::Material& m) { return maps.matters_by_ks(m, map); });
    facts.physical_triangles = census.count(
        [](const scene::Material& m) { return surface_of(m) == scene::Surface::physical; });
    facts.only_material = only_material(mesh);
    facts.alpha = alpha_facts(scene);
    facts.topology = geom::topology(mesh, lets_through(mesh, facts.alpha));
    const auto materials = [&](auto... classes) {
        MaterialSet set(scene.materials.size() + 1, false);
        for (std::size_t i = 0; i < scene.materials.size(); ++i)
            set[i] = ((facts.alpha.of_material[i + 1] == classes) || ...);
        return set;
    };
    facts.materials_of.emplace("cut_out", materials(AlphaClass::cut_out, AlphaClass::unseen));
    facts.materials_of.emplace("blending", materials(AlphaClass::blended));
    facts.brightest = census.brightest([](const scene::Material& m) { return m.diffuse; });
    facts.brightest_mapped =
        census.brightest([&](const scene::Material& m) { return maps.brightest(m); });
    facts.black_by_maps =
        census.all_have_materials() &&
        census.count([&](const scene::Material& m) { return maps.reflects(m); }) == 0;
    for (std::size_t i = 0; i < shade::kMaps; ++i) {
        const auto map = static_cast<shade::Map>(i);
        if (census.count([&](const scene::Material& m) {
                return (m.*shade::map_slots()[i].map).texture() >= 0;
            }) > 0)
            facts.readable_maps |= shade::bit_of(map);
        const auto matters = [&](const scene::Material& m) { return maps.matters(m, map); };
        const std::string_view effect = map_effect(map);
        facts.mapped_triangles[i] = effect.empty()
                                        ? census.count(matters)
                                        : census.count(facts.materials_of, effect, matters);
    }
    facts.emitting_triangles = census.count(
        facts.materials_of, "emission", [&](const scene::Material& m) { return maps.emits(m); });
    return facts;
}

} // namespace scanout::frame
