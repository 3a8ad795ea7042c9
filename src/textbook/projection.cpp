#include "textbook/projection.h"

#include "textbook/hidden/hidden.h"

namespace scanout::textbook {

DepthRow pseudo_depth(double n, double f, double at_near) {
    // c + d/n = at_near, c + d/f = 1
    const double d = (at_near - 1) * f * n / (f - n);
    return {1 - d / f, d};
}

DepthRow course_depth(double n, double f) {
    return {1 / (f - n), -n / (f - n)};
}

Projection::Projection(const scene::View& view, const Parts& parts, double n, double f)
    : x_(1 / view.half_width), y_(1 / view.half_height), middle_(view.middle),
      perspective_(view.projection == scene::Projection::perspective), hidden_(parts.hidden),
      conventions_(parts.conventions), n_(n), f_(f),
      row_(parts.conventions.depth_ends_at_1 ? pseudo_depth(n, f, parts.conventions.depth_at_near)
                                             : course_depth(n, f)) {
    if (!perspective_) // a line from n to f, and w = 1
        row_ = {(1 - conventions_.depth_at_near) / (f - n),
                conventions_.depth_at_near - n * (1 - conventions_.depth_at_near) / (f - n)};
}

// The scene is right-handed, its camera looks along -z.
DVec4 Projection::clip_of(const DVec3& place) const {
    const double distance = -place.z;
    const double w = perspective_ ? distance : 1;
    double depth = row_.c * distance + row_.d; // after the division: pseudo-depth
    if (hidden_ == Hidden::z_linear) depth = clip_depth_z_linear(distance, w, n_, f_);
    if (hidden_ == Hidden::z_squared) depth = clip_depth_z_squared(distance, w);
    return {(place.x - w * middle_.x) * x_, (place.y - w * middle_.y) * y_, depth, w};
}

Plane Projection::near_plane() const {
    return {{0, 0, 0, 1}, perspective_ ? -n_ : 0};
}

// Near and far by the distance itself where w is one: the same planes as by z, and right for every
// kind of depth. An orthographic view has all of the model between n and f.
std::vector<Plane> Projection::planes() const {
    std::vector<Plane> planes;
    if (perspective_) planes = {near_plane(), {{0, 0, 0, -1}, f_}};
    for (const DVec4& side :
         {DVec4(1, 0, 0, 1), DVec4(-1, 0, 0, 1), DVec4(0, 1, 0, 1), DVec4(0, -1, 0, 1)})
        planes.push_back({side, 0});
    return planes;
}

Corner Projection::on_screen(const Vertex& v, int width, int height) const {
    const double x = v.clip.x / v.clip.w, y = v.clip.y / v.clip.w;
    return {(x + 1) / 2 * width, (1 - y) / 2 * height, v.clip.z / v.clip.w, v.clip.w, v.values};
}

} // namespace scanout::textbook
