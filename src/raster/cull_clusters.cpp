#include "raster/cluster_cull.h"

#define SIMD_FILE "raster/cull_clusters.cpp"
#include "simd/for_each_target.h"

SIMD_BEGIN(scanout::raster)

using Terms = ClusterCull::Terms;
using MaskX8 = F64x8::DoubleMask;

constexpr double kSlack = ClusterCull::kSlack, kBesidePixels = ClusterCull::kBesidePixels;
constexpr double kAngle = 1e-6; // slack of the sine of an angle
// Vertices move by up to half a step each way, an edge by twice that.
constexpr double kMove = 1.4143 / kSubpixel;

struct ClusterLanes {
    F64x8 centre[3], radius, axis[3], spread, thinnest;
};

HWY_INLINE ClusterLanes clusters_at(const geom::Cluster* first, int count) {
    constexpr int kWords = sizeof(geom::Cluster) / sizeof(double);
    const auto* words = reinterpret_cast<const double*>(first);
    const I32x8 at = minimum(iota<I32x8>(0), I32x8(count - 1)) * I32x8(kWords);
    const auto word = [&](std::size_t offset)
                          HWY_ATTR { return gather(words + offset / sizeof(double), at); };
    ClusterLanes c;
    SIMD_UNROLL
    for (std::size_t k = 0; k < 3; ++k) {
        c.centre[k] = word(offsetof(geom::Cluster, centre) + k * sizeof(double));
        c.axis[k] = word(offsetof(geom::Cluster, axis) + k * sizeof(double));
    }
    c.radius = word(offsetof(geom::Cluster, radius));
    c.spread = word(offsetof(geom::Cluster, spread));
    c.thinnest = word(offsetof(geom::Cluster, thinnest));
    return c;
}

HWY_INLINE F64x8 dot(const F64x8 (&a)[3], const F64x8 (&b)[3]) {
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}
HWY_INLINE F64x8 at_centre(const ClusterCull::Plane& p, const ClusterLanes& c) {
    const F64x8 normal[3] = {p.normal.x, p.normal.y, p.normal.z};
    return dot(normal, c.centre) + F64x8(p.offset);
}

// All on one side of an edge of the picture, by more than a sample can reach.
HWY_INLINE MaskX8 beside(const Terms& t, const ClusterLanes& c, F64x8 most_w) {
    const F64x8 radius = c.radius * F64x8(kSlack), limit = most_w * F64x8(-kBesidePixels);
    const auto past = [&](const ClusterCull::Plane& edge) HWY_ATTR {
        return at_centre(edge, c) + F64x8(edge.length) * radius < limit;
    };
    return (past(t.edge[0]) | past(t.edge[1])) | (past(t.edge[2]) | past(t.edge[3]));
}

// Every triangle's normal n and vertex p have n . (p - eye) >= sine |p - eye|, and so none is
// smaller on the screen than its snapping could turn over: twice its area there is
//     scale_x scale_y det n . (p - eye) 2 area / (w0 w1 w2),
// and moving its vertices changes that by at most 2 side kMove + kMove^2. Both by its longest side.
HWY_INLINE MaskX8 turned_away(const Terms& t, const ClusterLanes& c, F64x8 least_w, F64x8 most_w) {
    const F64x8 zero = 0.0, one = 1.0;
    const F64x8 eye[3] = {t.eye.x, t.eye.y, t.eye.z};
    F64x8 from_eye[3] = {eye[0], eye[1], eye[2]}, distance = t.eye_length, radius = 0.0;
    F64x8 aside = 1.0;
    if (t.perspective) {
        SIMD_UNROLL
        for (int k = 0; k < 3; ++k)
            from_eye[k] = c.centre[k] - eye[k];
        distance = sqrt(dot(from_eye, from_eye));
        radius = c.radius * F64x8(kSlack);
        // Beside the view axis, at distance 1.
        const auto reach = [&](const ClusterCull::Plane& axis) HWY_ATTR {
            return abs(at_centre(axis, c)) + F64x8(axis.length) * c.radius;
        };
        aside = one + (reach(t.x) + reach(t.y)) / least_w;
    }
    // Angles whose sines add up to less than one do so to less than a right angle.
    const F64x8 sine =
        (F64x8(t.turn) * dot(c.axis, from_eye) - radius) / distance - c.spread - F64x8(kAngle);
    const auto uncut = F64x8(t.scale) * aside < F64x8(t.most_aside); // else some may be cut
    const F64x8 area =
        F64x8(t.area) * c.thinnest * sine * (distance - radius) / (most_w * most_w * most_w);
    const F64x8 change =
        F64x8(2 * kMove * t.stretch) * aside / least_w + F64x8(kMove * kMove) / c.thinnest;
    return (c.spread <= one) & (sine > zero) & (distance > radius) & uncut &
           (area > change * F64x8(kSlack));
}

// Bit i: cluster i is hidden.
HWY_INLINE std::uint32_t hidden_lanes(const Terms& t, const ClusterLanes& c) {
    const F64x8 w = at_centre(t.w, c), reach = F64x8(t.w.length) * c.radius * F64x8(kSlack);
    const F64x8 most_w = maximum(abs(w - reach), abs(w + reach)) * F64x8(kSlack),
                least_w = (w - reach) * F64x8(1 - 1e-9);
    auto hidden = (w + reach < F64x8(t.near_w * (1 - 1e-9))) | beside(t, c, most_w);
    if (t.turn != 0)
        hidden = hidden | ((least_w > F64x8(t.near_w)) & turned_away(t, c, least_w, most_w));
    return bits(hidden);
}

void find_hidden_clusters(const Terms& terms, const geom::Cluster* clusters, int count,
                          std::uint8_t* hidden) {
    for (int i = 0; i < count; i += kLanesX8) {
        const int live = count - i < kLanesX8 ? count - i : kLanesX8;
        const std::uint32_t bits = hidden_lanes(terms, clusters_at(clusters + i, live));
        for (int lane = 0; lane < live; ++lane)
            hidden[i + lane] = static_cast<std::uint8_t>(bits >> lane & 1);
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::raster {

SIMD_REGISTER(find_hidden_clusters);

void ClusterCull::find_hidden(std::span<const geom::Cluster> clusters, std::uint8_t* hidden) const {
    SIMD_CALL(find_hidden_clusters)
    (terms_, clusters.data(), static_cast<int>(clusters.size()), hidden);
}

} // namespace scanout::raster
#endif
