// What a sample shows of a primitive that covers it. Included once for every SIMD target.
#if defined(SCANOUT_RASTER_SHOW_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_RASTER_SHOW_INL_H
#undef SCANOUT_RASTER_SHOW_INL_H
#else
#define SCANOUT_RASTER_SHOW_INL_H
#endif

#include "raster/block_walk.h"
#include "raster/visible_rule.h"

#include "simd/lanes-inl.h"

SIMD_BEGIN(scanout::raster)

using MaskX8 = Mask<F32x8::Tag>;

// What a kernel shows: by the usual rule depth and id, or depth alone where a tile keeps no more;
// or both by another rule.
enum class Shows { usual, depth, by_rule };
constexpr bool is_usual(Shows shows) {
    return shows != Shows::by_rule;
}
// The id of so many pixels further on: a tile that keeps depth alone has none.
template <Shows kShows>
SIMD_INLINE std::uint32_t* id_after(std::uint32_t* id, std::ptrdiff_t pixels) {
    return kShows == Shows::depth ? nullptr : id + pixels;
}

// Registers that a row of a block takes where they are narrow; rows that one has where they are
// wide.
constexpr int kRegisters = kLanes < BlockWalk::kSide ? BlockWalk::kSide / kLanes : 1;
constexpr int kRows = kLanes > BlockWalk::kSide ? kLanes / BlockWalk::kSide : 1;
// Of the lanes of a register of these: which column of the block, and which of its rows.
SIMD_INLINE I32 columns(int number) {
    return iota<I32>(number * kLanes) & I32(BlockWalk::kSide - 1);
}
SIMD_INLINE I32 rows() {
    return shift_right<3>(iota<I32>(0));
}

// Pixels of a tile from one on: of its row, and where a register has room for eight more of the row
// below.
template <class T, class Word>
SIMD_INLINE T load_pixels(const Word* from) {
    static_assert(T::kLanes <= 2 * BlockWalk::kSide);
    if constexpr (T::kLanes > BlockWalk::kSide)
        return load_halves<T>(from, from + kTileSize);
    else
        return load<T>(from);
}
template <class T, class Word>
SIMD_INLINE void store_pixels(T a, Word* to) {
    if constexpr (T::kLanes > BlockWalk::kSide)
        store_halves(a, to, to + kTileSize);
    else
        store(a, to);
}

// Of what is inside the nearest stays, at a tie the lower id. Returns the depths that are there
// now. No depth that is there is below 0, and none here is NaN or -0: so their bits are in order as
// whole numbers, and a tie that the lower id wins is won against a depth of one less.
template <class D>
SIMD_INLINE Float<D> show(Mask<D> inside, Float<D> z, std::uint32_t primitive, float* depth,
                          std::uint32_t* id, Int<D>& drawn) {
    using Id = Int<D>;
    const auto old = load_pixels<Float<D>>(depth);
    const Id old_id = load_pixels<Id>(id), new_id = static_cast<std::int32_t>(primitive);
    const Mask<D> pass =
        inside & (bits_of(z) > less_one_where(less_unsigned(new_id, old_id), bits_of(old)));
    const Float<D> now = select(pass, z, old);
    store_pixels(now, depth);
    store_pixels(select(pass, new_id, old_id), id);
    drawn = select(pass, Id(-1), drawn);
    return now;
}

// The same depths: at a tie they are one, whatever the ids. What has shown is nearer than what was
// there.
template <class D>
SIMD_INLINE Float<D> show_depth(Mask<D> inside, Float<D> z, float* depth, Int<D>& drawn) {
    const auto old = load_pixels<Float<D>>(depth);
    const Mask<D> pass = inside & (z > old);
    const Float<D> now = select(pass, z, old);
    store_pixels(now, depth);
    drawn = select(pass, Int<D>(-1), drawn);
    return now;
}

// VisibleRule::kept.
template <class D>
SIMD_INLINE Float<D> kept(Float<D> z, const VisibleRule& rule) {
    if (!rule.standard) return z;
    using Wide = Double<D>;
    const Wide turned = Wide(1.0) - to_f64(z), whole = 0x1.8p52;
    const Wide stored = rule.steps > 0
                            ? ((turned * Wide(rule.steps) + whole) - whole) / Wide(rule.steps)
                            : to_f64(to_f32(turned));
    return to_f32(Wide(1.0) - stored);
}

// The same by another rule than the usual one.
template <class D>
SIMD_INLINE Float<D> show_by(const VisibleRule& rule, Mask<D> inside, Float<D> depth_here,
                             std::uint32_t primitive, float* depth, std::uint32_t* id,
                             Int<D>& drawn) {
    using Id = Int<D>;
    const Float<D> z = kept(depth_here, rule), old = load_pixels<Float<D>>(depth);
    const Id old_id = load_pixels<Id>(id), new_id = static_cast<std::int32_t>(primitive);
    const Id half = INT32_MIN, mine = new_id + half, others = old_id + half;
    const Mask<D> empty = old_id == Id(-1), tie = z == old;
    const Mask<D> lower = mine < others;
    const Mask<D> higher = others < mine;
    Mask<D> pass = mine < mine; // none
    switch (rule.test) {
    case DepthTest::equal:
        pass = (!empty) & tie & higher;
        break;
    case DepthTest::always:
        pass = empty | higher;
        break;
    case DepthTest::never:
        break;
    case DepthTest::less:
        pass = empty | (z < old) | (tie & lower);
        break;
    case DepthTest::less_equal:
        pass = empty | (z < old) | (tie & higher);
        break;
    case DepthTest::greater_equal:
        pass = empty | (z > old) | (tie & higher);
        break;
    case DepthTest::greater:
        pass = (z > old) | (tie & lower);
        break;
    }
    pass = pass & inside;
    const Float<D> now = select(pass, z, old);
    store_pixels(now, depth);
    store_pixels(select(pass, new_id, old_id), id);
    drawn = select(pass, Id(-1), drawn);
    return now;
}

template <Shows kShows, class D>
SIMD_INLINE Float<D> show_samples(const VisibleRule& rule, Mask<D> inside, Float<D> z,
                                  std::uint32_t primitive, float* depth, std::uint32_t* id,
                                  Int<D>& drawn) {
    if constexpr (kShows == Shows::usual)
        return show(inside, z, primitive, depth, id, drawn);
    else if constexpr (kShows == Shows::depth)
        return show_depth(inside, z, depth, drawn);
    else
        return show_by(rule, inside, z, primitive, depth, id, drawn);
}

SIMD_END

#endif
