// Lists of binned small triangles of one kind, from set-up to depth writes. Included once for every
// SIMD target.
#if defined(SCANOUT_RASTER_MICRO_SMALL_LIST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_RASTER_MICRO_SMALL_LIST_INL_H
#undef SCANOUT_RASTER_MICRO_SMALL_LIST_INL_H
#else
#define SCANOUT_RASTER_MICRO_SMALL_LIST_INL_H
#endif

#include <span>

#include "raster/micro/micro_triangles-inl.h"
#include "raster/micro/small_rows-inl.h"

SIMD_BEGIN(scanout::raster)

using BinnedSpan = std::span<const BinnedTriangle>;

// Small triangles of any kind.
template <DepthWrite kWrite>
struct RowsDrawer {
    using Tag = F32x8::Tag;

    SIMD_INLINE void draw(const TilePlanes& tile, const BinnedList&, const SmallSetupX8& s,
                          const BinnedTriangle*, I32x8& drawn) {
        const std::uint32_t double_depth = s.live & ~s.plane.float_depth;
        if (double_depth != 0) draw_double_depth<kWrite>(tile, s, double_depth, drawn);
        draw_float_depth<kWrite>(tile, s, s.live & s.plane.float_depth, drawn);
    }
    SIMD_INLINE void finish(const TilePlanes&, const BinnedList&, I32x8&) {}
};

// Collects micro-triangles with double depth until they fill a register: drawn one by one they took
// 5 % of the dragon's frame with a shadow map.
class DoubleDepthQueue {
public:
    // Adds the triangles of a register whose bit is set. draw(triangles) draws a full register.
    template <class Draw>
    SIMD_INLINE void add(const BinnedTriangle* first, std::uint32_t some, const Draw& draw) {
        for (; some != 0; some &= some - 1) {
            binned_[count_++] = first[__builtin_ctz(some)];
            if (count_ == kLanes) finish(draw);
        }
    }
    template <class Draw>
    SIMD_INLINE void finish(const Draw& draw) {
        if (count_ > 0) draw(BinnedSpan(binned_, static_cast<std::size_t>(count_)));
        count_ = 0;
    }

private:
    BinnedTriangle binned_[kLanes];
    int count_ = 0;
};

template <DepthWrite kWrite, SmallKind kKind>
struct MicroDrawer {
    using Tag = F32::Tag;
    MicroBatch batch;
    DoubleDepthQueue double_depth;

    HWY_NOINLINE void add_double_depth(const TilePlanes& tile, const BinnedList& list,
                                       BinnedSpan some, I32x8& drawn) {
        const BinnedList of{list.vertices, list.index, some, list.kind, list.id};
        VertexIndices<Tag> vertex;
        SmallSetup<Tag> s;
        read_vertices(of, 0, vertex);
        set_up_small(tile, of, some.data(), static_cast<int>(some.size()), vertex, s);
        add_micro<MicroDoubleDepth, kWrite>(tile, s, s.live, batch, drawn);
    }
    SIMD_INLINE void draw(const TilePlanes& tile, const BinnedList& list, const SmallSetup<Tag>& s,
                          const BinnedTriangle* first, I32x8& drawn) {
        double_depth.add(first, s.live & ~s.plane.float_depth,
                         [&](BinnedSpan triangles)
                             SIMD_LAMBDA { add_double_depth(tile, list, triangles, drawn); });
        add_micro<MicroFloatDepth<kKind == SmallKind::micro_straddling>, kWrite>(
            tile, s, s.live & s.plane.float_depth, batch, drawn);
    }
    SIMD_INLINE void finish(const TilePlanes& tile, const BinnedList& list, I32x8& drawn) {
        double_depth.finish([&](BinnedSpan triangles)
                                SIMD_LAMBDA { add_double_depth(tile, list, triangles, drawn); });
        draw_micro_batch<kWrite>(tile, batch, drawn);
    }
};

// Software pipelining: sets a register up before drawing the one in front of it. Drawing ends in
// branch mispredictions; if these waited for the end of a set-up, the next set-up could not overlap
// with it.
template <DepthWrite kWrite, class As>
SIMD_INLINE bool draw_list(const TilePlanes& tile, const BinnedList& list) {
    using Tag = typename As::Tag;
    constexpr int kWidth = static_cast<int>(Int<Tag>::kLanes);
    I32x8 drawn = 0;
    As as;
    const BinnedTriangle* const triangles = list.triangles.data();
    const auto all = static_cast<int>(list.triangles.size());
    VertexIndices<Tag> vertex, next;
    read_vertices(list, 0, next);
    SmallSetup<Tag> scratch[2];
    for (int begin = 0; begin < all + kWidth; begin += kWidth) {
        const int number = begin / kWidth, left = all - begin;
        if (left > 0) {
            vertex = next;
            read_vertices(list, begin + kWidth, next);
            set_up_small(tile, list, triangles + begin, left < kWidth ? left : kWidth, vertex,
                         scratch[number & 1]);
        }
        if (begin == 0) continue;
        as.draw(tile, list, scratch[(number & 1) ^ 1], triangles + begin - kWidth, drawn);
    }
    as.finish(tile, list, drawn);
    return any(!(drawn == I32x8(0)));
}

template <DepthWrite kWrite>
SIMD_INLINE bool draw_kind(const TilePlanes& tile, const BinnedList& list) {
    switch (list.kind) {
    case SmallKind::micro:
        return draw_list<kWrite, MicroDrawer<kWrite, SmallKind::micro>>(tile, list);
    case SmallKind::micro_straddling:
        return draw_list<kWrite, MicroDrawer<kWrite, SmallKind::micro_straddling>>(tile, list);
    case SmallKind::rows:
    case SmallKind::back_facing:
        break;
    }
    return draw_list<kWrite, RowsDrawer<kWrite>>(tile, list);
}

SIMD_END

#endif
