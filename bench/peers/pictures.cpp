#include "bench/peers/pictures.h"

#include "bench/peers/gl_view.h"

#include <algorithm>

namespace scanout::bench {
namespace {

// distances: 0 where nothing is.
image::Image grey(const std::vector<float>& distances, const DepthRange& range, int width,
                  int height) {
    image::Image picture(width, height, kBackground);
    std::size_t at = 0;
    for (image::Rgba8& pixel : picture.pixels()) {
        const double distance = distances[at++];
        if (distance == 0) continue;
        const double share = (range.far - distance) / (range.far - range.near);
        const auto code = static_cast<std::uint8_t>(55 + 200 * std::clamp(share, 0.0, 1.0));
        pixel = {code, code, code, 255};
    }
    return picture;
}

} // namespace

PicturePair pictures_of(const Ours& ours, const Theirs& theirs, const Load& load,
                        const scene::View& view) {
    if (load.shading != Shading::depth) return {ours.picture(), theirs.picture()};
    const image::Image size = theirs.picture();
    std::vector<float> distances(ours.depth().begin(), ours.depth().end());
    for (float& depth : distances)
        if (depth > 0) depth = static_cast<float>(view.near_distance / static_cast<double>(depth));
    const DepthRange range = depth_range(view, is_inside(load));
    return {grey(distances, range, size.width(), size.height()),
            grey(theirs.distances(view), range, size.width(), size.height())};
}

} // namespace scanout::bench
