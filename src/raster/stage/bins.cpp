#include "raster/stage/bins.h"

#include <algorithm>

namespace scanout::raster {

void TileBin::clear() {
    for (auto* list : {&triangles, &clipped, &segments, &points, &deferred, &queries})
        list->clear();
    for (auto& of_kind : small)
        of_kind.clear();
    large.clear();
}

bool TileBin::is_empty() const {
    return triangles.empty() && clipped.empty() && segments.empty() && points.empty() &&
           deferred.empty() &&
           std::all_of(small.begin(), small.end(), [](const auto& list) { return list.empty(); });
}

void TileBin::prepend_large() {
    if (large.empty()) return;
    sort_front_to_back(large);
    const std::size_t others = triangles.size();
    triangles.resize(others + large.size());
    std::move_backward(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(others),
                       triangles.end());
    std::transform(large.begin(), large.end(), triangles.begin(),
                   [](DepthAndId of) { return id_of(of); });
}

void WorkerBins::clear(int tiles, bool alpha_modes) {
    triangles_drawn = 0;
    has_clipped = false;
    clipped.clear();
    segments.clear();
    points.clear();
    queries.clear();
    bins.resize(static_cast<std::size_t>(tiles));
    not_opaque.resize(alpha_modes ? static_cast<std::size_t>(tiles) : 0);
    for (auto* all : {&bins, &not_opaque})
        for (TileBin& bin : *all)
            bin.clear();
}

} // namespace scanout::raster
