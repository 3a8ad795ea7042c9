// Parts of up to two or three pixels each way, most of what a mesh finer than the picture has: all
// pixels of the square are asked about, a part a lane, without a branch, and what is covered waits
// until several registers are done, each at one sample. What decides on a pixel comes at the end of
// a long chain of operations; were it asked for at once, the next register's chain could not begin.
// Included once for every SIMD target.
#if defined(SCANOUT_RASTER_SPECKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_RASTER_SPECKS_INL_H
#undef SCANOUT_RASTER_SPECKS_INL_H
#else
#define SCANOUT_RASTER_SPECKS_INL_H
#endif

#include "raster/parts-inl.h"

SIMD_BEGIN(scanout::raster)

// A register of parts, at one sample. The pixels of a lane are those of a square, row by row.
template <int kMost>
struct Specks {
    static constexpr int kSteps = 64 / kLanesX8; // pixels of all lanes in a word
    static constexpr int kWords = (kMost * kMost + kSteps - 1) / kSteps;
    std::uint64_t covered[kWords];
    float depth[kMost * kMost][kLanesX8];
    std::int32_t place[kLanesX8]; // of the first pixel, in a plane of the tile
    std::uint32_t name[kLanesX8];
    std::size_t plane;
};
template <int kMost>
struct SpeckBatch {
    static constexpr int kRoom = 8; // registers, each at one sample
    Specks<kMost> specks[kRoom];
    int count = 0;
};

template <int kMost>
HWY_INLINE void draw_batch(const TilePlanes& tile, SpeckBatch<kMost>& batch, I32x8& drawn) {
    bool shows = false;
    for (const Specks<kMost>* s = batch.specks; s != batch.specks + batch.count; ++s) {
        float* const depth = tile.depth + s->plane;
        std::uint32_t* const id = tile.id + s->plane;
        for (int word = 0; word < s->kWords; ++word)
            for (std::uint64_t rest = s->covered[word]; rest != 0; rest &= rest - 1) {
                const int bit = __builtin_ctzll(rest), lane = bit % kLanesX8;
                const int pixel = bit / kLanesX8 + word * s->kSteps;
                const int to = s->place[lane] + pixel / kMost * kTileSize + pixel % kMost;
                const float z = s->depth[pixel][lane], old = depth[to];
                if (z > old || (z == old && s->name[lane] < id[to])) {
                    depth[to] = z;
                    id[to] = s->name[lane];
                    shows = true;
                }
            }
    }
    batch.count = 0;
    if (shows) drawn = I32x8(-1);
}

// live: of the lanes of s, which are flat, within one block and no larger than the square. The same
// bits as their strips.
template <int kMost>
HWY_INLINE void add_specks(const TilePlanes& tile, const SetUpParts& s, std::uint32_t live,
                           SpeckBatch<kMost>& batch, I32x8& drawn) {
    if (live == 0) return;
    const F64x8 depth = depth_of(s.edges.c, s.plane.share); // at the block's corner
    const F32x8 base = to_f32(depth), rest = to_f32(depth - to_f64(base));
    const F32x8 per_x = to_f32(s.plane.per_x), per_y = to_f32(s.plane.per_y);
    const PartLanes& part = s.part;
    const I32x8 column = part.x0 - part.left, row = part.y0 - part.top;
    const I32x8 across = part.x1 - part.x0, down = part.y1 - part.y0;
    I32x8 first[3]; // the edges at the first pixel's corner
    edges_at_pixel(s.edges, column, row, first);
    std::size_t plane = 0;
    for (const SampleOffset* at = tile.pattern.data();
         at != tile.pattern.data() + tile.pattern.size();
         ++at, plane += std::size_t{kTileSize} * kTileSize) {
        if (batch.count == batch.kRoom) draw_batch(tile, batch, drawn);
        Specks<kMost>& out = batch.specks[batch.count++];
        out.plane = plane;
        store(part.y0 * I32x8(kTileSize) + part.x0, out.place);
        store(load<I32x8>(part.name), out.name);
        const F32x8 sample_x = static_cast<float>(at->x) / kSubpixel;
        const F32x8 sample_y = static_cast<float>(at->y) / kSubpixel;
        I32x8 in_row[3];
        edges_at(s.edges, first, *at, in_row);
        std::uint64_t covered[Specks<kMost>::kWords] = {};
        SIMD_UNROLL
        for (int j = 0; j < kMost; ++j) {
            const F32x8 y = (to_f32(row + I32x8(j)) + sample_y) * per_y;
            I32x8 edge[3] = {in_row[0], in_row[1], in_row[2]};
            SIMD_UNROLL
            for (int i = 0; i < kMost; ++i) {
                constexpr int kSteps = Specks<kMost>::kSteps;
                const int pixel = j * kMost + i;
                const F32x8 x = (to_f32(column + I32x8(i)) + sample_x) * per_x;
                store(base + (rest + (x + y)), out.depth[pixel]);
                const MaskX8 inside = (I32x8(j) < down) & (I32x8(i) < across) &
                                      ((edge[0] | edge[1] | edge[2]) > I32x8(-1));
                covered[pixel / kSteps] |= std::uint64_t{bits(inside) & live}
                                           << (pixel % kSteps * kLanesX8);
                SIMD_UNROLL
                for (int k = 0; k < 3; ++k)
                    edge[k] = edge[k] + shift_left<kSubpixelBits>(s.edges.a[k]);
            }
            SIMD_UNROLL
            for (int k = 0; k < 3; ++k)
                in_row[k] = in_row[k] + shift_left<kSubpixelBits>(s.edges.b[k]);
        }
        SIMD_UNROLL
        for (int word = 0; word < Specks<kMost>::kWords; ++word)
            out.covered[word] = covered[word];
    }
}

SIMD_END

#endif
