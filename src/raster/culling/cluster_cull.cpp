#include "raster/culling/cluster_cull.h"

#include <algorithm>
#include <cmath>

#define SIMD_FILE "raster/culling/cluster_cull.cpp"
#include "simd/for_each_target.h"

SIMD_BEGIN(scanout::raster)

using Terms = ClusterCull::Terms;
using MaskF64x8 = F64x8::DoubleMask;

constexpr double kSlack = ClusterCull::kSlack, kBesidePixels = ClusterCull::kBesidePixels;
constexpr double kAngle = 1e-6; // slack of the sine of an angle
// Vertices move by up to half a step each way, an edge by twice that.
constexpr double kMove = 1.4143 / kSubpixel;

struct ClusterLanes {
    F64x8 centre[3], radius, axis[3], spread, thinnest;
};

SIMD_INLINE ClusterLanes clusters_at(const geom::Cluster* first, int count) {
    constexpr int kWords = sizeof(geom::Cluster) / sizeof(double);
    const auto* words = reinterpret_cast<const double*>(first);
    const I32x8 at = minimum(iota<I32x8>(0), I32x8(count - 1)) * I32x8(kWords);
    const auto word = [&](std::size_t offset)
                          SIMD_LAMBDA { return gather(words + offset / sizeof(double), at); };
    ClusterLanes c;
    SIMD_FOR (std::size_t k = 0; k < 3; ++k) {
        c.centre[k] = word(offsetof(geom::Cluster, centre) + k * sizeof(double));
        c.axis[k] = word(offsetof(geom::Cluster, axis) + k * sizeof(double));
    }
    c.radius = word(offsetof(geom::Cluster, radius));
    c.spread = word(offsetof(geom::Cluster, spread));
    c.thinnest = word(offsetof(geom::Cluster, thinnest));
    return c;
}

SIMD_INLINE F64x8 dot(const F64x8 (&a)[3], const F64x8 (&b)[3]) {
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}
SIMD_INLINE F64x8 at_centre(const ClusterCull::Plane& p, const ClusterLanes& c) {
    const F64x8 normal[3] = {p.normal.x, p.normal.y, p.normal.z};
    return dot(normal, c.centre) + F64x8(p.offset);
}

// All on one side of an edge of the picture, by more than a sample can reach.
SIMD_INLINE MaskF64x8 beside(const Terms& t, const ClusterLanes& c, F64x8 most_w) {
    const F64x8 radius = c.radius * F64x8(kSlack), limit = most_w * F64x8(-kBesidePixels);
    const auto past = [&](const ClusterCull::Plane& edge) SIMD_LAMBDA {
        return at_centre(edge, c) + F64x8(edge.length) * radius < limit;
    };
    return (past(t.edge[0]) | past(t.edge[1])) | (past(t.edge[2]) | past(t.edge[3]));
}

// Every triangle's normal n and vertex p have n . (p - eye) >= sine |p - eye|, and so none is
// smaller on the screen than its snapping could turn over: twice its area there is
//     scale_x scale_y det n . (p - eye) 2 area / (w0 w1 w2),
// and moving its vertices changes that by at most 2 side kMove + kMove^2. Both by its longest side.
SIMD_INLINE MaskF64x8 back_facing_clusters(const Terms& t, const ClusterLanes& c, F64x8 least_w,
                                           F64x8 most_w) {
    const F64x8 zero = 0.0, one = 1.0;
    const F64x8 eye[3] = {t.eye.x, t.eye.y, t.eye.z};
    F64x8 from_eye[3] = {eye[0], eye[1], eye[2]}, distance = t.eye_length, radius = 0.0;
    F64x8 aside = 1.0;
    if (t.perspective) {
        SIMD_FOR (int k = 0; k < 3; ++k)
            from_eye[k] = c.centre[k] - eye[k];
        distance = sqrt(dot(from_eye, from_eye));
        radius = c.radius * F64x8(kSlack);
        // Beside the view axis, at distance 1.
        const auto reach = [&](const ClusterCull::Plane& axis) SIMD_LAMBDA {
            return abs(at_centre(axis, c)) + F64x8(axis.length) * c.radius;
        };
        aside = one + (reach(t.x) + reach(t.y)) / least_w;
    }
    // Angles whose sines add up to less than one do so to less than a right angle.
    const F64x8 sine =
        (F64x8(t.winding) * dot(c.axis, from_eye) - radius) / distance - c.spread - F64x8(kAngle);
    const auto uncut = F64x8(t.scale) * aside < F64x8(t.most_aside); // else some may be cut
    const F64x8 area =
        F64x8(t.area) * c.thinnest * sine * (distance - radius) / (most_w * most_w * most_w);
    const F64x8 change =
        F64x8(2 * kMove * t.stretch) * aside / least_w + F64x8(kMove * kMove) / c.thinnest;
    return (c.spread <= one) & (sine > zero) & (distance > radius) & uncut &
           (area > change * F64x8(kSlack));
}

