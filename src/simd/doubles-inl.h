// Lanes of doubles (simd/lanes-inl.h): as many as a Float<D> has. Included once for every target.
#if defined(SCANOUT_SIMD_DOUBLES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SIMD_DOUBLES_INL_H
#undef SCANOUT_SIMD_DOUBLES_INL_H
#else
#define SCANOUT_SIMD_DOUBLES_INL_H
#endif

#include <cstddef>
#include <cstdint>

#include "simd/inline-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scanout::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// minps and the like return the second operand where either is NaN and where both are zero; other
// machines differ.
constexpr bool kMinimumIsFirstIfLess =
    HWY_ARCH_X86 && HWY_TARGET != HWY_EMU128 && HWY_TARGET != HWY_SCALAR;

// Stored in two registers, each half of the lanes.
template <class D>
struct Double {
    using Tag = hn::Repartition<double, D>;
    using HalfTag = Tag;
    using Raw = hn::Vec<Tag>;
    Raw low, high;

    static constexpr std::size_t kLanes = hn::MaxLanes(D());

    struct DoubleMask {
        hn::Mask<Tag> low, high;
        friend SIMD_INLINE DoubleMask operator&(DoubleMask a, DoubleMask b) {
            return {hn::And(a.low, b.low), hn::And(a.high, b.high)};
        }
        friend SIMD_INLINE DoubleMask operator|(DoubleMask a, DoubleMask b) {
            return {hn::Or(a.low, b.low), hn::Or(a.high, b.high)};
        }
        friend SIMD_INLINE DoubleMask operator!(DoubleMask a) {
            return {hn::Not(a.low), hn::Not(a.high)};
        }
        friend SIMD_INLINE bool all(DoubleMask a) {
            return hn::AllTrue(Tag(), a.low) && hn::AllTrue(Tag(), a.high);
        }
        friend SIMD_INLINE std::uint32_t bits(DoubleMask a) {
            std::uint8_t bits_low[8] = {}, bits_high[8] = {};
            hn::StoreMaskBits(Tag(), a.low, bits_low);
            hn::StoreMaskBits(Tag(), a.high, bits_high);
            return bits_low[0] | static_cast<std::uint32_t>(bits_high[0]) << (kLanes / 2);
        }
    };

    Double() = default;
    SIMD_INLINE Double(double value) : low(hn::Set(Tag(), value)), high(low) {}
    SIMD_INLINE Double(Raw l, Raw h) : low(l), high(h) {}

    static SIMD_INLINE Double of_halves(Raw l, Raw h) { return {l, h}; }
    static SIMD_INLINE Double loaded(const double* from) {
        return {hn::LoadU(Tag(), from), hn::LoadU(Tag(), from + kLanes / 2)};
    }
    SIMD_INLINE void store_to(double* to) const {
        hn::StoreU(low, Tag(), to);
        hn::StoreU(high, Tag(), to + kLanes / 2);
    }
    template <class Index, class Raw32>
    static SIMD_INLINE Double gathered(const double* base, Index, Raw32 index) {
        const hn::RebindToSigned<Tag> wide;
        const hn::Half<Index> half;
        return {hn::GatherIndex(Tag(), base, hn::PromoteTo(wide, hn::LowerHalf(half, index))),
                hn::GatherIndex(Tag(), base, hn::PromoteTo(wide, hn::UpperHalf(half, index)))};
    }
    // Conversions from and to lanes of 32 bits.
    template <class From, class Raw32>
    static SIMD_INLINE Double promoted(From, Raw32 from) {
        const hn::Half<From> half;
        return {hn::PromoteTo(Tag(), hn::LowerHalf(half, from)),
                hn::PromoteTo(Tag(), hn::UpperHalf(half, from))};
    }
    template <class To>
    SIMD_INLINE hn::Vec<To> demoted(To tag) const {
        const hn::Half<To> half;
        return hn::Combine(tag, hn::DemoteTo(half, high), hn::DemoteTo(half, low));
    }

    friend SIMD_INLINE Double operator+(Double a, Double b) {
        return {hn::Add(a.low, b.low), hn::Add(a.high, b.high)};
    }
    friend SIMD_INLINE Double operator-(Double a, Double b) {
        return {hn::Sub(a.low, b.low), hn::Sub(a.high, b.high)};
    }
    friend SIMD_INLINE Double operator*(Double a, Double b) {
        return {hn::Mul(a.low, b.low), hn::Mul(a.high, b.high)};
    }
    friend SIMD_INLINE Double operator/(Double a, Double b) {
        return {hn::Div(a.low, b.low), hn::Div(a.high, b.high)};
    }
    friend SIMD_INLINE Double operator-(Double a) { return {hn::Neg(a.low), hn::Neg(a.high)}; }
    // False where either side is NaN.
    friend SIMD_INLINE DoubleMask operator<(Double a, Double b) {
        return {hn::Lt(a.low, b.low), hn::Lt(a.high, b.high)};
    }
    friend SIMD_INLINE DoubleMask operator>(Double a, Double b) { return b < a; }
    friend SIMD_INLINE DoubleMask operator<=(Double a, Double b) {
        return {hn::Le(a.low, b.low), hn::Le(a.high, b.high)};
    }
    friend SIMD_INLINE DoubleMask operator>=(Double a, Double b) { return b <= a; }
    friend SIMD_INLINE DoubleMask operator==(Double a, Double b) {
        return {hn::Eq(a.low, b.low), hn::Eq(a.high, b.high)};
    }

