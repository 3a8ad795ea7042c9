#include "frame/blank_picture.h"

#include "frame/view/bounding_sphere.h"
#include "rows.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace scanout::frame {
namespace {

// Triangles by what becomes of them in a view; the first that holds.
struct Triangles {
    std::size_t without_area = 0, unseen = 0, edge_on = 0, culled = 0, others = 0;
    DVec3 edge_on_normal{0}; // of one of them, view space
};

bool is_unseen(const FramePlan& plan, std::int32_t material) {
    const std::vector<raster::AlphaMode>& modes = plan.transparency.alpha_modes;
    return !modes.empty() &&
           modes[static_cast<std::size_t>(material + 1)] == raster::AlphaMode::nothing;
}

bool is_culled(const FramePlan& plan, std::int32_t material, bool back) {
    if (plan.options.cull == Cull::front) return !back;
    const bool one_sided =
        !plan.one_sided.empty() && plan.one_sided[static_cast<std::size_t>(material + 1)] != 0;
    return back && (plan.options.cull == Cull::back || one_sided);
}

// In the model's own coordinates: turned ones are rounded. A height below 2^-40 of the sides is
// none.
bool has_no_area(const geom::Mesh& mesh, std::size_t triangle) {
    const auto at = [&](std::size_t k) {
        return DVec3(mesh.position[mesh.index[3 * triangle + k]]);
    };
    const DVec3 u = at(1) - at(0), v = at(2) - at(0), n = cross3(u, v);
    return dot3(n, n) <= 0x1p-80 * dot3(u, u) * dot3(v, v);
}

Triangles sorted_out(const scene::Scene& scene, const scene::View& view, const FramePlan& plan) {
    constexpr double kEdgeOn = 0x1p-24; // sine of the angle between the line of sight and a face
    const geom::Mesh& mesh = scene.mesh;
    Triangles found;
    for (std::size_t i = 0; i < mesh.triangles(); ++i) {
        const auto at = [&](std::size_t k) {
            return view.linear * DVec3(mesh.position[mesh.index[3 * i + k]]) + view.translation;
        };
        const DVec3 a = at(0), n = cross3(at(1) - a, at(2) - a);
        const DVec3 sight =
            view.projection == scene::Projection::orthographic ? DVec3(0, 0, -1) : a;
        const double away = dot3(n, sight) * (view.mirrored ? -1 : 1);
        if (has_no_area(mesh, i)) {
            ++found.without_area;
        } else if (is_unseen(plan, mesh.material[i])) {
            ++found.unseen;
        } else if (std::abs(away) <= kEdgeOn * length(n) * length(sight)) {
            ++found.edge_on;
            found.edge_on_normal = n;
        } else if (is_culled(plan, mesh.material[i], away > 0)) {
            ++found.culled;
        } else {
            ++found.others;
        }
    }
    return found;
}

// The name of the view that looks along a direction of view space, as well as one does.
const char* view_along(const DVec3& direction, const scene::View& view, scene::UpAxis up) {
    const DVec3 world = scene::up_rotation(up) * (transpose(view.world_axes) * direction);
    const double x = std::abs(world.x), y = std::abs(world.y), z = std::abs(world.z);
    return y >= x && y >= z ? "top" : z >= x ? "front" : "right";
}

struct Found {
    Blank why;
    Triangles triangles;
};

Found find_why(const scene::Scene& scene, const scene::View& view, const FramePlan& plan) {
    const FrameOptions& o = plan.options;
    if (!row_or(raster::depth_test::kRows, o.depth_test, raster::depth_test::less).shows)
        return {Blank::depth_test, {}};
    if (scene.section && scene.section->empty) return {Blank::section, {}};
    if (!may_be_visible(view)) return {Blank::outside, {}};
    const Triangles t = sorted_out(scene, view, plan);
    const std::size_t all = scene.mesh.triangles();
    const bool faces_alone = scene.mesh.line_index.empty() && scene.mesh.point_index.empty();
    const auto why = [&] {
        if (all == 0 || !faces_alone || t.others > 0)
            return plan.transparency.cut_out != nullptr ? Blank::cut_out : Blank::no_sample;
        if (t.without_area == all) return Blank::no_area;
        if (t.unseen > 0 && t.edge_on + t.culled == 0) return Blank::clear;
        return t.culled > 0 ? Blank::culled : Blank::edge_on;
    };
    return {why(), t};
}

std::string say_why(const scene::Scene& scene, const scene::View& view, scene::UpAxis up,
                    const FramePlan& plan) {
    const FrameOptions& o = plan.options;
    const Found found = find_why(scene, view, plan);
    switch (found.why) {
    case Blank::depth_test:
        return fmt::format("--depth-test {} lets nothing through; leave it out", o.depth_test);
    case Blank::section:
        return fmt::format("--section {} cuts all of the model away; say another place, or the "
                           "other side",
                           scene.section->plane);
    case Blank::outside:
        return "the model lies outside of it; leave out what moves the camera or the model "
               "(--camera, --eye, --look-at, --translate), or say --view iso";
    case Blank::no_area:
        return fmt::format("none of the model's {} triangles has an area: their corners stand on a "
                           "line; check the coordinates in the file",
                           scene.mesh.triangles());
    case Blank::clear:
        return "the materials are clear (d, Tr or the alpha of maps is 0); "
               "--effect blending=off draws them opaque";
    case Blank::culled:
        if (!plan.decision("cull")->forced)
            return "the file says that its materials are one-sided, and shows their backs from "
                   "here; say --cull none";
        return fmt::format("--cull {} leaves out all faces that look this way; say --cull none",
                           o.cull == Cull::back ? "back" : "front");
    case Blank::edge_on:
        return fmt::format("the model is flat and seen from its edge; say --view {}",
                           view_along(found.triangles.edge_on_normal, view, up));
    case Blank::cut_out:
        return fmt::format("the materials are clear where it looks: alpha is below --alpha-cut "
                           "{:.3g}; --effect cut_out=off draws them whole",
                           o.alpha_cut);
    case Blank::no_sample:
        break;
    }
    return "no sample of it falls onto the model: it is too small or too thin from here, or the "
           "camera stands too near; say another --camera, or a larger --size";
}

} // namespace

Blank why_nothing_is_drawn(const scene::Scene& scene, const scene::View& view,
                           const FramePlan& plan) {
    return find_why(scene, view, plan).why;
}

std::optional<std::string> why_blank(const scene::Scene& scene, const scene::View& view,
                                     scene::UpAxis up, const FramePlan& plan,
                                     const FrameStats& stats, const image::Image& picture) {
    const auto is_background = [&](const image::Rgba8& p) { return p == plan.options.background; };
    const auto pixels = picture.pixels();
    if (!std::all_of(pixels.begin(), pixels.end(), is_background)) return {};
    const std::string blank = "the picture is blank: ";
    if (stats.items_shaded == 0) return blank + say_why(scene, view, up, plan);
    return blank + (plan.transparency.blended != nullptr || plan.transparency.cut_out != nullptr
                        ? "all that it shows of the model is transparent, or has the background's "
                          "colour; say another --background, or --effect blending=off"
                        : "all that it shows of the model has the background's colour; say another "
                          "--background, more light (--light, --exposure), or --view iso");
}

} // namespace scanout::frame
