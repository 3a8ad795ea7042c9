// Coverage and depth of one triangle alone, at the samples where it lies in front of a tile's
// contents. Draws it like any other into a copy of the tile, and undoes that: the same bits as an
// opaque triangle's.
#pragma once

#include "raster/stage/geometry.h"
#include "raster/tile/tile.h"

#include <cstdint>

namespace scanout::raster {

class Probe {
public:
    // Tests against the present contents of the tile, which must outlive the probe's use, in the
    // blocks of 8 x 8 pixels around a region of it.
    void reset(const VisibilityTile& front, const image::Rect& region);

    // The pixels of the picture that may hold a visible sample of the triangle; empty when it has
    // none in those blocks. Valid until the next call.
    image::Rect draw(const Geometry& geometry, std::uint32_t triangle);
    bool covers(int x, int y, int sample) const { return copy_.id(x, y, sample) == id_; }
    std::size_t bytes() const { return copy_.bytes(); }
    float depth(int x, int y, int sample) const { return copy_.depth(x, y, sample); }

private:
    const VisibilityTile* front_ = nullptr;
    VisibilityTile copy_;
    image::Rect drawn_; // to be restored
    std::uint32_t id_ = kNoPrimitive;
};

} // namespace scanout::raster
