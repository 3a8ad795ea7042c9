// Painter's order: triangles are blended by the distance of their centroids. Cheap, as no sample
// sorts; wrong where triangles intersect or overlap in a circle, or a large one lies beside small
// ones: there two layers change places, an error of up to the product of their alphas. Newell,
// Newell and Sancha 1972 without the splitting; [Primer 1.6].
#include "shade/gather/gather_input.h"
#include "shade/transparency.h"

#include <algorithm>

namespace scanout::shade::transparency {
namespace {

// Distance from the eye along the view's axis, times three.
double distance(const GatherInput& in, std::uint32_t triangle) {
    const std::uint32_t* index = in.mesh->index.data() + std::size_t{triangle} * 3;
    double corner[3];
    for (std::size_t i = 0; i < 3; ++i) {
        const raster::ClipVertex v = in.transform->to_clip(in.mesh->position[index[i]]);
        corner[i] = in.transform->perspective ? v.w : -v.z;
    }
    std::sort(corner, corner + 3); // independently of the file's order
    return (corner[0] + corner[1]) + corner[2];
}

void triangles_nearest_first(std::span<std::uint32_t> triangles, const GatherInput& in) {
    struct Keyed {
        double distance;
        std::uint32_t triangle;
    };
    std::vector<Keyed> keyed;
    keyed.reserve(triangles.size());
    for (const std::uint32_t t : triangles)
        keyed.push_back({distance(in, t), t});
    std::sort(keyed.begin(), keyed.end(), [](const Keyed& a, const Keyed& b) {
        return a.distance < b.distance || (a.distance == b.distance && a.triangle < b.triangle);
    });
    for (std::size_t i = 0; i < triangles.size(); ++i)
        triangles[i] = keyed[i].triangle;
}

} // namespace

extern const Transparency sorted;
constinit const Transparency sorted{
    {.axis = "transparency",
     .name = "sorted",
     .blurb = "triangles blended in the order of their centroids: wrong where they intersect",
     .source = "Newell, Newell and Sancha 1972",
     .kind = Kind::rung},
    triangles_nearest_first,
    nullptr,
    false};

} // namespace scanout::shade::transparency
