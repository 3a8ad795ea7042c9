// Triangle culling in lanes: removes back faces, triangles beside the picture, and triangles that
// cover no sample, before anything of them is stored.
#pragma once

#include "base/technique.h"
#include "raster/screen/sample_pattern.h"
#include "raster/screen/screen.h"

#include <cstdint>
#include <span>
#include <vector>

namespace scanout::raster {

enum class Facing : std::uint8_t { any, front, back }; // the triangles that are kept

struct CullRow {
    Technique card;
    Facing keep;
};

struct CullOptions {
    int width = 0, height = 0; // of the picture
    Facing keep = Facing::any;
    bool mirrored = false; // front faces wind clockwise in view space
    SampleExtent extent;
    std::span<const SampleOffset> pattern; // empty: keeps triangles that lie between samples, too
};

// Is a triangle that winds this way on the screen (y down) kept?
bool keeps_facing(const CullOptions& options, bool clockwise);

// A triangle that passed culling, and the pixels that may hold its samples: columns [x0, x1), rows
// [y0, y1).
struct VisibleTriangle {
    std::uint32_t spatial_index; // position in the index that was culled
    std::uint32_t from, to;      // x in the low half, y in the high one; `from` has two flags, too

    static constexpr std::uint32_t kSmall = 1U << 31;      // at most kSmallSide pixels each way
    static constexpr std::uint32_t kBackFacing = 1U << 15; // where both sides are kept

    bool small() const { return (from & kSmall) != 0; }
    bool back_facing() const { return (from & kBackFacing) != 0; }
    int x0() const { return static_cast<int>(from & 0x7fff); }
    int y0() const { return static_cast<int>((from & ~kSmall) >> 16); }
    int x1() const { return static_cast<int>(to & 0xffff); }
    int y1() const { return static_cast<int>(to >> 16); }
};

inline constexpr std::size_t kRegisterPadding = 16; // elements that kernels may touch beyond a list

// The result for a list of triangles: `visible` are on the screen, have an area, face as wanted and
// may cover a sample (those a few pixels wide do); `to_clip` have a vertex off the screen and may
// be visible. The lists grow to the number of triangles plus kRegisterPadding.
struct CullResult {
    std::vector<VisibleTriangle> visible;
    std::vector<std::uint32_t> to_clip;
    std::size_t visible_count = 0, to_clip_count = 0;
};

// index: three vertices each of the triangles first, first + 1, ...
void cull_triangles(const CullOptions& options, std::span<const ScreenVertex> vertices,
                    std::span<const std::uint32_t> index, std::uint32_t first, CullResult& result);

} // namespace scanout::raster
