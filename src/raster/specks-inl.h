// Parts of up to two or three pixels each way, most of what a mesh finer than the picture has, and
// what a tile's edge leaves of larger ones: all pixels of the square are asked about, a part a
// lane, without a branch, and what is covered waits until several registers are done, each at one
// sample. What decides on a pixel comes at the end of a long chain of operations; were it asked for
// at once, the next register's chain could not begin. Included once for every SIMD target.
#if defined(SCANOUT_RASTER_SPECKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_RASTER_SPECKS_INL_H
#undef SCANOUT_RASTER_SPECKS_INL_H
#else
#define SCANOUT_RASTER_SPECKS_INL_H
#endif

#include "raster/blocks-inl.h"
#include "raster/parts-inl.h"

SIMD_BEGIN(scanout::raster)

// A register of parts, at one sample. The pixels of a lane are those of a square, row by row.
template <int kMost>
struct Specks {
    static constexpr int kSteps = 64 / kLanes; // pixels of all lanes in a word
    static constexpr int kWords = (kMost * kMost + kSteps - 1) / kSteps;
    std::uint64_t covered[kWords];
    float depth[kMost * kMost][kLanes];
    std::int32_t place[kLanes]; // of the first pixel, in a plane of the tile
    std::uint32_t name[kLanes];
    std::ptrdiff_t plane;
};
template <int kMost>
struct SpeckBatch {
    static constexpr int kRoom = 64 / kLanes; // registers, each at one sample
    Specks<kMost> specks[kRoom];
    int count = 0;
};

template <Shows kShows, int kMost>
SIMD_INLINE void draw_batch(const TilePlanes& tile, SpeckBatch<kMost>& batch, I32x8& drawn) {
    bool shows = false;
    for (const Specks<kMost>* s = batch.specks; s != batch.specks + batch.count; ++s) {
        float* const depth = tile.depth + s->plane;
        std::uint32_t* const id = id_after<kShows>(tile.id, s->plane);
        for (int word = 0; word < s->kWords; ++word)
            for (std::uint64_t rest = s->covered[word]; rest != 0; rest &= rest - 1) {
                const int bit = __builtin_ctzll(rest), lane = bit % kLanes;
                const int pixel = bit / kLanes + word * s->kSteps;
                const int to = s->place[lane] + pixel / kMost * kTileSize + pixel % kMost;
                const float z = s->depth[pixel][lane], old = depth[to];
                if constexpr (kShows == Shows::depth) {
                    depth[to] = z > old ? z : old;
                } else if (z > old || (z == old && s->name[lane] < id[to])) {
                    depth[to] = z;
                    id[to] = s->name[lane];
                    shows = true;
                }
            }
    }
    // Where depths are kept alone nobody asks whether what is covered shows.
    if (shows || (kShows == Shows::depth && batch.count > 0)) drawn = I32x8(-1);
    batch.count = 0;
}

// The depth of flat specks at their pixels, from the corner of the block that each lies in.
template <bool kAstride>
struct SpeckDepths {
    static constexpr int kBlocks = kAstride ? 2 : 1; // each way
    F32 base[kBlocks][kBlocks], rest[kBlocks][kBlocks];
    F32 per_x, per_y;

    SIMD_INLINE explicit SpeckDepths(const SetUpParts<F32::Tag>& s)
        : per_x(to_f32(s.plane.per_x)), per_y(to_f32(s.plane.per_y)) {
        SIMD_FOR (int down = 0; down < kBlocks; ++down)
            SIMD_FOR (int across = 0; across < kBlocks; ++across) {
                constexpr std::int32_t kBlock = BlockWalk::kSide * kSubpixel;
                I32 corner[3] = {s.edges.c[0], s.edges.c[1], s.edges.c[2]};
                SIMD_FOR (int k = 0; k < 3; ++k) {
                    if (across > 0) corner[k] = corner[k] + s.edges.a[k] * I32(kBlock);
                    if (down > 0) corner[k] = corner[k] + s.edges.b[k] * I32(kBlock);
                }
                const F64 depth = depth_of(corner, s.plane.share);
                base[down][across] = to_f32(depth);
                rest[down][across] = to_f32(depth - to_f64(base[down][across]));
            }
    }
    // x, y: whole pixels from the corner of the first block; sample_x, sample_y: in the pixel.
    SIMD_INLINE F32 at(const I32 (&)[3], I32 x, I32 y, F32 sample_x, F32 sample_y) const {
        if constexpr (kAstride) {
            const I32 side = BlockWalk::kSide, within = BlockWalk::kSide - 1;
            const Mask<F32::Tag> right = x >= side, below = y >= side;
            const auto here = [&](const F32(&corner)[kBlocks][kBlocks]) SIMD_LAMBDA {
                return select(below, select(right, corner[1][1], corner[1][0]),
                              select(right, corner[0][1], corner[0][0]));
            };
            return here(base) + (here(rest) + ((to_f32(x & within) + sample_x) * per_x +
                                               (to_f32(y & within) + sample_y) * per_y));
        } else {
            return base[0][0] +
                   (rest[0][0] + ((to_f32(x) + sample_x) * per_x + (to_f32(y) + sample_y) * per_y));
        }
    }
};

