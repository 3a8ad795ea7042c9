// Micro-triangles, of at most three pixels each way: most triangles of a mesh finer than the
// picture, and the parts of larger ones at a tile's edge. Tests every pixel of the square, a
// triangle a lane, without a branch. Stores covered samples for several registers and depth-tests
// them afterwards: a test at once would branch on the end of a long dependency chain, and a branch
// misprediction would delay the next register's chain. Included once for every SIMD target.
#if defined(SCANOUT_RASTER_MICRO_MICRO_TRIANGLES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_RASTER_MICRO_MICRO_TRIANGLES_INL_H
#undef SCANOUT_RASTER_MICRO_MICRO_TRIANGLES_INL_H
#else
#define SCANOUT_RASTER_MICRO_MICRO_TRIANGLES_INL_H
#endif

#include "raster/coverage/blocks-inl.h"
#include "raster/micro/small_setup-inl.h"

SIMD_BEGIN(scanout::raster)

// A register of micro-triangles at one sample. Each lane covers the pixels of a square, row by row.
struct MicroTriangles {
    static constexpr int kPixels = kMicroSide * kMicroSide;
    static constexpr int kSteps = 64 / kLanes; // pixels of all lanes in a word
    static constexpr int kWords = (kPixels + kSteps - 1) / kSteps;
    std::uint64_t covered[kWords];
    float depth[kPixels][kLanes];
    std::int32_t pixel_offset[kLanes]; // of the first pixel, in a plane of the tile
    std::uint32_t id[kLanes];
    std::ptrdiff_t plane;
};
struct MicroBatch {
    static constexpr int kCapacity = 64 / kLanes; // registers, each at one sample
    MicroTriangles micro[kCapacity];
    int count = 0;
};

template <DepthWrite kWrite>
SIMD_INLINE void draw_micro_batch(const TilePlanes& tile, MicroBatch& batch, I32x8& drawn) {
    bool written = false;
    for (const MicroTriangles* s = batch.micro; s != batch.micro + batch.count; ++s) {
        float* const depth = tile.depth + s->plane;
        std::uint32_t* const id = id_after<kWrite>(tile.id, s->plane);
        for (int word = 0; word < s->kWords; ++word)
            for (std::uint64_t rest = s->covered[word]; rest != 0; rest &= rest - 1) {
                const int bit = __builtin_ctzll(rest), lane = bit % kLanes;
                const int pixel = bit / kLanes + word * s->kSteps;
                const int to =
                    s->pixel_offset[lane] + pixel / kMicroSide * kTileSize + pixel % kMicroSide;
                const float z = s->depth[pixel][lane], old = depth[to];
                if constexpr (kWrite == DepthWrite::depth_only) {
                    depth[to] = z > old ? z : old;
                } else if (z > old || (z == old && s->id[lane] < id[to])) {
                    depth[to] = z;
                    id[to] = s->id[lane];
                    written = true;
                }
            }
    }
    // Where only depth is stored, nobody reads which of the covered samples passed the test.
    if (written || (kWrite == DepthWrite::depth_only && batch.count > 0)) drawn = I32x8(-1);
    batch.count = 0;
}

// Float depth (raster/coverage/coverage.h) of micro-triangles at their pixels, from the corner of
// the block that each pixel lies in.
template <bool kStraddling>
struct MicroFloatDepth {
    static constexpr int kBlocks = kStraddling ? 2 : 1; // each way
    F32 base[kBlocks][kBlocks], rest[kBlocks][kBlocks];
    F32 per_x, per_y;

