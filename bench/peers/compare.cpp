#include "bench/peers/compare.h"

#include "image/flip.h"

#include <algorithm>

namespace scanout::bench {
namespace {

double one_sided(const PicturePair& pair, const image::Rgba8& background) {
    const auto ours = pair.ours.pixels(), theirs = pair.theirs.pixels();
    std::size_t either = 0, one = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        const bool by_us = ours[i] != background, by_them = theirs[i] != background;
        if (by_us || by_them) ++either;
        if (by_us != by_them) ++one;
    }
    return either == 0 ? 1 : static_cast<double>(one) / static_cast<double>(either);
}

} // namespace

Difference difference(const PicturePair& pair, const image::Rgba8& background) {
    return {static_cast<double>(image::mean_flip(pair.theirs, pair.ours)),
            one_sided(pair, background)};
}

Difference worse(const Difference& a, const Difference& b) {
    return {std::max(a.flip, b.flip), std::max(a.one_sided, b.one_sided)};
}

} // namespace scanout::bench
