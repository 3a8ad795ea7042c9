// The scenes of the golden images and of the table of hashes: procedural, small, one for each thing
// that can change in a picture.
#pragma once

#include "geom/line_faces.h"
#include "scene/section.h"
#include "support/axes.h"
#include "support/depth_scenes.h"
#include "support/random.h"
#include "support/shot.h"
#include "support/transparent_scenes.h"

#include <optional>
#include <string>
#include <vector>

namespace scanout::test {

// A sphere and a cube, red and green, seen from above right.
inline Shot solids(std::string name) {
    Shot s = shot(std::move(name));
    s.scene.materials = {plain({0.8F, 0.1F, 0.05F}), plain({0.1F, 0.6F, 0.2F})};
    add_cube(s.scene.mesh, 0.45F, 1);
    add_sphere(s.scene.mesh, {0.45F, 0.35F, 0.3F}, 0.4F, 24, 12, 0);
    s.scene.mesh.uv.clear();
    s.camera.azimuth_degrees = 30;
    s.camera.elevation_degrees = 25;
    return s;
}

// A checkered cube, turned so that three faces show.
inline Shot textured_cube(std::string name, const std::string& filter) {
    Shot s = shot(std::move(name));
    s.scene.materials = {textured(0)};
    s.scene.textures = {checkers()};
    add_cube(s.scene.mesh, 0.57F, 0);
    s.camera.azimuth_degrees = 35;
    s.camera.elevation_degrees = 30;
    s.options.texture = filter;
    return s;
}

// An open bowl: half a sphere, hollow side towards the eye and up.
inline Shot bowl(std::string name, frame::Cull cull) {
    Shot s = shot(std::move(name));
    s.scene.materials = {plain({0.2F, 0.4F, 0.9F})};
    geom::Mesh& mesh = s.scene.mesh;
    add_sphere(mesh, Vec3(0), 0.9F, 24, 16, 0);
    mesh.uv.clear();
    const std::size_t half = mesh.index.size() / 2 / 3 * 3; // rings come from below
    mesh.index.resize(half);
    mesh.material.resize(half / 3);
    mesh.face.resize(half / 3);
    s.camera.elevation_degrees = 35;
    s.options.cull = cull;
    return s;
}

// A floor with thin posts, in light from everywhere alone.
inline Shot thicket(std::string name) {
    Shot s = shot(std::move(name));
    s.scene.materials = {plain(Vec3(0.8F))};
    geom::Mesh& mesh = s.scene.mesh;
    add_quad(mesh, {Vec3(-1, -0.3F, 1), {1, -0.3F, 1}, {1, -0.3F, -1}, {-1, -0.3F, -1}}, {0, 1, 0},
             0);
    for (int post = 0; post < 16; ++post) {
        const int row = post / 4, column = post % 4;
        const float width = (row + column) % 2 == 0 ? 0.06F : 0.16F;
        const float height = 0.1F * static_cast<float>((column + 2 * row) % 4 + 1);
        const std::size_t first = mesh.position.size();
        add_cube(mesh, 1, 0);
        for (std::size_t i = first; i < mesh.position.size(); ++i) {
            const Vec3 p = mesh.position[i];
            mesh.position[i] = {width / 2 * p.x - 0.75F + 0.5F * static_cast<float>(column),
                                height / 2 * (p.y + 1) - 0.3F,
                                width / 2 * p.z - 0.75F + 0.5F * static_cast<float>(row)};
        }
    }
    mesh.uv.clear();
    scene::Light ambient;
    ambient.kind = scene::LightKind::ambient;
    s.options.lights = {ambient};
    s.camera.azimuth_degrees = 25;
    s.camera.elevation_degrees = 35;
    return s;
}

inline Shot glossy(std::string name, const std::string& reflection) {
    Shot s = shot(std::move(name));
    s.scene.materials = {plain({0.7F, 0.35F, 0.1F}, Vec3(0.9F), 40)};
    add_sphere(s.scene.mesh, Vec3(0), 0.95F, 32, 16, 0);
    s.scene.mesh.uv.clear();
    s.options.reflection = reflection;
    return s;
}

// A coarse ball in the light of a lamp.
inline Shot ball(std::string name) {
    Shot s = shot(std::move(name));
    s.scene.materials = {plain({0.3F, 0.5F, 0.3F}, Vec3(0.8F), 30)};
    add_sphere(s.scene.mesh, Vec3(0), 0.95F, 12, 6, 0);
    s.scene.mesh.uv.clear();
    scene::Light lamp;
    lamp.name = "lamp";
    lamp.kind = scene::LightKind::point;
    lamp.position = {0.8, 1.2, 2};
    lamp.casts = false;
    s.options.lights.push_back(lamp);
    return s;
}

// A ball and a box on a floor in the world's light, seen from above.
inline Shot stage(std::string name, const std::vector<scene::Light>& lights) {
    Shot s = shot(std::move(name));
    s.scene.materials = {plain({0.8F, 0.3F, 0.2F}, Vec3(0.4F), 30), plain({0.3F, 0.6F, 0.9F}),
                         plain(Vec3(0.7F))};
    geom::Mesh& mesh = s.scene.mesh;
    add_quad(mesh, {{{-1, -0.5F, 1}, {1, -0.5F, 1}, {1, -0.5F, -1}, {-1, -0.5F, -1}}}, {0, 1, 0},
             2);
    add_sphere(mesh, {-0.35F, -0.1F, 0}, 0.4F, 24, 12, 0);
    const std::size_t box = mesh.position.size();
    add_cube(mesh, 0.3F, 1);
    for (std::size_t i = box; i < mesh.position.size(); ++i)
        mesh.position[i] = mesh.position[i] + Vec3(0.45F, -0.2F, 0.25F);
    mesh.uv.clear();
    s.camera.azimuth_degrees = 20;
    s.camera.elevation_degrees = 30;
    s.camera.distance = 2.5;
    s.options.lights = lights;
    return s;
}

inline scene::Light light_of(scene::LightKind kind, double power) {
    scene::Light light;
    light.name = name_of(kind);
    light.kind = kind;
    light.power = power;
    light.towards = {2, 3, 1};
    light.position = {0.5, 0.8, 0.7};
    light.target = DVec3(-0.2, -0.3, 0);
    light.inner_degrees = 15;
    light.outer_degrees = 25;
    light.casts = false;
    return light;
}

// The stage in the light of one lamp that casts shadows.
inline Shot shadowed(std::string name, const std::string& technique,
                     scene::LightKind kind = scene::LightKind::directional, double size = 0) {
    scene::Light lamp = light_of(kind, 0.9);
    lamp.casts = true;
    lamp.towards = {2, 1.3, 0.4}; // the box stands between it and the ball
    lamp.size = size;
    if (kind == scene::LightKind::spot) lamp.outer_degrees = 50;
    Shot s = stage(std::move(name), {lamp, light_of(scene::LightKind::ambient, 0.15)});
    s.options.shadow = technique;
    s.options.shadow_size = 256;
    return s;
}

// A wire cube with vertex colours, and points on its diagonal.
inline Shot wires(std::string name) {
    Shot s = shot(std::move(name));
    geom::Mesh& mesh = s.scene.mesh;
    for (int i = 0; i < 8; ++i) {
        const Vec3 corner((i & 1) != 0 ? 0.55F : -0.55F, (i & 2) != 0 ? 0.55F : -0.55F,
                          (i & 4) != 0 ? 0.55F : -0.55F);
        add_vertex(mesh, corner);
        mesh.colour.emplace_back(0.5F + corner.x / 1.2F, 0.5F + corner.y / 1.2F,
                                 0.5F + corner.z / 1.2F);
    }
    for (std::uint32_t i = 0; i < 8; ++i)
        for (std::uint32_t axis = 1; axis < 8; axis *= 2)
            if ((i & axis) == 0) add_line(mesh, i, i | axis);
    for (int i = -4; i <= 4; ++i) {
        const auto at = static_cast<float>(i) / 8;
        add_point(mesh, add_vertex(mesh, {at, at, -at}));
        mesh.colour.emplace_back(1.0F, 0.9F, 0.2F);
    }
    s.camera.azimuth_degrees = 25;
    s.camera.elevation_degrees = 20;
    return s;
}

// Solids with their triangles' edges drawn over them, some of which lie on the far side.
inline Shot edges(std::string name) {
    Shot s = solids(std::move(name));
    s.scene.materials.push_back(plain(Vec3(0.02F)));
    geom::Mesh& mesh = s.scene.mesh;
    for (std::size_t i = 0; i < mesh.index.size(); ++i) {
        const std::uint32_t from = mesh.index[i], to = mesh.index[i % 3 == 2 ? i - 2 : i + 1];
        if (from < to) add_line(mesh, from, to, 2);
    }
    geom::find_line_faces(mesh);
    return s;
}

// A checkered floor that runs under and behind the eye.
inline Shot near_clip(std::string name) {
    Shot s = shot(std::move(name));
    s.scene.materials = {textured(0)};
    s.scene.textures = {checkers()};
    geom::Mesh& mesh = s.scene.mesh;
    add_quad(mesh, {{{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}}, {0, 1, 0}, 0);
    for (Vec2& uv : mesh.uv)
        uv = {uv.x * 4, uv.y * 4};
    s.camera.eye = DVec3(0.1, 0.1, 0.3);
    s.camera.target = DVec3(0, 0, -0.4);
    s.options.texture = "bilinear"; // far squares flicker: lines and clipping are the subject
    return s;
}

// A floor of coarse noise that runs to the horizon: what each filter makes of minified texels.
inline Shot noisy_floor(std::string name, const std::string& filter) {
    Shot s = shot(std::move(name));
    s.scene.materials = {textured(0)};
    s.scene.textures = {noisy(64, 5)};
    geom::Mesh& mesh = s.scene.mesh;
    add_quad(mesh, {{{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}}, {0, 1, 0}, 0);
    for (Vec2& uv : mesh.uv)
        uv = {uv.x * 5, uv.y * 5};
    s.camera.eye = DVec3(0.1, 0.06, 0.9);
    s.camera.target = DVec3(0, -0.1, -0.4);
    s.options.texture = filter;
    return s;
}

// A picture in the middle third of a square, and what lies beyond its edges.
inline Shot wrapped_square(std::string name, const std::string& wrap) {
    Shot s = shot(std::move(name));
    s.scene.materials = {textured(0)};
    s.scene.textures = {checkers()};
    add_square(s.scene.mesh, 0.7F, 0, 0);
    for (Vec2& uv : s.scene.mesh.uv)
        uv = {uv.x * 3 - 1, uv.y * 3 - 1};
    s.camera.azimuth_degrees = 20;
    s.options.texture = "bilinear";
    s.options.wrap = wrap;
    return s;
}

// White wedges round the middle on dark blue, ever thinner towards it: all edges.
inline Shot star(std::string name) {
    Shot s = shot(std::move(name));
    s.scene.materials = {plain({0.95F, 1.0F, 0.9F})};
    constexpr int kWedges = 23;
    geom::Mesh& mesh = s.scene.mesh;
    const auto rim = [&](int step) {
        const double angle = std::numbers::pi * step / kWedges;
        const auto tidy = [](double x) {
            return static_cast<float>(std::nearbyint(x * 65536) / 65536);
        };
        return add_vertex(mesh, {tidy(std::cos(angle)), tidy(std::sin(angle)), 0});
    };
    const std::uint32_t middle = add_vertex(mesh, Vec3(0));
    for (int i = 0; i < kWedges; ++i) {
        const std::uint32_t from = rim(2 * i);
        add_triangle(mesh, middle, from, rim(2 * i + 1), 0);
    }
    s.options.background = {0, 0, 40, 255};
    return s;
}

// What becomes of light: exposures, tones, blend spaces, encodings, dither.
inline void add_output_shots(std::vector<Shot>& shots) {
    for (const double stops : {0.0, -1.5}) { // darker: no light is cut off
        shots.push_back(solids(stops == 0 ? "exposure_none" : "exposure_stops"));
        shots.back().camera.azimuth_degrees = 120;
        shots.back().options.exposure = stops;
    }
    for (const std::string& tone : names_on("tone")) {
        shots.push_back(solids("tone_" + tone));
        shots.back().options.tone = tone;
        shots.back().options.exposure = 2.5;
    }
    for (const std::string& space : names_on("blend_space")) {
        shots.push_back(star("blend_space_" + space));
        shots.back().options.samples = 8;
        shots.back().options.blend_space = space;
    }
    for (const std::string& encode : names_on("encode")) {
        shots.push_back(glossy("encode_" + encode, "auto"));
        shots.back().options.encode = encode;
        shots.back().options.exposure = -3; // they differ most in the dark
        shots.back().options.tone = "clamp";
    }
    for (const std::string& convolution : names_on("convolution")) {
        shots.push_back(solids("convolution_" + convolution));
        shots.back().options.convolution = convolution;
    }
    for (const std::string& dither : names_on("dither")) {
        shots.push_back(glossy("dither_" + dither, "lambert"));
        shots.back().options.exposure = -5;
        shots.back().options.dither = dither;
    }
}

// A checkered wall that goes back to the right: distances change along every row.
inline Shot wall(std::string name) {
    Shot s = shot(std::move(name));
    s.scene.materials = {textured(0)};
    s.scene.textures = {checkers()};
    add_quad(s.scene.mesh, {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}}, {0, 0, 1}, 0);
    for (Vec2& uv : s.scene.mesh.uv)
        uv = {uv.x * 2, uv.y * 2};
    s.camera.eye = DVec3(-1.4, 0.1, 0.35);
    s.camera.target = DVec3(0, 0, 0);
    return s;
}

inline void add_interpolation_shots(std::vector<Shot>& shots) {
    for (const std::string& name : names_on("interpolate")) {
        shots.push_back(wall("interpolate_" + name));
        shots.back().options.interpolate = name;
    }
}

inline void add_anti_aliasing_shots(std::vector<Shot>& shots) {
    for (const std::string& name : names_on("aa")) {
        shots.push_back(star("aa_" + name));
        shots.back().options.aa = name;
    }
    for (const std::string& name : names_on("render_scale")) {
        shots.push_back(solids("render_scale_" + name));
        shots.back().camera.azimuth_degrees = 75;
        shots.back().options.render_scale = name;
    }
}

// A glossy sphere with one map of many small tiles.
inline Shot mapped_sphere(std::string name, scene::MaterialMap scene::Material::*map,
                          scene::Texture texture) {
    Shot s = shot(std::move(name));
    scene::Material material = plain(Vec3(0.4F), Vec3(0.6F), 20);
    (material.*map).edit().texture = 0;
    (material.*map).edit().path = "made by the test";
    (material.*map).edit().scale = {8, 4, 1};
    (material.*map).edit().bump_multiplier = 3;
    if (map == &scene::Material::map_emission) material.emission = {0.5F, 0.2F, 0};
    if (map == &scene::Material::map_roughness) material.roughness = material.metalness = 1.0F;
    if (map == &scene::Material::map_metalness) {
        material.roughness = 0.3F;
        material.metalness = 1;
    }
    s.scene.materials = {material};
    s.scene.textures = {std::move(texture)};
    add_sphere(s.scene.mesh, Vec3(0), 0.95F, 32, 16, 0);
    s.camera.elevation_degrees = 20;
    return s;
}

// A sphere and a cube under a texture of another make, or laid on in another way.
inline Shot covered_solids(std::string name, const std::string& source,
                           const std::string& mapping) {
    Shot s = solids(std::move(name));
    s.scene.materials = {textured(0), textured(0)};
    s.scene.textures = {checkers()};
    s.scene.mesh = empty_mesh();
    add_cube(s.scene.mesh, 0.45F, 1);
    add_sphere(s.scene.mesh, {0.45F, 0.35F, 0.3F}, 0.4F, 24, 12, 0);
    s.options.source = source;
    s.options.mapping = mapping;
    return s;
}

inline std::vector<Shot> map_shots() {
    using scene::Material;
    std::vector<Shot> shots;
    shots.push_back(mapped_sphere("map_normal", &Material::map_normal, pyramids()));
    shots.push_back(mapped_sphere("map_bump", &Material::map_bump, noisy(16, 3)));
    shots.push_back(mapped_sphere("map_specular", &Material::map_specular, checkers()));
    shots.push_back(mapped_sphere("map_gloss", &Material::map_shininess, checkers()));
    shots.push_back(mapped_sphere("map_roughness", &Material::map_roughness, checkers()));
    shots.push_back(mapped_sphere("map_metalness", &Material::map_metalness, checkers()));
    shots.push_back(mapped_sphere("map_emission", &Material::map_emission, checkers()));
    for (const std::string& source : names_on("source"))
        shots.push_back(covered_solids("source_" + source, source, "auto"));
    for (const std::string& mapping : names_on("mapping")) {
        shots.push_back(covered_solids("mapping_" + mapping, "auto", mapping));
        shots.back().camera.azimuth_degrees = 50;
    }
    return shots;
}

inline std::vector<Shot> golden_shots() {
    std::vector<Shot> shots;
    for (const std::string& filter : names_on("texture"))
        shots.push_back(noisy_floor("texture_" + filter, filter));
    for (const std::string& wrap : names_on("wrap"))
        shots.push_back(wrapped_square("wrap_" + wrap, wrap));
    shots.push_back(textured_cube("map_diffuse", "auto"));
    shots.back().camera.azimuth_degrees = 60;
    for (Shot& s : map_shots())
        shots.push_back(std::move(s));
    const scene::Light ambient = light_of(scene::LightKind::ambient, 0.15);
    shots.push_back(stage("light_ambient", {light_of(scene::LightKind::ambient, 0.6)}));
    shots.push_back(stage("light_hemisphere", {light_of(scene::LightKind::hemisphere, 0.6)}));
    for (const auto kind :
         {scene::LightKind::directional, scene::LightKind::point, scene::LightKind::spot})
        shots.push_back(
            stage("light_" + std::string(name_of(kind)), {light_of(kind, 0.9), ambient}));
    for (const std::string& model : names_on("reflection"))
        shots.push_back(glossy("reflection_" + model, model));
    shots.push_back(glossy("physical", "auto"));
    shots.back().scene.materials[0].roughness = 0.45F;
    shots.back().scene.materials[0].metalness = 0.8F;
    for (const std::string& rung : names_on("shading")) {
        shots.push_back(ball("shading_" + rung));
        shots.back().options.shading = rung;
    }
    shots.push_back(bowl("two_sided_off", frame::Cull::none));
    shots.back().options.effects["two_sided"] = false;
    for (const bool both : {false, true}) {
        shots.push_back(bowl(both ? "sides_two_sided" : "sides_one_sided", frame::Cull::none));
        shots.back().camera.elevation_degrees = 55;
        shots.back().options.effects["two_sided"] = both;
    }
    for (const std::string& technique : names_on("shadow")) {
        const double size = technique == "map_soft" ? 8 : 0;
        shots.push_back(
            shadowed("shadow_" + technique, technique, scene::LightKind::directional, size));
        if (technique == "map_pcf") shots.back().options.shadow_filter = 5;
    }
    for (const char* technique : {"map_pcf", "volume"}) {
        scene::Light lamp = light_of(scene::LightKind::directional, 0.9);
        lamp.casts = true;
        lamp.towards = {0.3, 1.2, -1}; // from behind
        shots.push_back(
            shadowed_panes("see_through_" + std::string(technique), technique, lamp, ambient));
    }
    // A floor in perspective: affine interpolation would bend its lines at the diagonal.
    shots.push_back(near_clip("floor"));
    shots.back().camera.eye = DVec3(0.3, 0.5, 1.2);
    shots.push_back(near_clip("near_clip"));
    for (const std::string& name : names_on("cull")) {
        shots.push_back(bowl("cull_" + name, frame::Cull::none));
        frame::ask(shots.back().options, "cull", name);
        shots.back().scene.materials[0].one_sided = name == "material";
    }
    shots.push_back(solids("perspective"));
    shots.push_back(solids("orthographic"));
    shots.back().camera.projection = scene::Projection::orthographic;
    shots.push_back(wires("lines_and_points"));
    shots.push_back(edges("lines_on_faces"));
    shots.push_back(solids("samples_8"));
    shots.back().options.samples = 8;
    for (const Shot& s : depth_shots())
        shots.push_back(s);
    for (const Shot& s : transparent_shots())
        shots.push_back(s);
    for (const std::string& name : names_on("stencil")) {
        shots.push_back(panes("stencil_" + name, "exact"));
        shots.back().camera.azimuth_degrees = 20;
        shots.back().options.stencil = name;
    }
    for (const std::string& name : names_on("edges")) {
        shots.push_back(solids("edges_" + name));
        shots.back().camera.azimuth_degrees = 50; // with none it is no scene of another name
        shots.back().options.edges = name;
    }
    for (const std::string& name : names_on("colour_by")) {
        shots.push_back(solids("colour_by_" + name));
        shots.back().camera.azimuth_degrees = 70; // likewise
        shots.back().options.colour_by = name;
    }
    shots.push_back(solids("section"));
    Jobs alone(1);
    std::optional<geom::Mesh> whole;
    scene::put_section(alone, scene::SectionSpec{.normal = {0.4, 0.1, 1}, .offset = 0.15},
                       shots.back().scene, whole);
    for (const std::string& name : names_on("ambient_occlusion")) {
        shots.push_back(thicket("ambient_occlusion_" + name));
        shots.back().options.ambient_occlusion = name;
    }
    shots.push_back(solids("annotations"));
    shots.back().scene.mesh.box_min = {-0.45, -0.45, -0.45};
    shots.back().scene.mesh.box_max = {0.85, 0.75, 0.7};
    for (std::size_t i = 0; i < frame::kAnnotationNames.size(); ++i)
        shots.back().options.annotations.toggle(static_cast<frame::Annotation>(i));
    add_output_shots(shots);
    add_anti_aliasing_shots(shots);
    add_interpolation_shots(shots);
    return shots;
}

// Triangles of every size, with colours and materials of their own, about an eye that may stand
// among them.
inline Shot soup(std::string name, int triangles, double size, std::uint64_t seed) {
    Shot s = shot(std::move(name), 257, 131);
    for (int i = 0; i < 5; ++i)
        s.scene.materials.push_back(
            plain({0.2F * static_cast<float>(i), 0.5F, 0.3F}, Vec3(i % 2 == 0 ? 0.5F : 0.0F), 30));
    Random random(seed);
    geom::Mesh& mesh = s.scene.mesh;
    for (int t = 0; t < triangles; ++t) {
        const DVec3 middle = random.in_cube(size);
        std::uint32_t index[3];
        for (std::uint32_t& i : index) {
            const DVec3 p = middle + random.in_cube(size * 0.3);
            const DVec3 n = random.in_cube(1);
            i = add_vertex(mesh, Vec3(p), Vec3(n / std::sqrt(dot3(n, n))));
            mesh.colour.emplace_back(random.in_cube(0.5) + DVec3(0.5));
        }
        add_triangle(mesh, index[0], index[1], index[2], random.whole(-1, 4));
    }
    return s;
}

} // namespace scanout::test
