#include "frame/pass/triangle_colours.h"

#include "geom/mesh_places.h"
#include "math/srgb.h"

#include <algorithm>
#include <cmath>

namespace scanout::frame {
namespace {

using Of = shade::ColourByTraits::Of;

Vec3 of_codes(int r, int g, int b) {
    const auto light = [](int code) { return srgb_decode(static_cast<std::uint8_t>(code)); };
    return {light(r), light(g), light(b)};
}

std::array<DVec3, 3> corners(const geom::Mesh& mesh, std::size_t triangle) {
    const std::uint32_t* index = mesh.index.data() + triangle * 3;
    return {DVec3(mesh.position[index[0]]), DVec3(mesh.position[index[1]]),
            DVec3(mesh.position[index[2]])};
}

Vec3 of_normal(const std::array<DVec3, 3>& p) {
    const DVec3 normal = cross3(p[1] - p[0], p[2] - p[0]);
    const double length = std::sqrt(dot3(normal, normal));
    const auto code = [&](double x) {
        return length > 0 ? static_cast<int>(std::floor(127.5 + 127.5 * (x / length) + 0.5)) : 128;
    };
    return of_codes(code(normal.x), code(normal.y), code(normal.z));
}

bool shows_front(const std::array<DVec3, 3>& p, const scene::View& view) {
    std::array<DVec3, 3> v;
    for (std::size_t i = 0; i < 3; ++i)
        v[i] = view.linear * p[i] + view.translation;
    const bool counter_clockwise = view.projection == scene::Projection::perspective
                                       ? dot3(v[0], cross3(v[1], v[2])) < 0
                                       : cross3(v[1] - v[0], v[2] - v[0]).z > 0;
    return counter_clockwise != view.mirrored;
}

} // namespace

// Hues a golden angle apart, at three brightnesses.
Vec3 distinct_colour(std::uint32_t number) {
    const auto hue = static_cast<int>(std::uint64_t{number} * 1375 % 3600); // tenths of a degree
    const int high = 240 - static_cast<int>(number % 3) * 45, low = high * 3 / 10;
    const int sixth = hue / 600, rise = (high - low) * (hue % 600) / 600;
    const int up = low + rise, down = high - rise;
    switch (sixth) {
    case 0:
        return of_codes(high, up, low);
    case 1:
        return of_codes(down, high, low);
    case 2:
        return of_codes(low, high, up);
    case 3:
        return of_codes(low, down, high);
    case 4:
        return of_codes(up, low, high);
    default:
        return of_codes(high, low, down);
    }
}

std::span<const Vec3> TriangleColours::of(const scene::Scene& scene, const scene::View& view,
                                          Of what) {
    const geom::Mesh& mesh = scene.mesh;
    if (what == Of::light || what == Of::depth) {
        *this = {};
        return {};
    }
    if (what == what_ && what != Of::side && scene.mesh_revision() != 0 &&
        scene.mesh_revision() == revision_)
        return colours_;
    what_ = what;
    revision_ = scene.mesh_revision();
    colours_.resize(mesh.triangles());
    const std::vector<std::uint32_t> part =
        what == Of::part ? geom::find_parts(mesh) : std::vector<std::uint32_t>();
    const Vec3 front = of_codes(90, 130, 230), back = of_codes(220, 70, 60),
               grey = of_codes(170, 170, 170);
    for (std::size_t t = 0; t < colours_.size(); ++t) {
        const std::int32_t material = mesh.material[t];
        colours_[t] = what == Of::normal ? of_normal(corners(mesh, t))
                      : what == Of::side ? (shows_front(corners(mesh, t), view) ? front : back)
                      : what == Of::part ? distinct_colour(part[t])
                      : material < 0     ? grey
                                         : distinct_colour(static_cast<std::uint32_t>(material));
    }
    return colours_;
}

DepthRange depth_range(const geom::Mesh& mesh, const scene::View& view) {
    const double unit = std::ldexp(1.0, -mesh.exponent);
    DepthRange range{INFINITY, -INFINITY};
    for (int i = 0; i < 8; ++i) {
        const DVec3 corner((i & 1) != 0 ? mesh.box_max.x : mesh.box_min.x,
                           (i & 2) != 0 ? mesh.box_max.y : mesh.box_min.y,
                           (i & 4) != 0 ? mesh.box_max.z : mesh.box_min.z);
        const double distance =
            -(view.linear * ((corner - mesh.centre) * unit) + view.translation).z;
        range.nearest = std::min(range.nearest, distance);
        range.farthest = std::max(range.farthest, distance);
    }
    range.nearest = std::max(range.nearest, view.near_distance);
    return range;
}

} // namespace scanout::frame