    friend SIMD_INLINE Double select(DoubleMask m, Double yes, Double no) {
        return {hn::IfThenElse(m.low, yes.low, no.low), hn::IfThenElse(m.high, yes.high, no.high)};
    }
    // b where either is NaN.
    friend SIMD_INLINE Double minimum(Double a, Double b) {
        if constexpr (kMinimumIsFirstIfLess)
            return {hn::Min(a.low, b.low), hn::Min(a.high, b.high)};
        return select(a < b, a, b);
    }
    friend SIMD_INLINE Double maximum(Double a, Double b) {
        if constexpr (kMinimumIsFirstIfLess)
            return {hn::Max(a.low, b.low), hn::Max(a.high, b.high)};
        return select(a > b, a, b);
    }
    friend SIMD_INLINE Double sqrt(Double a) { return {hn::Sqrt(a.low), hn::Sqrt(a.high)}; }
    friend SIMD_INLINE Double abs(Double a) { return {hn::Abs(a.low), hn::Abs(a.high)}; }
};

// Stored in one register, of twice the width of a Float<D>'s, where the machine has one.
template <class D>
requires(hn::MaxLanes(hn::ScalableTag<double>()) >= hn::MaxLanes(D())) struct Double<D> {
    using Tag = hn::Rebind<double, D>;
    using HalfTag = hn::Half<Tag>;
    using Raw = hn::Vec<Tag>;
    Raw raw;

    static constexpr std::size_t kLanes = hn::MaxLanes(D());

    struct DoubleMask {
        hn::Mask<Tag> raw;
        friend SIMD_INLINE DoubleMask operator&(DoubleMask a, DoubleMask b) {
            return {hn::And(a.raw, b.raw)};
        }
        friend SIMD_INLINE DoubleMask operator|(DoubleMask a, DoubleMask b) {
            return {hn::Or(a.raw, b.raw)};
        }
        friend SIMD_INLINE DoubleMask operator!(DoubleMask a) { return {hn::Not(a.raw)}; }
        friend SIMD_INLINE bool all(DoubleMask a) { return hn::AllTrue(Tag(), a.raw); }
        friend SIMD_INLINE std::uint32_t bits(DoubleMask a) {
            std::uint8_t byte[8] = {};
            hn::StoreMaskBits(Tag(), a.raw, byte);
            return byte[0];
        }
    };

    Double() = default;
    SIMD_INLINE Double(double value) : raw(hn::Set(Tag(), value)) {}
    SIMD_INLINE explicit Double(Raw value) : raw(value) {}

    static SIMD_INLINE Double of_halves(hn::Vec<HalfTag> low, hn::Vec<HalfTag> high) {
        return Double(hn::Combine(Tag(), high, low));
    }
    static SIMD_INLINE Double loaded(const double* from) { return Double(hn::LoadU(Tag(), from)); }
    SIMD_INLINE void store_to(double* to) const { hn::StoreU(raw, Tag(), to); }
    template <class Index, class Raw32>
    static SIMD_INLINE Double gathered(const double* base, Index, Raw32 index) {
        const hn::RebindToSigned<Tag> wide;
        return Double(hn::GatherIndex(Tag(), base, hn::PromoteTo(wide, index)));
    }
    template <class From, class Raw32>
    static SIMD_INLINE Double promoted(From, Raw32 from) {
        return Double(hn::PromoteTo(Tag(), from));
    }
    template <class To>
    SIMD_INLINE hn::Vec<To> demoted(To tag) const {
        return hn::DemoteTo(tag, raw);
    }

    friend SIMD_INLINE Double operator+(Double a, Double b) {
        return Double(hn::Add(a.raw, b.raw));
    }
    friend SIMD_INLINE Double operator-(Double a, Double b) {
        return Double(hn::Sub(a.raw, b.raw));
    }
    friend SIMD_INLINE Double operator*(Double a, Double b) {
        return Double(hn::Mul(a.raw, b.raw));
    }
    friend SIMD_INLINE Double operator/(Double a, Double b) {
        return Double(hn::Div(a.raw, b.raw));
    }
    friend SIMD_INLINE Double operator-(Double a) { return Double(hn::Neg(a.raw)); }
    // False where either side is NaN.
    friend SIMD_INLINE DoubleMask operator<(Double a, Double b) { return {hn::Lt(a.raw, b.raw)}; }
    friend SIMD_INLINE DoubleMask operator>(Double a, Double b) { return b < a; }
    friend SIMD_INLINE DoubleMask operator<=(Double a, Double b) { return {hn::Le(a.raw, b.raw)}; }
    friend SIMD_INLINE DoubleMask operator>=(Double a, Double b) { return b <= a; }
    friend SIMD_INLINE DoubleMask operator==(Double a, Double b) { return {hn::Eq(a.raw, b.raw)}; }

    friend SIMD_INLINE Double select(DoubleMask m, Double yes, Double no) {
        return Double(hn::IfThenElse(m.raw, yes.raw, no.raw));
    }
    // b where either is NaN.
    friend SIMD_INLINE Double minimum(Double a, Double b) {
        if constexpr (kMinimumIsFirstIfLess) return Double(hn::Min(a.raw, b.raw));
        return select(a < b, a, b);
    }
    friend SIMD_INLINE Double maximum(Double a, Double b) {
        if constexpr (kMinimumIsFirstIfLess) return Double(hn::Max(a.raw, b.raw));
        return select(a > b, a, b);
    }
    friend SIMD_INLINE Double sqrt(Double a) { return Double(hn::Sqrt(a.raw)); }
    friend SIMD_INLINE Double abs(Double a) { return Double(hn::Abs(a.raw)); }
};

} // namespace scanout::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
