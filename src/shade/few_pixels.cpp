#include "shade/few_pixels.h"

#include <algorithm>

namespace scanout::shade {

FewPixels::FewPixels()
    : pixel_(kPixels + (kRoom - kLanes)), triangle_(pixel_.size()), id_(kPixels) {}

void FewPixels::clear() {
    size_ = triangles_ = 0;
    parts_.clear();
}

// Blocks hold one material: parts of the same stand together, so that they fill blocks.
void FewPixels::arrange() {
    std::sort(parts_.begin(), parts_.end(), [](const Part& a, const Part& b) {
        return a.material != b.material ? a.material < b.material : a.first < b.first;
    });
}

} // namespace scanout::shade
