// The scene as rays meet it: triangles in view space, and what their materials say at a place of
// one.
#pragma once

#include "base/result.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "trace/bvh.h"
#include "trace/look.h"
#include "trace/reflection.h"

#include <atomic>
#include <vector>

namespace scanout::trace {

// A place, and the normal, of any length, of the plane that hides what lies below it.
struct Ground {
    DVec3 place, facing;
};

class World {
public:
    // Scene, view and look outlive it. Fails like Bvh::create.
    static Result<World> create(const scene::Scene& scene, const scene::View& view,
                                const Look& look, const std::atomic<bool>* cancelled = nullptr);
    // From the eye through a place of the picture, in pixels from its upper left corner; a hit's t
    // is its distance from the eye's plane, but for a constant where the view is orthographic.
    Ray ray(double x, double y) const;
    // Where what can be seen begins on such a ray.
    double nearest() const;
    // What comes next on it, of what can be seen (Bvh::next).
    Hit next(const Ray& ray, const Hit& after) const;

    const Bvh& bvh() const { return bvh_; }
    // Some triangle lets nothing, or not all, through to what lies behind it; 0 to 1.
    double alpha(const Hit& hit) const;
    // Left out, by the way it is wound, or because it shows nothing.
    bool is_left_out(std::uint32_t triangle) const { return left_out_[triangle] != 0; }
    Surface surface(const Hit& hit, const Ray& ray) const;
    DVec2 uv(const Hit& hit) const; // of a mesh that has them
    // Where a hit asks for the light from a direction. Where the face turns away from it and the
    // smooth normal does not, the surface is the round one that the normals mean: the place lies on
    // it, lifted as Hanika 2021 has it, and the normal is the smooth one.
    Ground ground(const Hit& hit, const Ray& ray, const DVec3& towards) const;
    // The face's own normal, of any length, on the side that the ray meets.
    DVec3 facing(const Hit& hit, const Ray& ray) const;
    double model_radius() const;         // as the view shows it
    bool is_unlit(const Hit& hit) const; // its albedo is what is seen
    DVec3 emission(const Hit& hit) const;
    Reflection reflection(const Hit& hit) const;

    // By triangle: 1 where it casts shadows, with whatever holes.
    const std::vector<std::uint8_t>& casters() const { return casters_; }
    bool has_holes() const { return has_holes_; } // some caster's
    bool lets_through(const Hit& hit) const;      // a ray of light, by a hole
    // Light from everywhere: whichever way it is wound, it is not blended, and the hit no hole.
    bool keeps_off(const Hit& hit) const { return !is_blended(hit.triangle) && alpha(hit) > 0; }
    bool is_blended(std::uint32_t triangle) const;

private:
    World(const scene::Scene& scene, const scene::View& view, const Look& look, Bvh bvh);
    void sort_out();
    const scene::Material& material(std::uint32_t triangle) const;
    std::size_t of_list(std::uint32_t triangle) const; // place in lists that begin with the default
    bool reads(bool asked, const scene::TextureMap& map) const;
    DVec4 sampled(const Hit& hit, const scene::TextureMap& map, bool encoded) const;
    double mapped_alpha(const Hit& hit) const;
    bool is_hole(const Hit& hit) const;
    DVec3 wound(const Hit& hit) const;
    std::array<DVec3, 3> normals(const Hit& hit, const Ray& ray) const;
    void lean(DVec3& normal, const Hit& hit, const DVec3& given) const;
    void lean_by_maps(DVec3& normal, const Hit& hit, const scene::Material& m) const;

    const scene::Scene* scene_;
    const scene::View* view_;
    const Look* look_;
    Bvh bvh_;
    std::vector<std::uint8_t> left_out_, casters_;
    bool has_holes_ = false;
};

} // namespace scanout::trace