// The depth of steep ones: by the edge functions at every sample, in double (coverage.h).
struct SteepSpeckDepths {
    const SetUpParts<F32::Tag>& s;

    SIMD_INLINE explicit SteepSpeckDepths(const SetUpParts<F32::Tag>& of) : s(of) {}
    // edge: at the sample, with its bias.
    SIMD_INLINE F32 at(const I32 (&edge)[3], I32, I32, F32, F32) const {
        const I32 unbiased[3] = {edge[0] - s.edges.bias[0], edge[1] - s.edges.bias[1],
                                 edge[2] - s.edges.bias[2]};
        return to_f32(depth_of(unbiased, s.plane.share));
    }
};

// At one place in the pattern. first: the edges at the corner of the first pixel.
template <int kMost, class Depths>
SIMD_INLINE void cover_specks(const SetUpParts<F32::Tag>& s, std::uint32_t live,
                              const Depths& depths, const I32 (&first)[3], SampleOffset sample,
                              Specks<kMost>& out) {
    const PartLanes<F32::Tag>& part = s.part;
    const I32 column = part.x0 - part.left, row = part.y0 - part.top;
    const I32 across = part.x1 - part.x0, down = part.y1 - part.y0; // 1 and more
    store(part.y0 * I32(kTileSize) + part.x0, out.place);
    store(load<I32>(part.name), out.name);
    const F32 sample_x = static_cast<float>(sample.x) / kSubpixel;
    const F32 sample_y = static_cast<float>(sample.y) / kSubpixel;
    I32 in_row[3];
    edges_at(s.edges, first, sample, in_row);
    std::uint64_t covered[Specks<kMost>::kWords] = {};
    SIMD_FOR (int j = 0; j < kMost; ++j) {
        I32 edge[3] = {in_row[0], in_row[1], in_row[2]};
        SIMD_FOR (int i = 0; i < kMost; ++i) {
            constexpr int kSteps = Specks<kMost>::kSteps;
            const int pixel = j * kMost + i;
            store(depths.at(edge, column + I32(i), row + I32(j), sample_x, sample_y),
                  out.depth[pixel]);
            I32 outside = edge[0] | edge[1] | edge[2]; // where it is negative
            if (i > 0) outside = outside | (across - I32(i + 1));
            if (j > 0) outside = outside | (down - I32(j + 1));
            covered[pixel / kSteps] |= std::uint64_t{bits(outside > I32(-1)) & live}
                                       << (pixel % kSteps * kLanes);
            SIMD_FOR (int k = 0; k < 3; ++k)
                edge[k] = edge[k] + shift_left<kSubpixelBits>(s.edges.a[k]);
        }
        SIMD_FOR (int k = 0; k < 3; ++k)
            in_row[k] = in_row[k] + shift_left<kSubpixelBits>(s.edges.b[k]);
    }
    SIMD_FOR (int word = 0; word < Specks<kMost>::kWords; ++word)
        out.covered[word] = covered[word];
}

// live: of the lanes of s, which are no larger than the square, and as flat or steep as Depths are
// for: SpeckDepths<false> where they lie within a block. The same bits as their strips.
template <class Depths, Shows kShows, int kMost>
SIMD_INLINE void add_specks(const TilePlanes& tile, const SetUpParts<F32::Tag>& s,
                            std::uint32_t live, SpeckBatch<kMost>& batch, I32x8& drawn) {
    if (live == 0) return;
    const Depths depths(s);
    I32 first[3];
    edges_at_pixel(s.edges, s.part.x0 - s.part.left, s.part.y0 - s.part.top, first);
    std::ptrdiff_t plane = 0;
    for (const SampleOffset* at = tile.pattern.data();
         at != tile.pattern.data() + tile.pattern.size();
         ++at, plane += std::ptrdiff_t{kTileSize} * kTileSize) {
        if (batch.count == batch.kRoom) draw_batch<kShows>(tile, batch, drawn);
        Specks<kMost>& out = batch.specks[batch.count++];
        out.plane = plane;
        cover_specks(s, live, depths, first, *at, out);
    }
}

SIMD_END

#endif
