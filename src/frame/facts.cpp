#include "frame/facts.h"

#include "frame/map_facts.h"

namespace scanout::frame {
namespace {

// What of a scene's materials and triangles calls for an effect.
class Census {
public:
    explicit Census(const scene::Scene& scene) : scene_(scene), uses_(scene.materials.size(), 0) {
        for (const std::int32_t material : scene.mesh.material)
            if (material >= 0) ++uses_[static_cast<std::size_t>(material)];
    }

    // Notes the materials for which `calls` holds under the effect's name; returns how many
    // triangles have one of them.
    template <class Predicate>
    std::size_t count(SceneFacts& facts, std::string_view effect, Predicate calls) const {
        MaterialSet set(uses_.size() + 1, false);
        std::size_t triangles = 0;
        for (std::size_t i = 0; i < uses_.size(); ++i) {
            if (!calls(scene_.materials[i])) continue;
            set[i] = true;
            triangles += uses_[i];
        }
        facts.materials_of.emplace(effect, std::move(set));
        return triangles;
    }

private:
    const scene::Scene& scene_;
    std::vector<std::size_t> uses_; // triangles of each material
};

} // namespace

SceneFacts facts(const scene::Scene& scene) {
    SceneFacts facts;
    const geom::Mesh& mesh = scene.mesh;
    facts.triangles = mesh.triangles();
    facts.lines = mesh.lines();
    facts.points = mesh.points();
    facts.uv = !mesh.uv.empty();
    facts.vertex_colours = !mesh.colour.empty();
    facts.textured_surfaces = textured_surfaces(scene);
    const Census census(scene);
    facts.textured_triangles = census.count(
        facts, "texture", [&](const scene::Material& m) { return m.map_diffuse.texture >= 0; });
    facts.specular_triangles =
        census.count(facts, "highlight", [](const scene::Material& m) { return has_highlight(m); });
    const MapFacts maps(scene);
    for (std::size_t i = 0; i < shade::kMaps; ++i) {
        const auto map = static_cast<shade::Map>(i);
        for (const scene::Material& m : scene.materials)
            if ((m.*shade::map_slots()[i].map).texture >= 0)
                facts.readable_maps |= shade::bit_of(map);
        if (const std::string_view effect = map_effect(map); !effect.empty())
            facts.mapped_triangles[i] = census.count(
                facts, effect, [&](const scene::Material& m) { return maps.matters(m, map); });
    }
    facts.emitting_triangles = census.count(
        facts, "emission", [](const scene::Material& m) { return m.emission != Vec3(0); });
    return facts;
}

} // namespace scanout::frame
