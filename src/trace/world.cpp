#include "trace/world.h"

#include "math/transcendental.h"
#include "trace/lights.h"
#include "trace/texture.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scanout::trace {
namespace {

Alpha in_list(const std::vector<Alpha>& list, std::size_t place) {
    return list.empty() ? Alpha::opaque : list[place];
}

template <class T>
T mixed(const std::array<T, 3>& of, const Hit& hit) {
    return of[0] * hit.weight[0] + of[1] * hit.weight[1] + of[2] * hit.weight[2];
}

} // namespace

Result<World> World::create(const scene::Scene& scene, const scene::View& view, const Look& look,
                            const std::atomic<bool>* cancelled) {
    const geom::Mesh& mesh = scene.mesh;
    std::vector<Corners> triangles(mesh.triangles());
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            triangles[i][k] =
                view.linear * DVec3(mesh.position[mesh.index[3 * i + k]]) + view.translation;
    TRY(Bvh bvh, Bvh::create(std::move(triangles), nullptr, cancelled));
    return World(scene, view, look, std::move(bvh));
}

World::World(const scene::Scene& scene, const scene::View& view, const Look& look, Bvh bvh)
    : scene_(&scene), view_(&view), look_(&look), bvh_(std::move(bvh)) {
    sort_out();
}

// By the way triangles are wound on the screen: by the side of their plane where the eye stands.
void World::sort_out() {
    const std::size_t count = scene_->mesh.triangles();
    left_out_.assign(count, 0);
    casters_.assign(count, 1);
    const bool orthographic = view_->projection == scene::Projection::orthographic;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Corners& c = bvh_.corners(i);
        const DVec3 normal = cross3(c[1] - c[0], c[2] - c[0]);
        const double towards = orthographic ? normal.z : -dot3(normal, c[0]);
        const bool front = view_->mirrored ? towards < 0 : towards > 0;
        left_out_[i] = in_list(look_->alpha, of_list(i)) == Alpha::nothing ||
                       (look_->left == Left::backs && !front) ||
                       (!look_->one_sided.empty() && look_->one_sided[of_list(i)] != 0 && !front) ||
                       (look_->left == Left::fronts && front);
        const Alpha casts = in_list(look_->casts, of_list(i));
        casters_[i] = casts == Alpha::nothing ? 0 : 1;
        has_holes_ = has_holes_ || casts == Alpha::cut_out;
    }
}

Ray World::ray(double x, double y) const {
    const double across = view_->middle.x + (2 * x / look_->width - 1) * view_->half_width,
                 up = view_->middle.y + (1 - 2 * y / look_->height) * view_->half_height;
    if (view_->projection == scene::Projection::perspective) return {DVec3(0), {across, up, -1}};
    return {{across, up, 0}, {0, 0, -1}};
}

double World::nearest() const {
    return view_->projection == scene::Projection::perspective ? view_->near_distance
                                                               : view_->cut_near;
}

Hit World::next(const Ray& ray, const Hit& after) const {
    const Hit hit = bvh_.next(ray, after);
    return hit.t > view_->cut_far ? Hit{hit.t, kNothing, {}} : hit;
}

std::size_t World::of_list(std::uint32_t triangle) const {
    return static_cast<std::size_t>(scene_->mesh.material[triangle] + 1);
}

const scene::Material& World::material(std::uint32_t triangle) const {
    const std::int32_t number = scene_->mesh.material[triangle];
    return number < 0 ? scene_->unnamed : scene_->materials[static_cast<std::size_t>(number)];
}

DVec2 World::uv(const Hit& hit) const {
    const geom::Mesh& mesh = scene_->mesh;
    std::array<DVec2, 3> corner;
    for (std::size_t k = 0; k < 3; ++k)
        corner[k] = mesh.uv_of(mesh.index[3 * std::size_t{hit.triangle} + k]);
    return mixed(corner, hit);
}

bool World::reads(bool asked, const scene::TextureMap& map) const {
    return asked && map.texture >= 0 && !scene_->mesh.uv.empty();
}

DVec4 World::sampled(const Hit& hit, const scene::TextureMap& map, bool encoded) const {
    return texel(scene_->textures[static_cast<std::size_t>(map.texture)], map, look_->edges,
                 uv(hit), encoded);
}

// d, times map_d, times the alpha of map_Kd.
double World::mapped_alpha(const Hit& hit) const {
    const scene::Material& m = material(hit.triangle);
    double alpha = m.opacity;
    if (reads(look_->maps.opacity, m.map_opacity))
        alpha *= std::clamp(scalar_of(sampled(hit, m.map_opacity, false), m.map_opacity->channel),
                            0.0, 1.0);
    if (reads(look_->maps.opacity, m.map_diffuse)) alpha *= sampled(hit, m.map_diffuse, true).w;
    return alpha;
}

