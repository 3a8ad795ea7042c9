// Table look-ups for lanes whose indices rise from lane to lane by one at most. A register then
// reads no more adjacent entries than it has lanes: one load and one permutation fetch them, where
// a gather loads each by itself. Included once for every SIMD target.
#if defined(SCANOUT_SIMD_ENTRIES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SIMD_ENTRIES_INL_H
#undef SCANOUT_SIMD_ENTRIES_INL_H
#else
#define SCANOUT_SIMD_ENTRIES_INL_H
#endif

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scanout::simd::HWY_NAMESPACE {

// Tables must be readable up to a register beyond the last entry used.
template <class D>
class Entries {
public:
    // number: of the register's lanes, of which the first `live` count; the others get the first
    // one's entry.
    SIMD_INLINE Entries(const std::int32_t* number, int live)
        : first_(number[0]), index_(hn::IndicesFromVec(D(), from_first(number, live).raw)) {}

    SIMD_INLINE Float<D> of(const float* table) const {
        return Float<D>(hn::TableLookupLanes(hn::LoadU(D(), table + first_), index_));
    }
    SIMD_INLINE Int<D> of(const std::int32_t* table) const {
        return bits_of(
            Float<D>(hn::TableLookupLanes(from_bits(load<Int<D>>(table + first_)).raw, index_)));
    }

private:
    static SIMD_INLINE Int<D> from_first(const std::int32_t* number, int live) {
        const Int<D> apart = load<Int<D>>(number) - Int<D>(number[0]);
        return select(iota<Int<D>>(0) < Int<D>(live), apart, Int<D>(0));
    }
    using Index = decltype(hn::IndicesFromVec(D(), hn::Zero(typename Int<D>::Tag())));
    std::int32_t first_;
    Index index_;
};

// The same of tables of doubles.
template <class D>
class DoubleEntries {
public:
    SIMD_INLINE DoubleEntries(const std::int32_t* number, int live)
        : low_(number, live), high_(number + kHalf, live - kHalf) {}
    SIMD_INLINE Double<D> of(const double* table) const {
        return Double<D>(low_.of(table), high_.of(table));
    }

private:
    static constexpr int kHalf = static_cast<int>(Double<D>::kLanes) / 2;
    using Tag = typename Double<D>::Tag;
    struct Half {
        SIMD_INLINE Half(const std::int32_t* number, int live)
            : first(live > 0 ? number[0] : 0), index(indices(number, live)) {}
        SIMD_INLINE hn::Vec<Tag> of(const double* table) const {
            return hn::TableLookupLanes(hn::LoadU(Tag(), table + first), index);
        }
        static SIMD_INLINE auto indices(const std::int32_t* number, int live) {
            std::int64_t apart[kHalf];
            SIMD_FOR (int i = 0; i < kHalf; ++i)
                apart[i] = i < live ? number[i] - number[0] : 0;
            return hn::SetTableIndices(Tag(), apart);
        }
        std::int32_t first;
        decltype(hn::SetTableIndices(Tag(), static_cast<const std::int64_t*>(nullptr))) index;
    };
    Half low_, high_;
};
// In one register, where the machine has such.
template <class D>
requires(hn::MaxLanes(hn::ScalableTag<double>()) >= hn::MaxLanes(D())) class DoubleEntries<D> {
public:
    SIMD_INLINE DoubleEntries(const std::int32_t* number, int live)
        : first_(number[0]), index_(indices(number, live)) {}
    SIMD_INLINE Double<D> of(const double* table) const {
        return Double<D>(hn::TableLookupLanes(hn::LoadU(Tag(), table + first_), index_));
    }

private:
    using Tag = typename Double<D>::Tag;
    static SIMD_INLINE auto indices(const std::int32_t* number, int live) {
        const Int<D> apart = load<Int<D>>(number) - Int<D>(number[0]);
        const Int<D> index = select(iota<Int<D>>(0) < Int<D>(live), apart, Int<D>(0));
        const hn::RebindToSigned<Tag> wide;
        return hn::IndicesFromVec(Tag(), hn::PromoteTo(wide, index.raw));
    }
    std::int32_t first_;
    decltype(hn::IndicesFromVec(Tag(), hn::Zero(hn::RebindToSigned<Tag>()))) index_;
};

} // namespace scanout::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
