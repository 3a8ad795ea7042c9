#include "frame/facts/minification.h"

#include "math/transcendental.h"

#include <algorithm>
#include <array>

namespace scanout::frame {
namespace {

// The mappings' turns of u or v a unit at the model's surface, except near the axis of round ones.
constexpr double kTurnsPerUnit = 0.5;

struct TexturedVertex {
    DVec3 position{0};
    DVec2 texel{0};
};

// The square of the greatest number of texels that a unit of the triangle's plane spans in any
// direction: the larger singular value of position -> texel. 0 for a triangle without area.
double squared_texels_per_unit(const std::array<TexturedVertex, 3>& c) {
    const DVec3 e1 = c[1].position - c[0].position, e2 = c[2].position - c[0].position;
    const DVec2 t1 = c[1].texel - c[0].texel, t2 = c[2].texel - c[0].texel;
    // J J^T = T G^-1 T^T, G the edges' inner products.
    const double g11 = dot3(e1, e1), g12 = dot3(e1, e2), g22 = dot3(e2, e2);
    const DVec3 normal = cross3(e1, e2);
    const double area = dot3(normal, normal);
    if (!(area > 0)) return 0;
    const auto product = [&](double x1, double x2, double y1, double y2) {
        return (x1 * y1 * g22 - (x1 * y2 + x2 * y1) * g12 + x2 * y2 * g11) / area;
    };
    const double a = product(t1.x, t2.x, t1.x, t2.x), b = product(t1.x, t2.x, t1.y, t2.y),
                 d = product(t1.y, t2.y, t1.y, t2.y);
    const double half = (a - d) / 2;
    return (a + d) / 2 + scanout::sqrt(half * half + b * b);
}

// texels_per_unit holds its square until all triangles are added.
void add(TexturedSurface& surface, const std::array<TexturedVertex, 3>& triangle, bool first) {
    surface.texels_per_unit = std::max(surface.texels_per_unit, squared_texels_per_unit(triangle));
    surface.planes.add(triangle[0].position, triangle[1].position, triangle[2].position);
    if (first) surface.box_min = surface.box_max = triangle[0].position;
    for (const TexturedVertex& vertex : triangle)
        for (int axis = 0; axis < 3; ++axis) {
            surface.box_min[axis] = std::min(surface.box_min[axis], vertex.position[axis]);
            surface.box_max[axis] = std::max(surface.box_max[axis], vertex.position[axis]);
        }
}

// A map that a material has: its texels over the whole range of u and v.
struct Use {
    shade::Map map;
    const scene::TextureMap* options;
    DVec2 size;
};
std::vector<std::vector<Use>> uses_of(const scene::Scene& scene) {
    std::vector<std::vector<Use>> uses(scene.materials.size());
    for (std::size_t m = 0; m < uses.size(); ++m)
        for (std::size_t i = 0; i < shade::kMaps; ++i) {
            const scene::TextureMap& map = scene.materials[m].*shade::map_slots()[i].map;
            if (map.texture < 0) continue;
            const image::Image& image = scene.textures[static_cast<std::size_t>(map.texture)].image;
            uses[m].push_back(
                {static_cast<shade::Map>(i), &map,
                 DVec2(double{map.scale.x} * image.width(), double{map.scale.y} * image.height())});
        }
    return uses;
}

} // namespace

std::vector<TexturedSurface> textured_surfaces(const scene::Scene& scene) {
    const geom::Mesh& mesh = scene.mesh;
    const std::vector<std::vector<Use>> uses = uses_of(scene);
    std::vector<TexturedSurface> found;
    constexpr std::size_t kNone = ~std::size_t{0};
    std::vector<std::size_t> first_of(scene.materials.size(), kNone); // surface of each material
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        if (mesh.material[t] < 0) continue;
        const auto m = static_cast<std::size_t>(mesh.material[t]);
        if (uses[m].empty()) continue;
        const bool first = first_of[m] == kNone;
        if (first) first_of[m] = found.size();
        std::size_t at = first_of[m];
        for (const Use& use : uses[m]) {
            if (first)
                found.push_back({.material = m,
                                 .map = use.map,
                                 .texture = shade::mip_use(use.map, *use.options),
                                 .wrap_u = use.options->wrap_u,
                                 .wrap_v = use.options->wrap_v});
            std::array<TexturedVertex, 3> vertex;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t v = mesh.index[3 * t + k];
                const DVec2 uv = mesh.uv.empty() ? DVec2(0) : DVec2(mesh.uv[v]);
                vertex[k] = {DVec3(mesh.position[v]), uv * use.size};
            }
            // Mappings lay a turn over the model's width, or more.
            found[at].texels_per_unit_mapped =
                std::max({use.size.x, -use.size.x, use.size.y, -use.size.y}) * kTurnsPerUnit;
            add(found[at++], vertex, first);
        }
    }
    for (TexturedSurface& surface : found)
        surface.texels_per_unit = scanout::sqrt(surface.texels_per_unit);
    return found;
}

Minification texels_per_pixel(const TexturedSurface& s, const scene::View& view, int width,
                              int height, bool mapped) {
    // The model is scaled along its axes, then turned: the columns' lengths are the scales.
    double min_scale = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double scale = scanout::sqrt(dot3(view.linear[axis], view.linear[axis]));
        min_scale = axis == 0 ? scale : std::min(min_scale, scale);
    }
    double deepest = 0, farthest = 0; // along the view, and from the eye
    for (int corner = 0; corner < 8; ++corner) {
        const DVec3 p((corner & 1) != 0 ? s.box_max.x : s.box_min.x,
                      (corner & 2) != 0 ? s.box_max.y : s.box_min.y,
                      (corner & 4) != 0 ? s.box_max.z : s.box_min.z);
        const DVec3 at = view.linear * p + view.translation;
        deepest = std::max(deepest, -at.z);
        farthest = std::max(farthest, scanout::sqrt(dot3(at, at)));
    }
    const double pixel = std::max(2 * view.half_width / width, 2 * view.half_height / height);
    const bool perspective = view.projection == scene::Projection::perspective;
    const double span = perspective ? pixel * deepest : pixel;
    const double texels = mapped ? s.texels_per_unit_mapped : s.texels_per_unit;
    if (!(span > 0)) return {};
    double steepest = s.planes.too_many() ? kMaxSlant : 1;
    for (const geom::Plane& plane : s.planes.planes())
        steepest = std::max(steepest, slant(plane, view, farthest));
    const double facing = texels * span / min_scale; // scale 0: infinitely many
    return {facing, facing * std::min(steepest, kMaxSlant)};
}

} // namespace scanout::frame
