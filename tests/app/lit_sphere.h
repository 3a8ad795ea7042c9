// A lit sphere that fills a small picture, and what its reference is made from.
#pragma once

#include "scene/light.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "support/meshes.h"
#include "trace/look.h"

namespace scanout::app {

struct LitSphere {
    LitSphere(int width, int height) {
        scene.mesh = test::empty_mesh();
        scene.materials = {{}};
        test::add_sphere(scene.mesh, Vec3(0), 0.8F, 24, 12, 0);
        view.projection = scene::Projection::orthographic;
        look.width = width;
        look.height = height;
        look.lights = scene::default_lights();
    }
    scene::Scene scene;
    scene::View view;
    trace::Look look;
};

} // namespace scanout::app
