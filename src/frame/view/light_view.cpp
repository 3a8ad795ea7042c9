#include "frame/view/light_view.h"

#include "math/rotation.h"
#include "math/transcendental.h"

#include <algorithm>
#include <cmath>

namespace scanout::frame {
namespace {

constexpr double kWidestTan = 1.75;       // of half a single view: some 60 degrees
constexpr double kNearShare = 0x1p-14;    // of the distance to the model: nearer throws no shadow
constexpr double kFarShare = 1 + 0x1p-10; // views are wider than their contents by this factor

// Rows: right, up, back; back is a unit vector. Duff et al. 2017.
DMat3 looking_from(const DVec3& back) {
    const double sign = back.z < 0 ? -1 : 1;
    const double a = -1 / (sign + back.z), b = back.x * back.y * a;
    const DVec3 right(1 + sign * back.x * back.x * a, sign * b, -sign * back.x);
    const DVec3 up(b, sign + back.y * back.y * a, -back.y);
    return {DVec3(right.x, up.x, back.x), DVec3(right.y, up.y, back.y),
            DVec3(right.z, up.z, back.z)};
}

struct Bounds {
    DVec3 low{INFINITY}, high{-INFINITY};
    void add(const DVec3& p) {
        for (int c = 0; c < 3; ++c) {
            low[c] = std::min(low[c], p[c]);
            high[c] = std::max(high[c], p[c]);
        }
    }
    bool hold(const DVec3& p) const {
        bool holds = true;
        for (int c = 0; c < 3; ++c)
            holds = holds && low[c] <= p[c] && p[c] <= high[c];
        return holds;
    }
};

// Calls f with the corners of triangles, in light space. Skips clusters for which skips(middle,
// extent) is true after the earlier calls of f; along each axis, no corner of a cluster is farther
// from its middle than its extent.
template <class Skips, class F>
void for_corners(const geom::Mesh& mesh, const scene::View& view, const DMat3& rotation,
                 const DVec3& translation, Skips&& skips, F&& f) {
    const DMat3 linear = rotation * view.linear;
    const DVec3 offset = rotation * view.translation + translation;
    const std::span<const std::uint32_t> index = mesh.index_in_spatial_order();
    const auto call = [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            f(linear * DVec3(mesh.position[index[i]]) + offset);
    };
    if (mesh.clusters.empty()) return call(0, index.size());
    DVec3 stretch; // of a length, along each axis
    for (int r = 0; r < 3; ++r) {
        const DVec3 row(linear[0][r], linear[1][r], linear[2][r]);
        stretch[r] = scanout::sqrt(dot3(row, row));
    }
    const auto skipped = [&](const auto& sphere) {
        constexpr double kRounding = 0x1p-40;
        const DVec3 middle = linear * sphere.centre + offset;
        const DVec3 extent = stretch * (sphere.radius * (1 + kRounding)) +
                             (glm::abs(middle) + glm::abs(offset) + stretch) * kRounding;
        return skips(middle, extent);
    };
    using geom::Clusters;
    const std::span<const geom::Cluster> cluster = mesh.clusters.cluster;
    const auto call_cluster = [&](std::size_t c) {
        constexpr std::size_t kCorners = Clusters::kTriangles * 3;
        if (!skipped(cluster[c])) call(c * kCorners, std::min((c + 1) * kCorners, index.size()));
    };
    // Visits a sample of clusters from all over the mesh first: after these, most others can be
    // skipped.
    for (std::size_t c = 0; c < cluster.size(); c += Clusters::kGroup)
        call_cluster(c);
    for (std::size_t g = 0; g < mesh.clusters.group.size(); ++g) {
        if (skipped(mesh.clusters.group[g])) continue;
        const std::size_t end = std::min((g + 1) * Clusters::kGroup, cluster.size());
        for (std::size_t c = g * Clusters::kGroup; c < end; ++c)
            call_cluster(c);
    }
}

// half_x, half_y: half the extent of the map's inner part, at distance 1 in perspective.
LightView view_of(const scene::View& view, const DMat3& rotation, const DVec3& translation,
                  double half_x, double half_y, int size, int margin) {
    LightView made;
    made.rotation = rotation;
    made.translation = translation;
    made.size = size;
    const double inner = size / 2.0 - margin;
    made.texels_x = inner / half_x;
    made.texels_y = inner / half_y;
    made.half = size / 2.0;
    made.view.linear = rotation * view.linear;
    made.view.translation = rotation * view.translation + translation;
    made.view.half_width = made.half / made.texels_x;
    made.view.half_height = made.half / made.texels_y;
    return made;
}

LightView parallel(const scene::ViewLight& light, const geom::Mesh& mesh, const scene::View& view,
                   int size, int margin) {
    const DMat3 rotation = looking_from(normalized(DVec3(light.towards)));
    Bounds bounds;
    const auto within = [&](const DVec3& middle, const DVec3& extent) {
        return bounds.hold(middle - extent) && bounds.hold(middle + extent);
    };
    for_corners(mesh, view, rotation, DVec3(0), within, [&](const DVec3& p) { bounds.add(p); });
    const DVec3 middle = (bounds.low + bounds.high) / 2.0;
    // Keeps the map within the range of floats, however small or flat the casters are.
    const DVec3 half = (bounds.high - bounds.low) / 2.0 * kFarShare +
                       DVec3(std::max(radius_of(view) * 0x1p-20, 0x1p-60));
    LightView made = view_of(view, rotation, -middle, half.x, half.y, size, margin);
    made.view.projection = scene::Projection::orthographic;
    made.view.depth_origin = -half.z;
    made.view.depth_scale = 1 / (2 * half.z);
    return made;
}

double near_of(const scene::ViewLight& light, const scene::View& view) {
    const DVec3 way = view.translation - place_of(light, view);
    return std::max(scanout::sqrt(dot3(way, way)), radius_of(view) * 0x1p-6) * kNearShare;
}

LightView from_place(const scene::ViewLight& light, const scene::View& view, const DMat3& rotation,
                     double tan_x, double tan_y, int size, int margin) {
    LightView made =
        view_of(view, rotation, -(rotation * place_of(light, view)), tan_x, tan_y, size, margin);
    made.view.projection = scene::Projection::perspective;
    made.view.near_distance = near_of(light, view);
    return made;
}

// The tangents of the half angles that hold the model; more than kWidestTan where a part of it lies
// beside or behind the light.
DVec2 tangents(const scene::ViewLight& light, const geom::Mesh& mesh, const scene::View& view,
               const DMat3& rotation) {
    DVec2 widest(0);
    const auto within = [&](const DVec3& middle, const DVec3& extent) {
        const double nearest = -(middle.z + extent.z) * (1 - 0x1p-40);
        return nearest > 0 && std::abs(middle.x) + extent.x < widest.x * nearest &&
               std::abs(middle.y) + extent.y < widest.y * nearest;
    };
    for_corners(mesh, view, rotation, -(rotation * place_of(light, view)), within,
                [&](const DVec3& p) {
                    const bool ahead = p.z < 0;
                    widest.x = std::max(widest.x, ahead ? std::abs(p.x) / -p.z : 2 * kWidestTan);
                    widest.y = std::max(widest.y, ahead ? std::abs(p.y) / -p.z : 2 * kWidestTan);
                });
    return widest * kFarShare + DVec2(0x1p-20);
}

} // namespace

DVec3 place_of(const scene::ViewLight& light, const scene::View& view) {
    return DVec3(light.position) / to_floats(view);
}

double radius_of(const scene::View& view) {
    double radius = 0;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            radius = std::max(radius, std::abs(view.linear[c][r]));
    for (int c = 0; c < 3; ++c) // far from the eye positions are that coarse
        radius = std::max(radius, std::abs(view.translation[c]) * 0x1p-20);
    return std::max(radius, 0x1p-40);
}

scene::View view_about(const scene::ViewLight& light, const scene::View& view) {
    scene::View made = view;
    made.projection = scene::Projection::perspective;
    made.translation = view.translation - place_of(light, view);
    made.near_distance = near_of(light, view);
    made.half_width = made.half_height = 2 * kWidestTan; // a margin takes half a map at most
    return made;
}

void light_views(const scene::ViewLight& light, const geom::Mesh& mesh, const scene::View& view,
                 int size, int margin, std::vector<LightView>& out) {
    out.clear();
    if (light.kind == scene::LightKind::directional)
        return out.push_back(parallel(light, mesh, view, size, margin));
    const bool spot = light.kind == scene::LightKind::spot;
    const DVec3 ahead = spot ? DVec3(light.axis) : view.translation - place_of(light, view);
    const DMat3 rotation = looking_from(normalized(-ahead));
    DVec2 tan = tangents(light, mesh, view, rotation);
    if (spot && light.cos_outer > 0.5F) { // the cone, where it is narrower
        const double cosine = light.cos_outer;
        const double cone =
            scanout::sqrt(std::max(1 - cosine * cosine, 0.0)) / cosine * kFarShare + 0x1p-10;
        tan = {std::min(tan.x, cone), std::min(tan.y, cone)};
    }
    if (std::max(tan.x, tan.y) <= kWidestTan)
        return out.push_back(from_place(light, view, rotation, tan.x, tan.y, size, margin));
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            DVec3 back(0);
            back[axis] = side;
            out.push_back(from_place(light, view, looking_from(back), kFarShare, kFarShare,
                                     std::max(size / 2, 4 * margin), margin));
            out.back().half -= margin;
        }
    }
}

} // namespace scanout::frame