// In a cut-out surface: alpha is below the material's own cut, or else the one of all.
bool World::is_hole(const Hit& hit) const {
    const auto every = static_cast<float>(look_->alpha_cut);
    return mapped_alpha(hit) < double{material(hit.triangle).alpha_cut.value_or(every)};
}

double World::alpha(const Hit& hit) const {
    switch (in_list(look_->alpha, of_list(hit.triangle))) {
    case Alpha::opaque:
        return 1;
    case Alpha::cut_out:
        return is_hole(hit) ? 0 : 1;
    case Alpha::blended:
        return mapped_alpha(hit);
    case Alpha::nothing:
        break;
    }
    return 0;
}

bool World::is_blended(std::uint32_t triangle) const {
    return in_list(look_->alpha, of_list(triangle)) == Alpha::blended;
}

bool World::lets_through(const Hit& hit) const {
    return in_list(look_->casts, of_list(hit.triangle)) == Alpha::cut_out && is_hole(hit);
}

// Of the triangle, on the side from which it winds counter-clockwise.
DVec3 World::wound(const Hit& hit) const {
    const Corners& c = bvh_.corners(hit.triangle);
    return cross3(c[1] - c[0], c[2] - c[0]);
}

// The same on the side that the ray meets.
DVec3 World::facing(const Hit& hit, const Ray& ray) const {
    const DVec3 normal = wound(hit);
    return dot3(normal, ray.way) > 0 ? -normal : normal;
}

double World::model_radius() const {
    double square = 0; // of the most that the view lengthens anything
    for (int c = 0; c < 3; ++c)
        square = std::max(square, dot3(view_->linear[c], view_->linear[c]));
    return scene_->mesh.radius * scanout::sqrt(square);
}

// Of the corners, of any length, on the side that is lit.
std::array<DVec3, 3> World::normals(const Hit& hit, const Ray& ray) const {
    const geom::Mesh& mesh = scene_->mesh;
    std::array<DVec3, 3> normal, in_mesh, place;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t vertex = mesh.index[3 * std::size_t{hit.triangle} + k];
        place[k] = DVec3(mesh.position[vertex]);
        in_mesh[k] = DVec3(mesh.normal[vertex]);
        normal[k] = view_->normal * in_mesh[k];
    }
    if (!look_->turned_to_eye) return normal;
    // All normals of a face together. In the mesh's space: a scale may bend them past the face.
    const bool from_behind = (dot3(wound(hit), ray.way) > 0) != view_->mirrored;
    const DVec3 face = cross3(place[1] - place[0], place[2] - place[0]);
    const auto [least, most] =
        std::minmax({dot3(in_mesh[0], face), dot3(in_mesh[1], face), dot3(in_mesh[2], face)});
    const bool reversed = most + least < 0; // by the steepest
    if (from_behind != reversed)
        for (DVec3& n : normal)
            n = -n;
    return normal;
}

Ground World::ground(const Hit& hit, const Ray& ray, const DVec3& towards) const {
    const Ground flat{ray.from + ray.way * hit.t, facing(hit, ray)};
    const scene::Material& m = material(hit.triangle);
    if (dot3(flat.facing, towards) > 0 || reads(look_->maps.normal, m.map_normal) ||
        reads(look_->maps.bump, m.map_bump))
        return flat;
    const std::array<DVec3, 3> corner = normals(hit, ray);
    const DVec3 smooth = unit_of(mixed(corner, hit));
    if (!(dot3(smooth, towards) > 0 && dot3(smooth, flat.facing) > 0)) return flat;
    Ground round{flat.place, smooth};
    for (std::size_t k = 0; k < 3; ++k) {
        const DVec3 n = unit_of(corner[k], DVec3(0));
        const double above = dot3(bvh_.corners(hit.triangle)[k] - flat.place, n);
        round.place = round.place + n * (hit.weight[k] * std::max(above, 0.0));
    }
    return round;
}

Surface World::surface(const Hit& hit, const Ray& ray) const {
    const geom::Mesh& mesh = scene_->mesh;
    const scene::Material& m = material(hit.triangle);
    const MapsRead& maps = look_->maps;
    std::array<DVec3, 3> colour;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t vertex = mesh.index[3 * std::size_t{hit.triangle} + k];
        colour[k] = mesh.colour.empty() ? DVec3(1) : DVec3(mesh.colour[vertex]);
    }
    Surface s;
    s.normal = unit_of(mixed(normals(hit, ray), hit));
    lean_by_maps(s.normal, hit, m);
    s.albedo = DVec3(m.diffuse);
    if (look_->vertex_colours) s.albedo = s.albedo * mixed(colour, hit);
    if (reads(maps.diffuse, m.map_diffuse))
        s.albedo = s.albedo * DVec3(sampled(hit, m.map_diffuse, true));
    const auto number = [&](double own, bool asked, const scene::TextureMap& map) {
        return reads(asked, map) ? own * scalar_of(sampled(hit, map, false), map.channel) : own;
    };
    s.specular = DVec3(m.specular);
    if (reads(maps.specular, m.map_specular))
        s.specular = s.specular * DVec3(sampled(hit, m.map_specular, false));
    s.shininess = std::max(number(double{m.shininess}, maps.shininess, m.map_shininess), 0.0);
    const scene::Surface kind = scene::surface_of(m);
    s.physical = kind == scene::Surface::physical;
    s.roughness = number(double{scene::roughness_of(m)}, maps.roughness, m.map_roughness);
    s.metalness = number(double{scene::metalness_of(m)}, maps.metalness, m.map_metalness);
    // What says roughness has a highlight of whatever model reflects on it: of ggx always, of the
    // others by its Ks and Ns.
    s.highlight = kind == scene::Surface::physical || scene::has_highlight(m);
    const std::int32_t own = mesh.material[hit.triangle];
    if (!look_->matt.empty() &&
        look_->matt[own < 0 ? look_->matt.size() - 1 : static_cast<std::size_t>(own)] != 0)
        s.highlight = false;
    return s;
}