// Bit i: cluster i is culled.
SIMD_INLINE std::uint32_t culled_lanes(const Terms& t, const ClusterLanes& c) {
    const F64x8 w = at_centre(t.w, c), reach = F64x8(t.w.length) * c.radius * F64x8(kSlack);
    const F64x8 most_w = maximum(abs(w - reach), abs(w + reach)) * F64x8(kSlack),
                least_w = (w - reach) * F64x8(1 - 1e-9);
    auto culled = (w + reach < F64x8(t.near_w * (1 - 1e-9))) | beside(t, c, most_w);
    if (t.winding != 0)
        culled =
            culled | ((least_w > F64x8(t.near_w)) & back_facing_clusters(t, c, least_w, most_w));
    return bits(culled);
}

void find_culled_clusters(const Terms& terms, const geom::Cluster* clusters, int count,
                          std::uint8_t* culled) {
    for (int i = 0; i < count; i += kLanesX8) {
        const int live = count - i < kLanesX8 ? count - i : kLanesX8;
        const std::uint32_t bits = culled_lanes(terms, clusters_at(clusters + i, live));
        for (int lane = 0; lane < live; ++lane)
            culled[i + lane] = static_cast<std::uint8_t>(bits >> lane & 1);
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::raster {

SIMD_REGISTER(find_culled_clusters);

namespace {

constexpr double kNearer = 0x1p-20;    // depths at samples are rounded (raster/coverage/coverage.h)
constexpr double kCancelled = 0x1p-40; // and where no eye is, they are differences

// The coordinate of a position of the mesh along an axis of view space.
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
    s.winding = keep == Facing::any ? 0 : keep == Facing::front ? 1 : -1;
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
    s.most_aside = kGuardPixels - std::max({t.width, t.height, 2 * std::abs(t.centre_x),
                                            2 * std::abs(t.centre_y)});
}

void ClusterCull::find_culled(std::span<const geom::Cluster> clusters, std::uint8_t* culled) const {
    SIMD_CALL(find_culled_clusters, terms_, clusters.data(), static_cast<int>(clusters.size()),
              culled);
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
    const Range x = pixels(terms_.x, t.scale_x, t.centre_x),
                y = pixels(terms_.y, -t.scale_y, t.centre_y);
    if (!(x.least > t.box.left && x.most < t.box.right && y.least > t.box.top &&
          y.most < t.box.bottom))
        return std::nullopt;
    const double nearest =
        t.perspective ? t.box.near_w / w.least
                      : (range(terms_.z).most - t.depth_origin) * t.depth_scale + kCancelled;
    const auto within = [](double at, int size) {
        return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(size)));
    };
    return ClusterBounds{{within(x.least, t.width), within(y.least, t.height),
                          within(x.most + 1, t.width), within(y.most + 1, t.height)},
                         static_cast<float>(nearest * (1 + kNearer))};
}

} // namespace scanout::raster
#endif
