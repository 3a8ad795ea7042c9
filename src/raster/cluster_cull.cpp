#include "raster/cluster_cull.h"

#include <algorithm>
#include <cmath>

namespace scanout::raster {

namespace {

constexpr double kNearer = 0x1p-20; // depths at samples are rounded (raster/coverage.h)

// At a place p of the mesh: its place in view space along these axes.
ClusterCull::Plane plane(const ScreenTransform& t, const DVec3& axis) {
    DVec3 normal(0);
    double offset = 0;
    for (int r = 0; r < 3; ++r) {
        normal = normal + DVec3(t.linear[r][0], t.linear[r][1], t.linear[r][2]) * axis[r];
        offset += t.translation[r] * axis[r];
    }
    return {normal, offset, std::sqrt(dot3(normal, normal)) * ClusterCull::kSlack};
}

} // namespace

ClusterCull::ClusterCull(const ScreenTransform& t, Facing keep) : transform_(t), terms_{} {
    Terms& s = terms_;
    s.turn = keep == Facing::any ? 0 : keep == Facing::front ? 1 : -1;
    s.perspective = t.perspective;
    s.near_w = t.box.near_w;
    s.x = plane(t, {1, 0, 0});
    s.y = plane(t, {0, 1, 0});
    s.z = plane(t, {0, 0, 1});
    s.w = t.perspective ? plane(t, {0, 0, -1}) : Plane{DVec3(0), 1, 0};
    const auto edge = [&](const Plane& axis, double scale, double from) {
        const DVec3 n = axis.normal * scale + s.w.normal * from;
        return Plane{n, axis.offset * scale + s.w.offset * from, std::sqrt(dot3(n, n)) * kSlack};
    };
    s.edge[0] = edge(s.x, t.scale_x, t.centre_x);
    s.edge[1] = edge(s.x, -t.scale_x, t.width - t.centre_x);
    s.edge[2] = edge(s.y, -t.scale_y, t.centre_y);
    s.edge[3] = edge(s.y, t.scale_y, t.height - t.centre_y);
    // The inverse by its adjugate.
    const DVec3 row[3] = {s.x.normal, s.y.normal, s.z.normal};
    const DVec3 across[3] = {cross3(row[1], row[2]), cross3(row[2], row[0]),
                             cross3(row[0], row[1])};
    const double determinant = dot3(row[0], across[0]);
    const DVec3 there = t.perspective
                            ? DVec3(-t.translation[0], -t.translation[1], -t.translation[2])
                            : DVec3(0, 0, -1);
    s.eye = (across[0] * there.x + across[1] * there.y + across[2] * there.z) / determinant;
    s.eye_length = std::sqrt(dot3(s.eye, s.eye));
    s.area = t.scale_x * t.scale_y * std::abs(determinant);
    s.scale = std::max(t.scale_x, t.scale_y);
    s.stretch =
        s.scale * std::sqrt(dot3(row[0], row[0]) + dot3(row[1], row[1]) + dot3(row[2], row[2]));
    s.most_aside = kGuardPixels - std::max(t.width, t.height);
}

std::optional<ClusterBounds> ClusterCull::bounds(const geom::Cluster& c) const {
    const ScreenTransform& t = transform_;
    struct Range {
        double least, most;
    };
    const auto range = [&](const Plane& axis) {
        const double middle = dot3(axis.normal, c.centre) + axis.offset,
                     reach = axis.length * c.radius * kSlack;
        return Range{middle - reach, middle + reach};
    };
    const Range w = range(terms_.w);
    if (!(w.least > t.box.near_w * (1 + 1e-6))) return std::nullopt;
    const auto pixels = [&](const Plane& axis, double scale, double centre) {
        const Range a = range(axis);
        const double least = a.least / (a.least > 0 ? w.most : w.least),
                     most = a.most / (a.most > 0 ? w.least : w.most);
        return Range{centre + std::min(least * scale, most * scale) - kBesidePixels,
                     centre + std::max(least * scale, most * scale) + kBesidePixels};
    };
    const Range x = pixels(terms_.x, t.scale_x, t.centre_x), y = pixels(terms_.y, -t.scale_y, t.centre_y);
    if (!(x.least > t.box.left && x.most < t.box.right && y.least > t.box.top &&
          y.most < t.box.bottom))
        return std::nullopt;
    const double nearest = t.perspective ? t.box.near_w / w.least
                                         : (range(terms_.z).most - t.depth_origin) * t.depth_scale +
                                               kNearer * kNearer; // of a difference
    const auto within = [](double at, int size) {
        return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(size)));
    };
    return ClusterBounds{{within(x.least, t.width), within(y.least, t.height),
                          within(x.most + 1, t.width), within(y.most + 1, t.height)},
                         static_cast<float>(nearest * (1 + kNearer))};
}

} // namespace scanout::raster