    SIMD_INLINE explicit MicroFloatDepth(const SmallSetup<F32::Tag>& s)
        : per_x(to_f32(s.plane.per_x)), per_y(to_f32(s.plane.per_y)) {
        SIMD_FOR (int down = 0; down < kBlocks; ++down)
            SIMD_FOR (int across = 0; across < kBlocks; ++across) {
                constexpr std::int32_t kBlock = PixelBlock::kSide * kSubpixel;
                I32 corner[3] = {s.edges.c[0], s.edges.c[1], s.edges.c[2]};
                SIMD_FOR (int k = 0; k < 3; ++k) {
                    if (across > 0) corner[k] = corner[k] + s.edges.a[k] * I32(kBlock);
                    if (down > 0) corner[k] = corner[k] + s.edges.b[k] * I32(kBlock);
                }
                const F64 depth = depth_of(corner, s.plane.depth_factor);
                base[down][across] = to_f32(depth);
                rest[down][across] = to_f32(depth - to_f64(base[down][across]));
            }
    }
    // x, y: whole pixels from the corner of the first block; sample_x, sample_y: in the pixel.
    SIMD_INLINE F32 at(const I32 (&)[3], I32 x, I32 y, F32 sample_x, F32 sample_y) const {
        if constexpr (kStraddling) {
            const I32 side = PixelBlock::kSide, within = PixelBlock::kSide - 1;
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

// Double depth: from the edge functions at every sample (raster/coverage/coverage.h).
struct MicroDoubleDepth {
    const SmallSetup<F32::Tag>& s;

    SIMD_INLINE explicit MicroDoubleDepth(const SmallSetup<F32::Tag>& of) : s(of) {}
    // edge: at the sample, with its bias.
    SIMD_INLINE F32 at(const I32 (&edge)[3], I32, I32, F32, F32) const {
        const I32 unbiased[3] = {edge[0] - s.edges.bias[0], edge[1] - s.edges.bias[1],
                                 edge[2] - s.edges.bias[2]};
        return to_f32(depth_of(unbiased, s.plane.depth_factor));
    }
};

// At one sample of the pattern. first: the edge functions at the corner of the first pixel.
template <class Depths>
SIMD_INLINE void cover_micro(const SmallSetup<F32::Tag>& s, std::uint32_t live,
                             const Depths& depths, const I32 (&first)[3], SampleOffset sample,
                             MicroTriangles& out) {
    const SmallLanes<F32::Tag>& lanes = s.lanes;
    const I32 column = lanes.x0 - lanes.left, row = lanes.y0 - lanes.top;
    const I32 across = lanes.x1 - lanes.x0, down = lanes.y1 - lanes.y0; // 1 and more
    store(lanes.y0 * I32(kTileSize) + lanes.x0, out.pixel_offset);
    store(load<I32>(lanes.id), out.id);
    const F32 sample_x = static_cast<float>(sample.x) / kSubpixel;
    const F32 sample_y = static_cast<float>(sample.y) / kSubpixel;
    I32 in_row[3];
    edges_at(s.edges, first, sample, in_row);
    std::uint64_t covered[MicroTriangles::kWords] = {};
    SIMD_FOR (int j = 0; j < kMicroSide; ++j) {
        I32 edge[3] = {in_row[0], in_row[1], in_row[2]};
        SIMD_FOR (int i = 0; i < kMicroSide; ++i) {
            constexpr int kSteps = MicroTriangles::kSteps;
            const int pixel = j * kMicroSide + i;
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
    SIMD_FOR (int word = 0; word < MicroTriangles::kWords; ++word)
        out.covered[word] = covered[word];
}

// live: the lanes of s that fit the square and have the kind of depth that Depths computes;
// MicroFloatDepth<false> needs triangles within one block. Gives the same bits as drawing by rows.
template <class Depths, DepthWrite kWrite>
SIMD_INLINE void add_micro(const TilePlanes& tile, const SmallSetup<F32::Tag>& s,
                           std::uint32_t live, MicroBatch& batch, I32x8& drawn) {
    if (live == 0) return;
    const Depths depths(s);
    I32 first[3];
    edges_at_pixel(s.edges, s.lanes.x0 - s.lanes.left, s.lanes.y0 - s.lanes.top, first);
    std::ptrdiff_t plane = 0;
    for (const SampleOffset* at = tile.pattern.data();
         at != tile.pattern.data() + tile.pattern.size();
         ++at, plane += std::ptrdiff_t{kTileSize} * kTileSize) {
        if (batch.count == batch.kCapacity) draw_micro_batch<kWrite>(tile, batch, drawn);
        MicroTriangles& out = batch.micro[batch.count++];
        out.plane = plane;
        cover_micro(s, live, depths, first, *at, out);
    }
}

SIMD_END

#endif
