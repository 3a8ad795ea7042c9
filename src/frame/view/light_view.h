// The views of a light from which its shadow maps are drawn: one view that just holds the shadow
// casters, or the six faces of a cube around a light that is among them.
#pragma once

#include "geom/mesh.h"
#include "scene/light.h"
#include "scene/view.h"

#include <vector>

namespace scanout::frame {

struct LightView {
    scene::View view;                  // for the raster: of the mesh, in light space
    DMat3 rotation{1};                 // view space of the eye -> light space
    DVec3 translation{0};              // added after the rotation
    int size = 0;                      // texels a side
    double texels_x = 0, texels_y = 0; // a unit: everywhere, or in perspective at distance 1
    double half = 0;                   // greatest distance of a receiver from the middle, texels
};

// The position of a point or spot light, and the extent of view space: in the view's own lengths.
DVec3 place_of(const scene::ViewLight& light, const scene::View& view);
double radius_of(const scene::View& view); // near the model's, at least

// light: not ambient. size: texels a side of a single view; six have half as many each. margin:
// texels around the shadow casters that stay empty, or on which two of six views overlap. Replaces
// what `out` held.
void light_views(const scene::ViewLight& light, const geom::Mesh& mesh, const scene::View& view,
                 int size, int margin, std::vector<LightView>& out);

// The view from a light with a position, turned as the eye is. Its near plane cuts off no more than
// the near planes of its maps' views do, and no corner of it is nearer to the light than theirs.
scene::View view_about(const scene::ViewLight& light, const scene::View& view);

} // namespace scanout::frame
