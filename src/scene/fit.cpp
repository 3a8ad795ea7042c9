#include "scene/fit.h"

#include "math/rotation.h"
#include "math/transcendental.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace scanout::scene {
namespace {

constexpr double kMinGap = 0.25; // bounding radii between the eye and the nearest vertex
constexpr int kMaxTurns = 16;    // what lies between two of them stays inside of the margin

// A model as a fit sees it: turned, and its scales' ratios, but not its size.
DMat3 shape_in(const DMat3& to_view, const ModelTransform& model) {
    double largest = 0;
    for (int axis = 0; axis < 3; ++axis)
        largest = std::max(largest, std::abs(model.scale[axis]));
    const DVec3 s = largest > 0 && std::isfinite(largest) ? model.scale / largest : DVec3(1);
    DMat3 placed = rotation_xyz(model.rotate_degrees) * scaling(s);
    if (!model.steps.empty()) {
        for (const TransformStep& step : model.steps)
            placed = step.linear * placed;
        const double most = stretch_of(placed).most;
        if (most > 0 && std::isfinite(most)) placed = placed / most;
    }
    return turned(to_view, model) * placed;
}

DMat3 to_view(const CameraOptions& camera) {
    return rotation_x(camera.elevation_degrees) * rotation_y(-camera.azimuth_degrees);
}

// The vertices in view axes, about the model's centre, in each pose; unit = bounding radius.
class Vertices {
public:
    explicit Vertices(const geom::Mesh& mesh) : mesh_(mesh) {}
    void add_pose(const DMat3& linear) { linear_.push_back(linear); }

    template <class Visit>
    void each(Visit visit) const {
        for (const DMat3& linear : linear_)
            for (const Vec3& position : mesh_.position)
                visit(linear * DVec3(position));
    }

private:
    const geom::Mesh& mesh_;
    std::vector<DMat3> linear_;
};

// Along one side of the picture: the greatest of at + slope z, and of -at + slope z.
struct Reach {
    double above = -std::numeric_limits<double>::infinity(), below = above;
    void include(double at, double nearer) {
        above = std::max(above, nearer + at);
        below = std::max(below, nearer - at);
    }
    double middle() const { return (above - below) / 2; }
    double half() const { return (above + below) / 2; }
};

// The vertex that lies farthest to one side, as it is projected.
struct Farthest {
    double tangent = -std::numeric_limits<double>::infinity(), at = 0, distance = 1;
    // Of several as far away, the nearest one: the order of the vertices does not matter.
    void include(double its_tangent, double its_at, double its_distance) {
        if (its_tangent < tangent || (its_tangent == tangent && its_distance >= distance)) return;
        tangent = its_tangent;
        at = its_at;
        distance = its_distance;
    }
};

// The shift along `axis` by which both ends project equally far from the picture's middle, for an
// eye at `eye` on the z axis. How far they project bends towards the eye's side as the shift grows:
// the next shift is where the two vertices that are farthest out now would be equally far, or
// halfway to the last one beyond the middle where that leads out of what is known.
double centred(const Vertices& vertices, int axis, double eye, double shift) {
    constexpr int kPasses = 24;
    double low = -std::numeric_limits<double>::infinity(), high = -low;
    for (int pass = 0; pass < kPasses; ++pass) {
        Farthest above, below;
        vertices.each([&](const DVec3& p) {
            const double away = eye - p.z, aside = p[axis] - shift;
            above.include(aside / away, p[axis], away);
            below.include(-aside / away, p[axis], away);
        });
        if (above.tangent == below.tangent) break;
        (above.tangent > below.tangent ? low : high) = shift;
        const double next = (above.at * below.distance + below.at * above.distance) /
                            (above.distance + below.distance);
        const bool inside = next > low && next < high;
        const double instead = (low + high) / 2;
        if (next == shift || (!inside && !std::isfinite(instead))) break; // but for rounding
        shift = inside ? next : instead;
    }
    return shift;
}

} // namespace

// The camera for these poses; its angles are in them.
static CameraOptions fitted(const Vertices& vertices, const CameraOptions& camera, double aspect) {
    const bool perspective = camera.projection == Projection::perspective;
    const double half_fov = camera.fov_degrees / 2;
    const double tangent = sin_degrees(half_fov) / cos_degrees(half_fov) * kFitFill;
    const DVec2 slope = half_extents(tangent, camera.screen_fit, aspect);
    Reach reach[2];
    double nearest = -std::numeric_limits<double>::infinity();
    vertices.each([&](const DVec3& p) {
        for (int axis = 0; axis < 2; ++axis)
            reach[axis].include(p[axis], perspective ? slope[axis] * p.z : 0);
        nearest = std::max(nearest, p.z);
    });
    CameraOptions fit = camera;
    fit.distance = perspective ? nearest + kMinGap : kMinGap;
    for (int axis = 0; axis < 2; ++axis)
        fit.distance = std::max(fit.distance, reach[axis].half() / slope[axis]);
    for (int axis = 0; axis < 2; ++axis) {
        fit.shift[axis] = reach[axis].middle();
        if (perspective) fit.shift[axis] = centred(vertices, axis, fit.distance, fit.shift[axis]);
    }
    if (!std::isfinite(fit.distance) || !(fit.distance > 0)) return camera;
    return fit;
}

static bool can_fit(const geom::Mesh& mesh, const CameraOptions& camera) {
    return camera.distance == 0 && !camera.eye && !camera.target && !mesh.position.empty() &&
           camera.fov_degrees > 0 && camera.fov_degrees < 180;
}

CameraOptions fitted(const geom::Mesh& mesh, const ModelTransform& model,
                     const CameraOptions& camera, double aspect, int turns) {
    if (!can_fit(mesh, camera)) return camera;
    Vertices vertices(mesh);
    turns = std::clamp(turns, 1, kMaxTurns);
    for (int i = 0; i < turns; ++i)
        vertices.add_pose(shape_in(to_view(camera) * rotation_y(360.0 * i / turns), model) *
                          up_rotation(camera.up) * (1 / mesh.radius));
    return fitted(vertices, camera, aspect);
}

CameraOptions fitted(const geom::Mesh& mesh, const ModelTransform& model,
                     const CameraOptions& camera, double aspect, const Motion& motion) {
    const auto at = [&](int moment) {
        std::pair now(model, camera);
        motion.move(motion.duration * moment / kMaxTurns, now.first, now.second);
        return now;
    };
    const CameraOptions first = at(0).second;
    if (!can_fit(mesh, first)) return camera;
    Vertices vertices(mesh);
    for (int i = 0; i < kMaxTurns; ++i) {
        const auto now = at(i);
        vertices.add_pose(shape_in(to_view(now.second), now.first) * up_rotation(camera.up) *
                          (1 / mesh.radius));
    }
    CameraOptions fit = camera;
    fit.fov_degrees = first.fov_degrees;
    fit = fitted(vertices, fit, aspect);
    fit.fov_degrees = camera.fov_degrees;
    return fit;
}

} // namespace scanout::scene