bool World::is_unlit(const Hit& hit) const {
    return look_->emission && material(hit.triangle).unlit;
}

DVec3 World::emission(const Hit& hit) const {
    const scene::Material& m = material(hit.triangle);
    if (!look_->emission) return DVec3(0);
    const DVec3 own(m.emission);
    return reads(look_->maps.emission, m.map_emission)
               ? own * DVec3(sampled(hit, m.map_emission, true))
               : own;
}

Reflection World::reflection(const Hit& hit) const {
    const auto kind = static_cast<std::size_t>(scene::surface_of(material(hit.triangle)));
    return find_reflection(look_->reflection[kind]);
}

// Towards `given`: along growing u, along growing v, and along the normal.
void World::lean(DVec3& normal, const Hit& hit, const DVec3& given) const {
    if (given.x == 0 && given.y == 0) return;
    const geom::Mesh& mesh = scene_->mesh;
    const Corners& c = bvh_.corners(hit.triangle);
    std::array<DVec2, 3> at;
    for (std::size_t k = 0; k < 3; ++k)
        at[k] = mesh.uv_of(mesh.index[3 * std::size_t{hit.triangle} + k]);
    const DVec2 p = at[1] - at[0], q = at[2] - at[0];
    const double turned = p.x * q.y - p.y * q.x < 0 ? -1 : 1;
    const DVec3 along_u = ((c[1] - c[0]) * q.y - (c[2] - c[0]) * p.y) * turned,
                along_v = ((c[2] - c[0]) * p.x - (c[1] - c[0]) * q.x) * turned;
    const DVec3 flat = along_u - normal * dot3(normal, along_u);
    const double size = scanout::sqrt(dot3(flat, flat));
    const bool usable = size > 0x1p-60;
    const DVec3 u = usable ? flat / size : across(normal).x;
    DVec3 v = cross3(normal, u);
    if (usable && dot3(v, along_v) < 0) v = -v;
    normal = unit_of(u * given.x + v * given.y + normal * given.z, normal);
}

// norm, as Cohen, Olano and Manocha 1998; map_bump by the slope over a texel, as Blinn 1978.
void World::lean_by_maps(DVec3& normal, const Hit& hit, const scene::Material& m) const {
    if (reads(look_->maps.normal, m.map_normal)) {
        const DVec4 t = sampled(hit, m.map_normal, false);
        constexpr double kMiddle = 128.0 / 255;
        const scene::TextureMap& map = *m.map_normal;
        const double leaning = map.normal_scale;
        const DVec3 given((t.x - kMiddle) * (map.scale.x < 0 ? -leaning : leaning),
                          (t.y - kMiddle) * (map.scale.y < 0 ? -leaning : leaning),
                          std::max(t.z - kMiddle, 0.0));
        lean(normal, hit, given);
    }
    const scene::TextureMap& bump = m.map_bump;
    if (!reads(look_->maps.bump, bump)) return;
    const scene::Texture& texture = scene_->textures[static_cast<std::size_t>(bump.texture)];
    const auto texel_size = [](float scale, int size) {
        const double texels = double{scale} * size;
        return texels == 0 ? 0 : 1 / texels;
    };
    const DVec2 size(texel_size(bump.scale.x, texture.image.width()),
                     texel_size(bump.scale.y, texture.image.height()));
    const DVec2 at = uv(hit);
    const auto height = [&](double u, double v) {
        return scalar_of(texel(texture, bump, look_->edges, at + size * DVec2(u, v), false),
                         bump.channel);
    };
    const double strength = bump.bump_multiplier;
    lean(normal, hit,
         {(height(-0.5, 0) - height(0.5, 0)) * (bump.scale.x < 0 ? -strength : strength),
          (height(0, -0.5) - height(0, 0.5)) * (bump.scale.y < 0 ? -strength : strength), 1});
}

} // namespace scanout::trace
