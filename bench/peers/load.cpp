#include "bench/peers/load.h"

#include "bench/meshes/meshes.h"
#include "math/srgb.h"
#include "math/transcendental.h"

#include <algorithm>
#include <array>

namespace scanout::bench {
namespace {

constexpr std::array kLoads = {
    Load{"depth teapot", "teapot", Shading::depth, 1, 0, 0},
    Load{"depth bunny", "bunny", Shading::depth, 1, 5, 8},
    Load{"depth dragon", "dragon", Shading::depth, 1, 8, 10},
    Load{"Blinn-Phong teapot", "teapot", Shading::blinn_phong, 1, 2.5, 4},
    Load{"Blinn-Phong bunny", "bunny", Shading::blinn_phong, 1, 4, 6},
    Load{"Blinn-Phong dragon", "dragon", Shading::blinn_phong, 1, 6, 8},
    Load{"texture + Blinn-Phong bunny", "bunny", Shading::textured, 1, 3, 4},
    Load{"depth building", "building", Shading::depth, 1, 5, 8},
    Load{"Blinn-Phong building", "building", Shading::blinn_phong, 1, 4, 6},
    Load{"+ shadow map dragon", "dragon", Shading::shadowed, 1, 6, 8},
    Load{"4x Blinn-Phong bunny", "bunny", Shading::blinn_phong, 4, 5, 10},
};

// Squares with a little noise, so that every mipmap level differs.
image::Image squares() {
    image::Image picture(kTextureTexels, kTextureTexels);
    for (int y = 0; y < kTextureTexels; ++y)
        for (int x = 0; x < kTextureTexels; ++x) {
            const unsigned mixed =
                static_cast<unsigned>(x) * 2654435761U ^ static_cast<unsigned>(y) * 40503U;
            const auto noise = static_cast<std::uint8_t>(mixed >> 28);
            const image::Rgba8 base = (((x >> 6) ^ (y >> 6)) & 1) != 0
                                          ? image::Rgba8{216, 208, 192, 255}
                                          : image::Rgba8{128, 136, 168, 255};
            picture.at(x, y) = {static_cast<std::uint8_t>(base.r + noise),
                                static_cast<std::uint8_t>(base.g + noise),
                                static_cast<std::uint8_t>(base.b + noise), 255};
        }
    return picture;
}

} // namespace

const image::Rgba8 kBackground = {srgb_encode(0), srgb_encode(9 / 255.0F), srgb_encode(11 / 255.0F),
                                  255};

std::span<const Load> loads() {
    return kLoads;
}

bool is_inside(const Load& load) {
    return std::any_of(meshes().begin(), meshes().end(),
                       [&](const MeshCard& card) { return card.name == load.mesh && card.inside; });
}

Result<scene::Scene> scene_of(const Load& load) {
    scene::Scene scene;
    TRY(scene.mesh, make_mesh(load.mesh));
    scene::Material material;
    material.diffuse = {0.7F, 0.6F, 0.5F};
    material.specular = Vec3(0.3F);
    material.shininess = 32;
    if (load.shading == Shading::textured) {
        material.diffuse = Vec3(1);
        material.map_diffuse.edit().texture = 0;
        material.map_diffuse.edit().path = "made by the benchmark";
        scene.textures.push_back({"squares", squares()});
    } else {
        scene.mesh.uv.clear(); // a model without texture has none
    }
    scene.materials.push_back(material);
    std::fill(scene.mesh.material.begin(), scene.mesh.material.end(), 0);
    static std::uint64_t revision = 0;
    scene.revision = ++revision;
    return scene;
}

frame::FrameOptions options_of(const Load& load, int width, int height) {
    frame::FrameOptions options;
    options.width = width;
    options.height = height;
    options.samples = load.samples;
    options.background = kBackground;
    options.cull = is_inside(load) ? frame::Cull::none : frame::Cull::back;
    options.tone = "clamp";
    options.texture = "trilinear";
    options.shadow = "map_pcf";
    options.shadow_size = kShadowTexels;
    options.shadow_filter = kShadowFilter;
    scene::Light key, ambient;
    key.name = "key";
    key.frame = scene::LightFrame::camera;
    key.towards = kTowardsLight;
    key.casts = load.shading == Shading::shadowed;
    ambient.name = "ambient";
    ambient.kind = scene::LightKind::ambient;
    ambient.power = kAmbient;
    ambient.casts = false;
    options.lights = {key, ambient};
    return options;
}

Result<scene::View> view_of(const Load& load, const scene::Scene& scene, int frame, int count,
                            int width, int height) {
    scene::Pose pose;
    scene::CameraOptions camera;
    if (is_inside(load)) {
        const double degrees = 360.0 * frame / count;
        camera.eye = kEyeInBuilding;
        camera.target = kEyeInBuilding + DVec3(cos_degrees(degrees), 0.05, sin_degrees(degrees)) *
                                             (1 / scene::radii_per_unit(scene.mesh));
        camera.fov_degrees = 60;
    } else {
        pose.yaw = scene::wrap_angle(std::int64_t{scene::kFullTurn} * frame / count);
    }
    return make_view(scene.mesh, {}, pose, camera, {}, width, height);
}

} // namespace scanout::bench
