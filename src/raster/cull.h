// Which triangles can be seen at all: set-up and culling of whole triangles in lanes, before
// anything of them is stored.
#pragma once

#include "base/technique.h"
#include "raster/sample_pattern.h"
#include "raster/screen.h"

#include <cstdint>
#include <span>
#include <vector>

namespace scanout::raster {

enum class Facing : std::uint8_t { any, front, back }; // which triangles are kept

struct CullRow {
    Technique card;
    Facing keep;
};
std::span<const CullRow* const> cullings(); // in the order of techniques.h

struct CullOptions {
    int width = 0, height = 0; // of the picture
    Facing keep = Facing::any;
    bool mirrored = false; // front faces wind clockwise in view space
    SampleExtent extent;
    std::span<const SampleOffset> pattern; // empty: what lies between samples is kept, too
};

// Is a triangle that winds this way on the screen (y down) kept?
bool faces_as_wanted(const CullOptions& options, bool clockwise);

// A triangle, and the pixels that may hold its samples: from (x0, y0) up to, but not with, (x1,
// y1).
struct KeptTriangle {
    std::uint32_t place;    // in the order of the index that was culled
    std::uint32_t from, to; // x in the low half, y in the high one; `from` has two flags, too

    static constexpr std::uint32_t kSmall = 1U << 31; // at most kSmallSide pixels each way
    static constexpr std::uint32_t kAway = 1U << 15;  // a back, where fronts are kept as well

    bool small() const { return (from & kSmall) != 0; }
    bool away() const { return (from & kAway) != 0; }
    int x0() const { return static_cast<int>(from & 0x7fff); }
    int y0() const { return static_cast<int>((from & ~kSmall) >> 16); }
    int x1() const { return static_cast<int>(to & 0xffff); }
    int y1() const { return static_cast<int>(to >> 16); }
};

inline constexpr std::size_t kRegisterRoom = 16; // lanes that kernels may touch beyond a list

// What is left of a list of triangles: `kept` are on the screen, have an area, face as wanted and
// may cover a sample (those a few pixels wide: do); `cut` have a vertex off the screen and may be
// seen. The lists grow to have room for all, and for kRegisterRoom more.
struct CullResult {
    std::vector<KeptTriangle> kept;
    std::vector<std::uint32_t> cut;
    std::size_t kept_count = 0, cut_count = 0;
};

// index: three vertices each of the triangles first, first + 1, ...
void cull(const CullOptions& options, std::span<const ScreenVertex> vertices,
          std::span<const std::uint32_t> index, std::uint32_t first, CullResult& result);

} // namespace scanout::raster
