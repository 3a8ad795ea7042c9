#include "shade/gather/unlit.h"

#include "raster/screen/clip.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace scanout::shade {
namespace {

// The colour of a line at fraction t of its length, never outside the range of its ends.
Vec3 along(const Vec3& from, const Vec3& to, float before, float after) {
    const float t = after / (before + after);
    Vec3 colour;
    for (int c = 0; c < 3; ++c) {
        const float mixed = from[c] + t * (to[c] - from[c]);
        colour[c] = std::min(std::max(mixed, std::min(from[c], to[c])), std::max(from[c], to[c]));
    }
    return colour;
}

Vec3 line_colour(const GatherInput& in, std::size_t line, int x, int y) {
    const geom::Mesh& mesh = *in.mesh;
    std::uint32_t from = mesh.line_index[line * 2], to = mesh.line_index[line * 2 + 1];
    raster::ClipVertex a = in.transform->to_clip(mesh.position[from]),
                       b = in.transform->to_clip(mesh.position[to]);
    if (std::tie(b.y, b.x, b.w) < std::tie(a.y, a.x, a.w)) { // whichever the file names first
        std::swap(a, b);
        std::swap(from, to);
    }
    // The line p = a + t (b - a) where it passes the pixel's centre on its longer axis: linear in t
    // before the divide, so ends behind the eye do no harm.
    const bool along_x = std::abs(b.x * a.w - a.x * b.w) >= std::abs(b.y * a.w - a.y * b.w);
    const double centre = (along_x ? x : y) + 0.5;
    const double before = (along_x ? a.x : a.y) - centre * a.w,
                 after = (along_x ? b.x : b.y) - centre * b.w;
    const double t = before == after ? 0.0 : before / (before - after);
    const double clamped = t > 0 ? (t < 1 ? t : 1.0) : 0.0;
    return along(mesh.colour[from], mesh.colour[to], static_cast<float>(1 - clamped),
                 static_cast<float>(clamped));
}

} // namespace

Vec3 unlit_colour(const GatherInput& in, const scene::Material& material, std::uint32_t id, int x,
                  int y) {
    if (in.added != nullptr && id >= in.added->first_id) return in.added->colour(id);
    if (!in.frame->attributes.colour) return material.diffuse;
    const geom::Mesh& mesh = *in.mesh;
    const std::size_t line = id - mesh.triangles();
    const Vec3 own = line < mesh.lines() ? line_colour(in, line, x, y)
                                         : mesh.colour[mesh.point_index[line - mesh.lines()]];
    return {material.diffuse.x * own.x, material.diffuse.y * own.y, material.diffuse.z * own.z};
}

} // namespace scanout::shade
