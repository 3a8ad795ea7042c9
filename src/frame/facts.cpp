#include "frame/facts.h"

#include <algorithm>
#include <cmath>

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

namespace {

constexpr float kFlat = 0x1p-16F; // bounding radii: so far off is still in the plane

bool lies_in(const geom::Mesh& mesh, std::size_t triangle, int axis, float at) {
    for (std::size_t k = 0; k < 3; ++k)
        if (std::abs(mesh.position[mesh.index[triangle * 3 + k]][axis] - at) > kFlat) return false;
    return true;
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
    Ground best;
    std::int64_t largest = 0;
    // Of equal sides that which is the floor where y is up, then where z is.
    for (const bool above : {false, true}) {
        for (const int axis : {1, 2, 0}) {
            Ground side{axis, above, above ? high[axis] : low[axis], 0};
            std::int64_t area = 0; // whole numbers: no order of triangles changes the sum
            for (std::size_t i = 0; i < mesh.triangles(); ++i) {
                if (!lies_in(mesh, i, axis, side.at)) continue;
                const DVec3 a(mesh.position[mesh.index[i * 3]]),
                    b(mesh.position[mesh.index[i * 3 + 1]]),
                    c(mesh.position[mesh.index[i * 3 + 2]]);
                area += static_cast<std::int64_t>(std::abs(cross3(b - a, c - a)[axis]) * 0x1p30);
                ++side.triangles;
            }
            if (area <= largest) continue;
            largest = area;
            best = side;
        }
    }
    return best;
}

std::vector<std::uint8_t> in_ground(const geom::Mesh& mesh, const Ground& ground) {
    std::vector<std::uint8_t> in(mesh.triangles(), 0);
    for (std::size_t i = 0; i < in.size() && ground.triangles > 0; ++i)
        in[i] = lies_in(mesh, i, ground.axis, ground.at) ? 1 : 0;
    return in;
}

SceneFacts facts(const scene::Scene& scene) {
    SceneFacts facts;
    const geom::Mesh& mesh = scene.mesh;
    facts.triangles = mesh.triangles();
    facts.lines = mesh.lines();
    facts.points = mesh.points();
    facts.uv = !mesh.uv.empty();
    facts.vertex_colours = !mesh.colour.empty();
    facts.ground = ground(mesh);
    const Census census(scene);
    facts.textured_triangles = census.count(facts, "texture", [&](const scene::Material& m) {
        return m.map_diffuse.texture >= 0 && facts.uv;
    });
    facts.specular_triangles =
        census.count(facts, "highlight", [](const scene::Material& m) { return has_highlight(m); });
    return facts;
}

} // namespace scanout::frame
