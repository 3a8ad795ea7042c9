// A tile's lists of parts of small triangles, from set-up to pixels. Included once for every SIMD
// target.
#if defined(SCANOUT_RASTER_PART_LISTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_RASTER_PART_LISTS_INL_H
#undef SCANOUT_RASTER_PART_LISTS_INL_H
#else
#define SCANOUT_RASTER_PART_LISTS_INL_H
#endif

#include <span>

#include "raster/specks-inl.h"
#include "raster/strips-inl.h"

SIMD_BEGIN(scanout::raster)

using Parts = std::span<const TilePart>;

// Any part.
template <Shows kShows>
struct AsStrips {
    using Tag = F32x8::Tag;

    SIMD_INLINE void draw(const TilePlanes& tile, const TilePartList&, const SetUpPartsX8& s,
                          const TilePart*, I32x8& drawn) {
        const std::uint32_t steep = s.live & ~s.plane.flat;
        if (steep != 0) draw_steep_parts<kShows>(tile, s, steep, drawn);
        draw_flat_parts<kShows>(tile, s, s.live & s.plane.flat, drawn);
    }
    SIMD_INLINE void finish(const TilePlanes&, const TilePartList&, I32x8&) {}
};

// Steep specks of a list, which wait until they fill a register.
class SteepSpecks {
public:
    // Those of a register whose bit is set. draw(parts): as many as fill one.
    template <class Draw>
    SIMD_INLINE void add(const TilePart* first, std::uint32_t some, const Draw& draw) {
        for (; some != 0; some &= some - 1) {
            part_[count_++] = first[__builtin_ctz(some)];
            if (count_ == kLanes) finish(draw);
        }
    }
    template <class Draw>
    SIMD_INLINE void finish(const Draw& draw) {
        if (count_ > 0) draw(Parts(part_, static_cast<std::size_t>(count_)));
        count_ = 0;
    }

private:
    TilePart part_[kLanes];
    int count_ = 0;
};

template <Shows kShows, PartKind kKind>
struct AsSpecks {
    using Tag = F32::Tag;
    SpeckBatch<speck_side(kKind)> batch;
    SteepSpecks steep;

    HWY_NOINLINE void add_steep(const TilePlanes& tile, const TilePartList& list, Parts some,
                                I32x8& drawn) {
        const TilePartList of{list.vertices, list.index, some, list.kind, list.id};
        PartCorners<Tag> corner;
        SetUpParts<Tag> s;
        read_corners(of, 0, corner);
        set_up_parts(tile, of, some.data(), static_cast<int>(some.size()), corner, s);
        add_specks<SteepSpeckDepths, kShows>(tile, s, s.live, batch, drawn);
    }
    SIMD_INLINE void draw(const TilePlanes& tile, const TilePartList& list,
                          const SetUpParts<Tag>& s, const TilePart* first, I32x8& drawn) {
        steep.add(first, s.live & ~s.plane.flat,
                  [&](Parts parts) SIMD_LAMBDA { add_steep(tile, list, parts, drawn); });
        add_specks<SpeckDepths<kKind == PartKind::speck_astride>, kShows>(
            tile, s, s.live & s.plane.flat, batch, drawn);
    }
    SIMD_INLINE void finish(const TilePlanes& tile, const TilePartList& list, I32x8& drawn) {
        steep.finish([&](Parts parts) SIMD_LAMBDA { add_steep(tile, list, parts, drawn); });
        draw_batch<kShows>(tile, batch, drawn);
    }
};

// A register is set up before the one in front of it is drawn. Drawing branches on what nobody
// could foretell; were it the end of a set-up that it waits for, the next one could not have begun
// either.
template <Shows kShows, class As>
SIMD_INLINE bool draw_list(const TilePlanes& tile, const TilePartList& list) {
    using Tag = typename As::Tag;
    constexpr int kWidth = static_cast<int>(Int<Tag>::kLanes);
    I32x8 drawn = 0;
    As as;
    const TilePart* const parts = list.parts.data();
    const auto all = static_cast<int>(list.parts.size());
    PartCorners<Tag> corner, next;
    read_corners(list, 0, next);
    SetUpParts<Tag> room[2];
    for (int begin = 0; begin < all + kWidth; begin += kWidth) {
        const int number = begin / kWidth, left = all - begin;
        if (left > 0) {
            corner = next;
            read_corners(list, begin + kWidth, next);
            set_up_parts(tile, list, parts + begin, left < kWidth ? left : kWidth, corner,
                         room[number & 1]);
        }
        if (begin == 0) continue;
        as.draw(tile, list, room[(number & 1) ^ 1], parts + begin - kWidth, drawn);
    }
    as.finish(tile, list, drawn);
    return any(!(drawn == I32x8(0)));
}

template <Shows kShows>
SIMD_INLINE bool draw_kind(const TilePlanes& tile, const TilePartList& list) {
    switch (list.kind) {
    case PartKind::speck_2:
        return draw_list<kShows, AsSpecks<kShows, PartKind::speck_2>>(tile, list);
    case PartKind::speck_3:
        return draw_list<kShows, AsSpecks<kShows, PartKind::speck_3>>(tile, list);
    case PartKind::speck_astride:
        return draw_list<kShows, AsSpecks<kShows, PartKind::speck_astride>>(tile, list);
    case PartKind::strip:
    case PartKind::back:
        break;
    }
    return draw_list<kShows, AsStrips<kShows>>(tile, list);
}

SIMD_END

#endif
