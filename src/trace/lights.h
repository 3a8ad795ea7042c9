// Lights in view space: what arrives at a place, and whether something stands in the way. A light
// with a size shines from its middle, as everywhere in scanout; its size matters to shadows alone:
// a sample asks for one point of a disc that faces the receiver, or of a square that faces the
// model.
#pragma once

#include "math/vec.h"
#include "scene/light.h"
#include "scene/view.h"
#include "trace/reflection.h"
#include "trace/triangle.h"

#include <vector>

namespace scanout::trace {

class PlacedLight {
public:
    PlacedLight(const scene::Light& light, const scene::View& view, const geom::Mesh& mesh);
    bool casts() const { return light_.casts; }
    bool has_size() const { return light_.size > 0; }
    // From the middle; black where nothing arrives.
    Arrival at(const DVec3& place) const;
    // From a place to the point of the light that `sample` in [0, 1)^2 names: the light lies at
    // parameter 1, or infinitely far away.
    Ray towards(const DVec3& place, const DVec2& sample) const;
    double end() const; // parameter of the light on that ray

private:
    bool is_far() const { return light_.kind == scene::LightKind::directional; }
    scene::ViewLight light_;
    DVec3 position_, across_, up_; // of the square's sides
};

// Light from a sky and from the ground, which mix by the cosine of the surface's slope.
struct Hemisphere {
    DVec3 up{0, 1, 0}; // unit
    DVec3 sky{0}, ground{0};
};

struct PlacedLights {
    DVec3 ambient{0}; // the same everywhere
    std::vector<Hemisphere> hemispheres;
    // All that comes from everywhere, on a surface of this unit normal.
    DVec3 ambient_on(const DVec3& normal) const;
    std::vector<PlacedLight> others;
};
PlacedLights placed(const std::vector<scene::Light>& lights, const scene::View& view,
                    const geom::Mesh& mesh);

// Any two directions at right angles to a unit vector and to each other: Duff et al. 2017.
struct Across {
    DVec3 x, y;
};
Across across(const DVec3& unit);
DVec3 unit_of(const DVec3& v, const DVec3& otherwise = DVec3(0, 0, 1));

} // namespace scanout::trace
