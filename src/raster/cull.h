// Which triangles can be seen at all: set-up and culling of whole triangles in lanes, before
// anything of them is stored.
#pragma once

#include "raster/sample_pattern.h"
#include "raster/screen.h"

#include <cstdint>
#include <span>

namespace scanout::raster {

enum class Facing : std::uint8_t { any, front, back }; // which triangles are kept

struct CullOptions {
    int width = 0, height = 0; // of the picture
    Facing keep = Facing::any;
    bool mirrored = false; // front faces wind clockwise in view space
    SampleExtent extent;
};

// Is a triangle that winds this way on the screen (y down) kept?
bool faces_as_wanted(const CullOptions& options, bool clockwise);

// A triangle that may cover a sample, and the pixels that may hold one (x1, y1 excluded).
struct KeptTriangle {
    std::uint32_t triangle;
    std::int16_t x0, y0, x1, y1;
};

// index: three vertices each of the triangles first, first + 1, ... Appends to `kept` those on the
// screen that have an area, face as wanted and may cover a sample, and to `cut` those that have a
// vertex off the screen and may be seen. Both have room for all; the counts are set.
struct CullResult {
    std::span<KeptTriangle> kept;
    std::span<std::uint32_t> cut;
    std::size_t kept_count = 0, cut_count = 0;
};
void cull(const CullOptions& options, std::span<const ScreenVertex> vertices,
          std::span<const std::uint32_t> index, std::uint32_t first, CullResult& result);

} // namespace scanout::raster
