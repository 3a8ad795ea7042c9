#include "frame/pass/annotations.h"

#include "frame/edges.h"
#include "geom/edge_lines.h"
#include "geom/ruler.h"
#include "math/transcendental.h"
#include "raster/culling/cull.h"

#include <algorithm>

namespace scanout::frame {
namespace {

// Linear. Greys of the middle show on black and on white.
constexpr Vec3 kAxisColour[3] = {{0.8F, 0.02F, 0.02F}, {0.02F, 0.5F, 0.02F}, {0.05F, 0.1F, 1}};
constexpr Vec3 kBoxColour{0.4F, 0.4F, 0.4F}, kGridColour{0.15F, 0.15F, 0.15F};
constexpr Vec3 kNormalColour{0.02F, 0.3F, 0.9F}, kPointColour{0.9F, 0.2F, 0};
constexpr int kPointSize = 3; // pixels, at least: one is hard to see

// Of what the model's triangles reflect, by their materials and vertices alone:
// maps are not read.
float mean_luminance(const scene::Scene& scene) {
    const auto luminance = [](const Vec3& c) {
        return double{0.2126} * c.x + double{0.7152} * c.y + double{0.0722} * c.z;
    };
    std::vector<std::int64_t> triangles(scene.materials.size() + 1); // of each material
    for (const std::int32_t material : scene.mesh.material)
        ++triangles[static_cast<std::size_t>(material + 1)];
    double sum = 0;
    std::int64_t count = 0;
    for (std::size_t m = 0; m < triangles.size(); ++m) {
        const scene::Material& material = m == 0 ? scene.unnamed : scene.materials[m - 1];
        sum += luminance(material.diffuse) * static_cast<double>(triangles[m]);
        count += triangles[m];
    }
    return count > 0 ? static_cast<float>(sum / static_cast<double>(count)) : 0;
}

// Black, or white on a model so dark that black would not show.
Vec3 contrasting(const scene::Scene& scene) {
    constexpr float kDark = 0.05F; // under a quarter of white's code
    return Vec3(mean_luminance(scene) < kDark ? 1.0F : 0.0F);
}

geom::AxisDirection direction_of(scene::UpAxis up) {
    using enum scene::UpAxis;
    const bool x = up == plus_x || up == minus_x, y = up == plus_y || up == minus_y;
    return {x ? 0 : (y ? 1 : 2), up == minus_x || up == minus_y || up == minus_z};
}

} // namespace

void AnnotationPass::make(const scene::Scene& scene, const AnnotationPlan& plan, scene::UpAxis up) {
    mesh_ = {};
    lines_.colours.clear();
    const auto colour_new_lines = [&](const Vec3& colour) {
        mesh_.line_material.resize(mesh_.lines(), static_cast<std::int32_t>(lines_.colours.size()));
        lines_.colours.push_back(colour);
    };
    const geom::Mesh& mesh = scene.mesh;
    const auto has = [&](Annotation a) { return plan.annotations.has(a); };
    // At equal depth what is made first is visible.
    for (int axis = 0; axis < 3 && has(Annotation::axes); ++axis) {
        geom::add_axis_line(mesh, axis, mesh_);
        colour_new_lines(kAxisColour[axis]);
    }
    if (has(Annotation::box)) {
        geom::add_box_lines(mesh, mesh_);
        colour_new_lines(kBoxColour);
    }
    if (has(Annotation::normals)) {
        geom::add_normal_lines(mesh, mesh_);
        colour_new_lines(kNormalColour);
    }
    if (has(Annotation::grid)) {
        geom::add_grid_lines(mesh, direction_of(up), mesh_);
        colour_new_lines(kGridColour);
    }
    if (has(Annotation::points)) {
        geom::add_vertex_points(mesh, mesh_);
        mesh_.point_material.resize(mesh_.points(),
                                    static_cast<std::int32_t>(lines_.colours.size()));
        lines_.colours.push_back(kPointColour);
    }
    if (plan.edges != nullptr) {
        std::optional<double> feature_cosine;
        if (plan.edges->of == Edges::Of::features) feature_cosine = cos_degrees(plan.edge_angle);
        geom::add_edge_lines(mesh, feature_cosine, mesh_);
        colour_new_lines(contrasting(scene));
    }
}

void AnnotationPass::run(Jobs& jobs, const scene::Scene& scene, const FramePlan& plan,
                         scene::UpAxis up, const raster::ScreenTransform& transform,
                         const raster::GeometryOptions& options, int scale) {
    const Key key{scene.mesh_revision(), plan.annotations, up};
    if (key_ != key || scene.mesh_revision() == 0) make(scene, plan.annotations, up);
    key_ = key;
    const geom::Mesh& mesh = scene.mesh;
    lines_.first_id = static_cast<std::uint32_t>(mesh.triangles() + mesh.lines() + mesh.points());
    lines_.mesh = &mesh_;
    raster::GeometryOptions own = options;
    own.alpha_modes = {};
    own.one_sided = {};
    own.occlusion = nullptr;
    own.first_line = lines_.first_id;
    own.line_width = plan.options.line_width * scale;
    own.point_size = std::max(plan.options.point_size, kPointSize) * scale;
    geometry_.run(jobs, mesh_, transform, own);
    raster::CullOptions cull;
    cull.keep = options.one_sided.empty() ? options.keep : raster::Facing::front;
    cull.mirrored = options.mirrored;
    one_sided_ = options.one_sided;
    culled_.reset();
    if (!raster::keeps_facing(cull, true)) culled_ = raster::LineSupport::Winding::clockwise;
    if (!raster::keeps_facing(cull, false))
        culled_ = raster::LineSupport::Winding::counter_clockwise;
}

void AnnotationPass::draw(int tile, const raster::Geometry& scene,
                          raster::VisibilityTile& out) const {
    geometry_.draw_lines(tile, scene.line_support().of(mesh_, lines_.first_id, culled_, one_sided_),
                         out);
}

std::uint64_t AnnotationPass::bytes() const {
    const auto of = [](const auto& list) { return list.capacity() * sizeof(list[0]); };
    return of(mesh_.position) + of(mesh_.line_index) + of(mesh_.line_material) +
           of(mesh_.line_faces.list) + of(mesh_.line_faces.begin) + of(mesh_.line_faces.triangle) +
           of(mesh_.point_index) + of(mesh_.point_material);
}

} // namespace scanout::frame
