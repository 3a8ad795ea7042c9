// From view space to the clip space of a document [Compendium 8], [Course 2.2], [SoftwareGraphics].
#pragma once

#include "scene/view.h"
#include "textbook/clip/clip.h"

namespace scanout::textbook {

// z' = C z + D before the division; C + D/z after it.
struct DepthRow {
    double c = 0, d = 0;
};
// z/w is `at_near` at n and 1 at f: C = (f + n)/(f - n), D = 2 f n/(n - f) for -1
// [ClipSpace 4.2]; A = f/(f - n), B = -f n/(f - n) for 0 [SoftwareGraphics].
DepthRow pseudo_depth(double n, double f, double at_near);
// The course's matrix [Course 2.2]: (z - n)/(f - n) over w = z, which is 1/f at the far plane.
DepthRow course_depth(double n, double f);

struct Projection {
    Projection(const scene::View& view, const Parts& parts, double n, double f);
    DVec4 clip_of(const DVec3& view_place) const;
    Plane near_plane() const;          // in an orthographic view all is beyond it
    std::vector<Plane> planes() const; // near, far, left, right, bottom, top
    Corner on_screen(const Vertex& v, int width, int height) const;

private:
    double x_, y_; // scales
    DVec2 middle_; // of the picture, at distance 1
    bool perspective_;
    Hidden hidden_;
    Conventions conventions_;
    double n_, f_;
    DepthRow row_;
};

} // namespace scanout::textbook
