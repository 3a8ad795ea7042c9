// Depth test and write of the samples that a primitive covers. Included once for every SIMD target.
#if defined(SCANOUT_RASTER_COVERAGE_DEPTH_WRITE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_RASTER_COVERAGE_DEPTH_WRITE_INL_H
#undef SCANOUT_RASTER_COVERAGE_DEPTH_WRITE_INL_H
#else
#define SCANOUT_RASTER_COVERAGE_DEPTH_WRITE_INL_H
#endif

#include "raster/coverage/block_traversal.h"
#include "raster/coverage/depth_rule.h"

#include "simd/lanes-inl.h"

SIMD_BEGIN(scanout::raster)

using MaskX8 = Mask<F32x8::Tag>;

// What a kernel tests and writes: by the default rule depth and id, or depth alone where the tile
// has no ids; or both by another depth rule.
enum class DepthWrite { nearest, depth_only, by_rule };
constexpr bool is_default(DepthWrite write) {
    return write != DepthWrite::by_rule;
}
// The id of so many pixels further on; null where the tile has no ids.
template <DepthWrite kWrite>
SIMD_INLINE std::uint32_t* id_after(std::uint32_t* id, std::ptrdiff_t pixels) {
    return kWrite == DepthWrite::depth_only ? nullptr : id + pixels;
}

// Registers a row of a block, where they are narrow; rows a register, where they are wide.
constexpr int kRegisters = kLanes < PixelBlock::kSide ? PixelBlock::kSide / kLanes : 1;
constexpr int kRows = kLanes > PixelBlock::kSide ? kLanes / PixelBlock::kSide : 1;
// The columns and the rows, in a block, of the pixels of a register.
SIMD_INLINE I32 columns(int number) {
    return iota<I32>(number * kLanes) & I32(PixelBlock::kSide - 1);
}
SIMD_INLINE I32 rows() {
    return shift_right<3>(iota<I32>(0));
}

// Pixels of a tile from one on: of its row, and where a register holds sixteen, eight more of the
// row below.
template <class T, class Word>
SIMD_INLINE T load_pixels(const Word* from) {
    static_assert(T::kLanes <= 2 * PixelBlock::kSide);
    if constexpr (T::kLanes > PixelBlock::kSide)
        return load_halves<T>(from, from + kTileSize);
    else
        return load<T>(from);
}
template <class T, class Word>
SIMD_INLINE void store_pixels(T a, Word* to) {
    if constexpr (T::kLanes > PixelBlock::kSide)
        store_halves(a, to, to + kTileSize);
    else
        store(a, to);
}

// Default rule: the nearest stays, at a tie the lower id. Returns the depths that are stored now.
// No stored depth is below 0, and no new one is NaN or -0: so the bits are ordered as integers, and
// a tie that the lower id wins is won against a depth of one less.
template <class D>
SIMD_INLINE Float<D> write_nearest(Mask<D> inside, Float<D> z, std::uint32_t primitive,
                                   float* depth, std::uint32_t* id, Int<D>& drawn) {
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

// The same depths, without ids. `drawn` is set where a depth became nearer.
template <class D>
SIMD_INLINE Float<D> write_depth_only(Mask<D> inside, Float<D> z, float* depth, Int<D>& drawn) {
    const auto old = load_pixels<Float<D>>(depth);
    const Mask<D> pass = inside & (z > old);
    const Float<D> now = select(pass, z, old);
    store_pixels(now, depth);
    drawn = select(pass, Int<D>(-1), drawn);
    return now;
}

// DepthRule::stored.
template <class D>
SIMD_INLINE Float<D> stored_depth(Float<D> z, const DepthRule& rule) {
    if (!rule.standard) return z;
    using Wide = Double<D>;
    if (rule.reach > 0) {
        const Wide one = 1.0, more = rule.reach - 1.0, whole = 0x1.8p52;
        const Wide share = minimum(maximum((one / to_f64(z) - one) / more, Wide(0.0)), one);
        const Wide kept = ((share * Wide(rule.steps) + whole) - whole) / Wide(rule.steps);
        return to_f32(one / (one + kept * more));
    }
    const Wide standard_depth = Wide(1.0) - to_f64(z), whole = 0x1.8p52;
    const Wide stored =
        rule.steps > 0 ? ((standard_depth * Wide(rule.steps) + whole) - whole) / Wide(rule.steps)
                       : to_f64(to_f32(standard_depth));
    return to_f32(Wide(1.0) - stored);
}

// By another depth rule than the default one.
template <class D>
SIMD_INLINE Float<D> write_by_rule(const DepthRule& rule, Mask<D> inside, Float<D> depth_here,
                                   std::uint32_t primitive, float* depth, std::uint32_t* id,
                                   Int<D>& drawn) {
    using Id = Int<D>;
    const Float<D> z = stored_depth(depth_here, rule), old = load_pixels<Float<D>>(depth);
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
    case DepthTest::not_equal:
        pass = empty | !tie;
        break;
    case DepthTest::always:
        pass = empty | higher;
        break;
    case DepthTest::never:
        break;
    case DepthTest::greater:
        pass = empty | (z < old) | (tie & lower);
        break;
    case DepthTest::greater_equal:
        pass = empty | (z < old) | (tie & higher);
        break;
    case DepthTest::less_equal:
        pass = empty | (z > old) | (tie & higher);
        break;
    case DepthTest::less:
        pass = (z > old) | (tie & lower);
        break;
    }
    pass = pass & inside & (z >= Float<D>(rule.farthest)) & (z <= Float<D>(rule.nearest));
    const Float<D> now = select(pass, z, old);
    store_pixels(now, depth);
    store_pixels(select(pass, new_id, old_id), id);
    drawn = select(pass, Id(-1), drawn);
    return now;
}

template <DepthWrite kWrite, class D>
SIMD_INLINE Float<D> write_samples(const DepthRule& rule, Mask<D> inside, Float<D> z,
                                   std::uint32_t primitive, float* depth, std::uint32_t* id,
                                   Int<D>& drawn) {
    if constexpr (kWrite == DepthWrite::nearest)
        return write_nearest(inside, z, primitive, depth, id, drawn);
    else if constexpr (kWrite == DepthWrite::depth_only)
        return write_depth_only(inside, z, depth, drawn);
    else
        return write_by_rule(rule, inside, z, primitive, depth, id, drawn);
}

SIMD_END

#endif
