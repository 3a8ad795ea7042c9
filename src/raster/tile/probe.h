// Coverage of one triangle alone in front of what a tile holds, and its depth at those samples. It
// is drawn like any other, into a copy of the tile, and undone: the same bits as an opaque
// triangle's.
#pragma once

#include "raster/stage/geometry.h"
#include "raster/tile/tile.h"

#include <cstdint>

namespace scanout::raster {

class Probe {
public:
    // Tests against the tile as it is now; it must outlive the probe's use.
    void reset(const VisibilityTile& front);

    // The pixels of the picture that may hold a sample of the triangle which shows; empty when none
    // does. Valid until the next call.
    image::Rect draw(const Geometry& geometry, std::uint32_t triangle);
    bool covers(int x, int y, int sample) const { return copy_.id(x, y, sample) == id_; }
    std::size_t bytes() const { return copy_.bytes(); }
    float depth(int x, int y, int sample) const { return copy_.depth(x, y, sample); }

private:
    const VisibilityTile* front_ = nullptr;
    VisibilityTile copy_;
    image::Rect drawn_; // to be undone
    std::uint32_t id_ = kNoPrimitive;
};

} // namespace scanout::raster
