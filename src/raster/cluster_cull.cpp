#include "raster/cluster_cull.h"

#include <algorithm>
#include <cmath>

namespace scanout::raster {

namespace {

constexpr double kBesidePixels = 2; // beyond the picture, however far samples lie from centres
// What is known of a cluster is rounded: a share of it, and of the sine of an angle.
constexpr double kSlack = 1 + 1e-9, kAngle = 1e-6;
// Vertices move by up to half a step each way, an edge by twice that.
constexpr double kMove = 1.4143 / kSubpixel;
constexpr double kNearer = 0x1p-20; // depths at samples are rounded (raster/coverage.h)

} // namespace

ClusterCull::Plane ClusterCull::plane(const DVec3& weights) const {
    const DVec3 n = row_[0] * weights.x + row_[1] * weights.y + row_[2] * weights.z;
    const double offset = weights.x * transform_.translation[0] +
                          weights.y * transform_.translation[1] +
                          weights.z * transform_.translation[2];
    return {n, offset, std::sqrt(dot3(n, n)) * kSlack};
}

ClusterCull::ClusterCull(const ScreenTransform& t, Facing keep)
    : transform_(t), turn_(keep == Facing::any     ? 0
                           : keep == Facing::front ? 1
                                                   : -1) {
    for (int r = 0; r < 3; ++r)
        row_[r] = {t.linear[r][0], t.linear[r][1], t.linear[r][2]};
    x_ = plane({1, 0, 0});
    y_ = plane({0, 1, 0});
    z_ = plane({0, 0, 1});
    w_ = plane({0, 0, -1});
    if (!t.perspective) w_ = {DVec3(0), 1, 0};
    const auto edge = [&](const Plane& axis, double scale, double from) {
        const DVec3 n = axis.normal * scale + w_.normal * from;
        return Plane{n, axis.offset * scale + w_.offset * from, std::sqrt(dot3(n, n)) * kSlack};
    };
    edge_[0] = edge(x_, t.scale_x, t.centre_x);
    edge_[1] = edge(x_, -t.scale_x, t.width - t.centre_x);
    edge_[2] = edge(y_, -t.scale_y, t.centre_y);
    edge_[3] = edge(y_, t.scale_y, t.height - t.centre_y);
    // The inverse by its adjugate.
    const DVec3 across[3] = {cross3(row_[1], row_[2]), cross3(row_[2], row_[0]),
                             cross3(row_[0], row_[1])};
    determinant_ = dot3(row_[0], across[0]);
    const DVec3 there = t.perspective
                            ? DVec3(-t.translation[0], -t.translation[1], -t.translation[2])
                            : DVec3(0, 0, 1);
    eye_ = (across[0] * there.x + across[1] * there.y + across[2] * there.z) / determinant_;
    eye_length_ = std::sqrt(dot3(eye_, eye_));
    stretch_ = std::max(t.scale_x, t.scale_y) *
               std::sqrt(dot3(row_[0], row_[0]) + dot3(row_[1], row_[1]) + dot3(row_[2], row_[2]));
}

// All on one side of an edge of the picture, by more than a sample can reach.
bool ClusterCull::beside(const geom::Cluster& c, double most_w) const {
    return std::any_of(std::begin(edge_), std::end(edge_), [&](const Plane& e) {
        const double most = (dot3(e.normal, c.centre) + e.offset) + e.length * c.radius * kSlack;
        return most < -kBesidePixels * most_w;
    });
}

// Every triangle's normal n and vertex p have n . (p - eye) >= sine |p - eye|, and so none is
// smaller on the screen than its snapping could turn over: twice its area there is
//     scale_x scale_y det n . (p - eye) 2 area / (w0 w1 w2),
// and moving its vertices changes that by at most 2 side kMove + kMove^2. Both by its longest side.
bool ClusterCull::turned_away(const geom::Cluster& c, double least_w, double most_w) const {
    if (turn_ == 0 || c.spread > 1) return false;
    const DVec3 from_eye = transform_.perspective ? c.centre - eye_ : -eye_;
    const double distance =
        transform_.perspective ? std::sqrt(dot3(from_eye, from_eye)) : eye_length_;
    const double radius = transform_.perspective ? c.radius * kSlack : 0;
    // Angles whose sines add up to less than one do so to less than a right angle.
    const double sine =
        turn_ * dot3(c.axis, from_eye) / distance - c.spread - radius / distance - kAngle;
    if (!(sine > 0) || !(distance > radius)) return false;
    const ScreenTransform& t = transform_;
    const auto reach = [&](const Plane& axis) { // beside the view axis, at distance 1
        return (std::abs(dot3(axis.normal, c.centre) + axis.offset) + axis.length * c.radius) /
               least_w;
    };
    const double aside = t.perspective ? 1 + reach(x_) + reach(y_) : 1;
    const double pixels = std::max(t.scale_x, t.scale_y) * aside;
    if (!(pixels + std::max(t.width, t.height) < kGuardPixels)) return false; // some may be cut
    const double area = t.scale_x * t.scale_y * std::abs(determinant_) * c.thinnest * sine *
                        (distance - radius) / (most_w * most_w * most_w);
    const double change = 2 * kMove * stretch_ * aside / least_w + kMove * kMove / c.thinnest;
    return area > change * kSlack;
}

bool ClusterCull::hides(const geom::Cluster& c) const {
    const double w = dot3(w_.normal, c.centre) + w_.offset, reach = w_.length * c.radius * kSlack;
    const double most_w = std::max(std::abs(w - reach), std::abs(w + reach)) * kSlack;
    if (w + reach < transform_.box.near_w * (1 - 1e-9)) return true;
    if (beside(c, most_w)) return true;
    const double least_w = (w - reach) * (1 - 1e-9);
    return least_w > transform_.box.near_w && turned_away(c, least_w, most_w);
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
    const Range w = range(w_);
    if (!(w.least > t.box.near_w * (1 + 1e-6))) return std::nullopt;
    const auto pixels = [&](const Plane& axis, double scale, double centre) {
        const Range a = range(axis);
        const double least = a.least / (a.least > 0 ? w.most : w.least),
                     most = a.most / (a.most > 0 ? w.least : w.most);
        return Range{centre + std::min(least * scale, most * scale) - kBesidePixels,
                     centre + std::max(least * scale, most * scale) + kBesidePixels};
    };
    const Range x = pixels(x_, t.scale_x, t.centre_x), y = pixels(y_, -t.scale_y, t.centre_y);
    if (!(x.least > t.box.left && x.most < t.box.right && y.least > t.box.top &&
          y.most < t.box.bottom))
        return std::nullopt;
    const double nearest = t.perspective ? t.box.near_w / w.least
                                         : (range(z_).most - t.depth_origin) * t.depth_scale +
                                               kNearer * kNearer; // of a difference
    const auto within = [](double at, int size) {
        return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(size)));
    };
    return ClusterBounds{{within(x.least, t.width), within(y.least, t.height),
                          within(x.most + 1, t.width), within(y.most + 1, t.height)},
                         static_cast<float>(nearest * (1 + kNearer))};
}

} // namespace scanout::raster
