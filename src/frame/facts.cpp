#include "frame/facts.h"

#include "base/check.h"
#include "frame/map_facts.h"
#include "math/bits.h"
#include "math/transcendental.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace scanout::frame {
namespace {

// What of a scene's materials and triangles calls for an effect.
class Census {
public:
    explicit Census(const scene::Scene& scene) : scene_(scene), uses_(scene.materials.size(), 0) {
        for (std::size_t t = 0; t < scene.mesh.triangles(); ++t) {
            if (geom::is_collapsed(scene.mesh, t)) continue;
            const std::int32_t material = scene.mesh.material[t];
            ++(material < 0 ? unnamed_ : uses_[static_cast<std::size_t>(material)]);
        }
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
        sets.emplace(effect, std::move(set));
        return count(calls);
    }
    template <class Predicate>
    std::size_t count(Predicate calls) const {
        std::size_t triangles = 0;
        for (std::size_t i = 0; i < uses_.size(); ++i)
            if (calls(scene_.materials[i])) triangles += uses_[i];
        return triangles;
    }

    // Of the materials that triangles have, times the brightest vertex colour. No surface gives
    // back more than it gets: what a file says beyond 1 counts as 1.
    template <class Diffuse>
    float brightest(Diffuse diffuse_of) const {
        const auto largest = [](const Vec3& c) { return std::max({c.x, c.y, c.z}); };
        const geom::Mesh& mesh = scene_.mesh;
        float diffuse = 0, colour = mesh.colour.empty() ? 1.0F : 0.0F;
        for (std::size_t i = 0; i < uses_.size(); ++i)
            if (uses_[i] > 0) diffuse = std::max(diffuse, largest(diffuse_of(scene_.materials[i])));
        if (unnamed_ > 0) diffuse = std::max(diffuse, largest(diffuse_of(scene::Material())));
        for (const Vec3& c : mesh.colour)
            colour = std::max(colour, largest(c));
        return std::min(diffuse * colour, 1.0F);
    }

private:
    const scene::Scene& scene_;
    std::vector<std::size_t> uses_; // triangles of each material; collapsed ones are not counted
    std::size_t unnamed_ = 0;       // and of none
};

} // namespace

namespace {

constexpr double kGroundFlat = 0x1p-16; // bounding radii: so far off is still in the plane

bool lies_in(const Vec3& position, const Ground& ground) {
    return std::abs(dot3(ground.normal, DVec3(position)) - ground.offset) <= kGroundFlat;
}
bool lies_in(const geom::Mesh& mesh, std::size_t triangle, const Ground& ground) {
    const std::uint32_t* v = &mesh.index[triangle * 3];
    return std::all_of(
        v, v + 3, [&](std::uint32_t corner) { return lies_in(mesh.position[corner], ground); });
}

} // namespace

Ground ground(const geom::Mesh& mesh) {
    Vec3 low(INFINITY), high(-INFINITY);
    for (const std::uint32_t v : mesh.index) {
        for (int c = 0; c < 3; ++c) {
            low[c] = std::min(low[c], mesh.position[v][c]);
            high[c] = std::max(high[c], mesh.position[v][c]);
        }
    }
    // Of equal sides that which is the floor where y is up, then where z is.
    std::array<Ground, 6> sides;
    std::array<std::int64_t, 6> area{}; // whole numbers: no order of triangles changes the sum
    for (std::size_t k = 0; k < 6; ++k) {
        const int axis = std::array{1, 2, 0}[k % 3];
        sides[k].normal[axis] = 1;
        sides[k].offset = k > 2 ? high[axis] : low[axis];
    }
    const DVec3 size = DVec3(high) - DVec3(low);
    const double extent = std::max({size.x, size.y, size.z});
    if (!(extent > 0)) return {};
    // Of a vertex a bit for every side that it lies in: few lie in any.
    std::vector<std::uint8_t> lies(mesh.position.size(), 0);
    for (std::size_t v = 0; v < lies.size(); ++v)
        for (std::size_t k = 0; k < 6; ++k)
            if (lies_in(mesh.position[v], sides[k])) lies[v] |= 1U << k;
    for (std::size_t i = 0; i < mesh.triangles(); ++i) {
        const std::uint32_t* v = &mesh.index[i * 3];
        for (unsigned rest = lies[v[0]] & lies[v[1]] & lies[v[2]]; rest != 0; rest &= rest - 1) {
            const auto k = static_cast<std::size_t>(std::countr_zero(rest));
            const DVec3 a(mesh.position[v[0]]), b(mesh.position[v[1]]), c(mesh.position[v[2]]);
            const double share =
                std::abs(dot3(cross3((b - a) / extent, (c - a) / extent), sides[k].normal));
            area[k] += static_cast<std::int64_t>(share * 0x1p30); // at most 1: 2^32 triangles fit
            ++sides[k].triangles;
        }
    }
    const auto best = std::max_element(area.begin(), area.end());
    return *best > 0 ? sides[static_cast<std::size_t>(best - area.begin())] : Ground();
}

Ground ground(const geom::Mesh& mesh, const FilePlane& plane) {
    const DVec3& n = plane.normal;
    const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
    CHECK(largest > 0);
    const DVec3 shorter = n / largest; // squares of any normal are numbers
    const double length = sqrt(dot3(shorter, shorter));
    Ground asked;
    asked.normal = shorter / length;
    // From the model's centre, and in units of the mesh.
    asked.offset =
        scale(plane.offset / largest / length - dot3(asked.normal, mesh.centre), -mesh.exponent);
    asked.asked = true;
    for (std::size_t i = 0; i < mesh.triangles(); ++i)
        asked.triangles += lies_in(mesh, i, asked) ? 1 : 0;
    return asked;
}

std::vector<std::uint8_t> in_ground(const geom::Mesh& mesh, const Ground& ground) {
    std::vector<std::uint8_t> in(mesh.triangles(), 0);
    for (std::size_t i = 0; i < in.size() && ground.triangles > 0; ++i)
        in[i] = lies_in(mesh, i, ground) ? 1 : 0;
    return in;
}

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
    facts.uv = !mesh.uv.empty();
    facts.vertex_colours = !mesh.colour.empty();
    facts.white_colours =
        facts.vertex_colours && std::all_of(mesh.colour.begin(), mesh.colour.end(),
                                            [](const Vec3& c) { return c == Vec3(1); });
    facts.ground = shadow_plane ? ground(mesh, *shadow_plane) : ground(mesh);
    const MapFacts maps(scene);
    facts.textured_surfaces = textured_surfaces(scene);
    for (TexturedSurface& surface : facts.textured_surfaces)
        surface.constant = maps.constant(surface.texture.texture);
    const Census census(scene);
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
                return (m.*shade::map_slots()[i].map).texture >= 0;
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
