// Lanes: values that a kernel computes side by side, written like plain formulas. A thin layer on
// Google Highway; included once for every target, so it has no guard of the usual kind.
//
// F32, I32 and F64 hold kLanes values each (an F64 is two registers), so a kernel mixes them freely
// and does not depend on the machine's width; F32x8, I32x8 and F64x8 hold at most 8, for data in
// eights (an F64x8 is one register where the machine has such). The rules that make all targets
// give the same bits (HARD-CASES D1, D2, D4, D5): + - * / sqrt are exact IEEE operations and never
// fused, conversions are of values in range, minimum and maximum are comparisons with a chosen
// outcome for NaN, and the only operations across lanes are any, all, bits and least, for which the
// order does not matter.
#if defined(SCANOUT_SIMD_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SIMD_LANES_INL_H
#undef SCANOUT_SIMD_LANES_INL_H
#else
#define SCANOUT_SIMD_LANES_INL_H
#endif

#include <bit>
#include <cstddef>
#include <cstdint>

#include <hwy/cache_control.h>

#include "simd/doubles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scanout::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// D: Highway's tag of float lanes. All types of a width share it.
template <class D>
struct Float;
template <class D>
struct Int;

// A mask of the lanes of a Float or an Int.
template <class D>
struct Mask {
    hn::Mask<D> raw;
    friend SIMD_INLINE Mask operator&(Mask a, Mask b) { return {hn::And(a.raw, b.raw)}; }
    friend SIMD_INLINE Mask operator|(Mask a, Mask b) { return {hn::Or(a.raw, b.raw)}; }
    friend SIMD_INLINE Mask operator^(Mask a, Mask b) { return {hn::Xor(a.raw, b.raw)}; }
    friend SIMD_INLINE Mask operator!(Mask a) { return {hn::Not(a.raw)}; }
};
template <class D>
SIMD_INLINE bool any(Mask<D> m) {
    return !hn::AllFalse(D(), m.raw);
}
template <class D>
SIMD_INLINE bool all(Mask<D> m) {
    return hn::AllTrue(D(), m.raw);
}
// Bit i is lane i.
template <class D>
SIMD_INLINE std::uint32_t bits(Mask<D> m) {
    static_assert(std::endian::native == std::endian::little);
    std::uint32_t word = 0; // at least eight bits are written
    hn::StoreMaskBits(D(), m.raw, reinterpret_cast<std::uint8_t*>(&word));
    return word;
}

// --- float

template <class D>
struct Float {
    using Tag = D;
    using Raw = hn::Vec<Tag>;
    Raw raw;

    static constexpr std::size_t kLanes = hn::MaxLanes(D());

    Float() = default;
    SIMD_INLINE Float(float value) : raw(hn::Set(D(), value)) {} // the same in all lanes
    SIMD_INLINE explicit Float(Raw value) : raw(value) {}

    friend SIMD_INLINE Float operator+(Float a, Float b) { return Float(hn::Add(a.raw, b.raw)); }
    friend SIMD_INLINE Float operator-(Float a, Float b) { return Float(hn::Sub(a.raw, b.raw)); }
    friend SIMD_INLINE Float operator*(Float a, Float b) { return Float(hn::Mul(a.raw, b.raw)); }
    friend SIMD_INLINE Float operator/(Float a, Float b) { return Float(hn::Div(a.raw, b.raw)); }
    friend SIMD_INLINE Float operator-(Float a) { return Float(hn::Neg(a.raw)); }
    // False where either side is NaN.
    friend SIMD_INLINE Mask<D> operator<(Float a, Float b) { return {hn::Lt(a.raw, b.raw)}; }
    friend SIMD_INLINE Mask<D> operator>(Float a, Float b) { return {hn::Lt(b.raw, a.raw)}; }
    friend SIMD_INLINE Mask<D> operator<=(Float a, Float b) { return {hn::Le(a.raw, b.raw)}; }
    friend SIMD_INLINE Mask<D> operator>=(Float a, Float b) { return {hn::Le(b.raw, a.raw)}; }
    friend SIMD_INLINE Mask<D> operator==(Float a, Float b) { return {hn::Eq(a.raw, b.raw)}; }

    friend SIMD_INLINE Float select(Mask<D> mask, Float yes, Float no) {
        return Float(hn::IfThenElse(mask.raw, yes.raw, no.raw));
    }
    // b where either is NaN.
    friend SIMD_INLINE Float minimum(Float a, Float b) {
        if constexpr (kMinimumIsFirstIfLess) return Float(hn::Min(a.raw, b.raw));
        return select(a < b, a, b);
    }
    friend SIMD_INLINE Float maximum(Float a, Float b) {
        if constexpr (kMinimumIsFirstIfLess) return Float(hn::Max(a.raw, b.raw));
        return select(a > b, a, b);
    }
    friend SIMD_INLINE Float sqrt(Float a) { return Float(hn::Sqrt(a.raw)); }
    friend SIMD_INLINE Float abs(Float a) { return Float(hn::Abs(a.raw)); }
};
// The least of all lanes, none of which is NaN or -0.
template <class D>
SIMD_INLINE float least(Float<D> a) {
    return hn::GetLane(hn::MinOfLanes(D(), a.raw));
}

// --- 32-bit integers, which wrap around

template <class D>
struct Int {
    using Tag = hn::RebindToSigned<D>;
    using Raw = hn::Vec<Tag>;
    Raw raw;

    static constexpr std::size_t kLanes = hn::MaxLanes(D());

    Int() = default;
    SIMD_INLINE Int(std::int32_t value) : raw(hn::Set(Tag(), value)) {}
    SIMD_INLINE explicit Int(Raw value) : raw(value) {}

    friend SIMD_INLINE Int operator+(Int a, Int b) { return Int(hn::Add(a.raw, b.raw)); }
    friend SIMD_INLINE Int operator-(Int a, Int b) { return Int(hn::Sub(a.raw, b.raw)); }
    friend SIMD_INLINE Int operator*(Int a, Int b) { return Int(hn::Mul(a.raw, b.raw)); }
    friend SIMD_INLINE Int operator&(Int a, Int b) { return Int(hn::And(a.raw, b.raw)); }
    friend SIMD_INLINE Int operator|(Int a, Int b) { return Int(hn::Or(a.raw, b.raw)); }
    friend SIMD_INLINE Mask<D> operator<(Int a, Int b) { return mask(hn::Lt(a.raw, b.raw)); }
    friend SIMD_INLINE Mask<D> operator>(Int a, Int b) { return mask(hn::Lt(b.raw, a.raw)); }
    friend SIMD_INLINE Mask<D> operator<=(Int a, Int b) { return !(a > b); }
    friend SIMD_INLINE Mask<D> operator>=(Int a, Int b) { return !(a < b); }
    friend SIMD_INLINE Mask<D> operator==(Int a, Int b) { return mask(hn::Eq(a.raw, b.raw)); }

    friend SIMD_INLINE Int select(Mask<D> m, Int yes, Int no) {
        return Int(hn::IfThenElse(hn::RebindMask(Tag(), m.raw), yes.raw, no.raw));
    }
    friend SIMD_INLINE Int minimum(Int a, Int b) { return Int(hn::Min(a.raw, b.raw)); }
    friend SIMD_INLINE Int maximum(Int a, Int b) { return Int(hn::Max(a.raw, b.raw)); }

private:
    static SIMD_INLINE Mask<D> mask(hn::Mask<Tag> m) { return {hn::RebindMask(D(), m)}; }
};
// Treats lanes as unsigned numbers, 0 to 2^32 - 1.
template <class D>
SIMD_INLINE Mask<D> less_unsigned(Int<D> a, Int<D> b) {
    const hn::RebindToUnsigned<typename Int<D>::Tag> tag;
    return {hn::RebindMask(D(), hn::Lt(hn::BitCast(tag, a.raw), hn::BitCast(tag, b.raw)))};
}
template <class D>
SIMD_INLINE Int<D> less_one_where(Mask<D> m, Int<D> a) {
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86 // masks are no lanes
    return select(m, a - Int<D>(1), a);
#else
    const typename Int<D>::Tag tag;
    return a + Int<D>(hn::VecFromMask(tag, hn::RebindMask(tag, m.raw)));
#endif
}
template <int kCount, class D>
SIMD_INLINE Int<D> shift_left(Int<D> a) {
    return Int<D>(hn::ShiftLeft<kCount>(a.raw));
}
template <int kCount, class D>
SIMD_INLINE Int<D> shift_right(Int<D> a) { // arithmetic: towards -infinity
    return Int<D>(hn::ShiftRight<kCount>(a.raw));
}

// --- conversions

// The types of half as many lanes: for decltype alone, there are no such functions.
template <class D>
Float<hn::Half<D>> half_of(Float<D>);
template <class D>
Int<hn::Half<D>> half_of(Int<D>);

// Round to nearest, ties to even.
template <class D>
SIMD_INLINE Float<D> to_f32(Int<D> a) {
    return Float<D>(hn::ConvertTo(D(), a.raw));
}
template <class D>
SIMD_INLINE Float<D> to_f32(Double<D> a) {
    const D tag;
#if HWY_TARGET == HWY_EMU128 // saturates where every CPU gives infinity
    const auto past = abs(a) >= Double<D>(0x1.ffffffp127);
    return Float<D>(a.demoted(tag)) *
           Float<D>(select(past, Double<D>(2.0), Double<D>(1.0)).demoted(tag));
#else
    return Float<D>(a.demoted(tag));
#endif
}
// Towards zero; the value must be a number within +-(2^31 - 1).
template <class D>
SIMD_INLINE Int<D> to_i32(Float<D> a) {
    return Int<D>(hn::ConvertTo(typename Int<D>::Tag(), a.raw));
}
template <class D>
SIMD_INLINE Int<D> to_i32(Double<D> a) {
    return Int<D>(a.demoted(typename Int<D>::Tag()));
}
// The same lanes.
template <class D>
SIMD_INLINE typename Double<D>::DoubleMask to_f64(Mask<D> m) {
    using Of = typename Double<D>::DoubleMask;
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
    if constexpr (hn::MaxLanes(typename Double<D>::Tag()) == hn::MaxLanes(D()))
        return Of{{m.raw.raw}};
    else
        return Of{{static_cast<__mmask8>(m.raw.raw)}, {static_cast<__mmask8>(m.raw.raw >> 8)}};
#else
    const hn::RebindToSigned<D> narrow;
    const hn::RebindToSigned<typename Double<D>::Tag> wide;
    const auto half = [&](auto lanes) SIMD_LAMBDA {
        const auto promoted = hn::PromoteTo(wide, lanes);
        return hn::RebindMask(typename Double<D>::Tag(), hn::MaskFromVec(promoted));
    };
    const auto lanes = hn::VecFromMask(narrow, hn::RebindMask(narrow, m.raw));
    const hn::Half<decltype(narrow)> of_half;
    return Of{half(hn::LowerHalf(of_half, lanes)), half(hn::UpperHalf(of_half, lanes))};
#endif
}
// Exact.
template <class D>
SIMD_INLINE Double<D> to_f64(Float<D> a) {
    return Double<D>::promoted(D(), a.raw);
}
template <class D>
SIMD_INLINE Double<D> to_f64(Int<D> a) {
    return Double<D>::promoted(typename Int<D>::Tag(), a.raw);
}
template <class D>
SIMD_INLINE Int<D> bits_of(Float<D> a) {
    return Int<D>(hn::BitCast(typename Int<D>::Tag(), a.raw));
}
template <class D>
SIMD_INLINE Float<D> from_bits(Int<D> a) {
    return Float<D>(hn::BitCast(D(), a.raw));
}

// --- memory. T is one of the lane types below.

template <class T>
SIMD_INLINE T load(const float* from) {
    return T(hn::LoadU(typename T::Tag(), from));
}
template <class T>
SIMD_INLINE T load(const std::int32_t* from) {
    return T(hn::LoadU(typename T::Tag(), from));
}
template <class T>
SIMD_INLINE T load(const std::uint32_t* from) { // bits as they are
    return T(
        hn::BitCast(typename T::Tag(), hn::LoadU(hn::RebindToUnsigned<typename T::Tag>(), from)));
}
template <class T>
SIMD_INLINE T load(const std::uint8_t* from) {
    const hn::Rebind<std::uint8_t, typename T::Tag> bytes;
    return T(hn::PromoteTo(typename T::Tag(), hn::LoadU(bytes, from)));
}
template <class T>
SIMD_INLINE T load(const double* from) {
    return T::loaded(from);
}
template <class D>
SIMD_INLINE void store(Float<D> a, float* to) {
    hn::StoreU(a.raw, D(), to);
}
template <class D>
SIMD_INLINE void store(Int<D> a, std::int32_t* to) {
    hn::StoreU(a.raw, typename Int<D>::Tag(), to);
}
template <class D>
SIMD_INLINE void store(Int<D> a, std::uint32_t* to) {
    const hn::RebindToUnsigned<typename Int<D>::Tag> tag;
    hn::StoreU(hn::BitCast(tag, a.raw), tag, to);
}
template <class D>
SIMD_INLINE void store(Double<D> a, double* to) {
    a.store_to(to);
}
// The first `count` lanes, or all.
template <class D>
SIMD_INLINE void store_first(Int<D> a, int count, std::int32_t* to) {
    const typename Int<D>::Tag tag;
    hn::BlendedStore(a.raw, hn::FirstN(tag, static_cast<std::size_t>(count)), tag, to);
}
// A streaming store, past the caches, to an address that the register's size divides. Other threads
// may read it after finish_streams(), or after any locked instruction of this thread.
template <class D>
SIMD_INLINE void stream(Float<D> a, float* to) {
    hn::Stream(a.raw, D(), to);
}
SIMD_INLINE void finish_streams() {
    hwy::FlushStream();
}
// The lower lanes from one place, the upper ones from another.
template <class T, class Word>
SIMD_INLINE T load_halves(const Word* low, const Word* high) {
    using Half = decltype(half_of(T()));
    return T(hn::Combine(typename T::Tag(), load<Half>(high).raw, load<Half>(low).raw));
}
template <class T, class Word>
SIMD_INLINE void store_halves(T a, Word* low, Word* high) {
    using Half = decltype(half_of(T()));
    const typename Half::Tag tag;
    store(Half(hn::LowerHalf(tag, a.raw)), low);
    store(Half(hn::UpperHalf(tag, a.raw)), high);
}
// base[index] in every lane; index >= 0.
template <class D>
SIMD_INLINE Float<D> gather(const float* base, Int<D> index) {
    return Float<D>(hn::GatherIndex(D(), base, index.raw));
}
template <class D>
SIMD_INLINE Int<D> gather(const std::int32_t* base, Int<D> index) {
    return Int<D>(hn::GatherIndex(typename Int<D>::Tag(), base, index.raw));
}
template <class D>
SIMD_INLINE Double<D> gather(const double* base, Int<D> index) {
    return Double<D>::gathered(base, typename Int<D>::Tag(), index.raw);
}
// from[0], from[3], ... into x, from[1], from[4], ... into y, and so on.
template <class D>
SIMD_INLINE void load_interleaved(const float* from, Float<D>& x, Float<D>& y, Float<D>& z) {
    hn::LoadInterleaved3(D(), from, x.raw, y.raw, z.raw);
}
template <class D>
SIMD_INLINE void load_interleaved(const std::uint32_t* from, Int<D>& x, Int<D>& y, Int<D>& z) {
    const typename Int<D>::Tag tag;
    const hn::RebindToUnsigned<decltype(tag)> u;
    hn::Vec<decltype(u)> a, b, c;
    hn::LoadInterleaved3(u, from, a, b, c);
    x = Int<D>(hn::BitCast(tag, a));
    y = Int<D>(hn::BitCast(tag, b));
    z = Int<D>(hn::BitCast(tag, c));
}
template <class D>
SIMD_INLINE void load_interleaved(const std::uint32_t* from, Int<D>& x, Int<D>& y) {
    const typename Int<D>::Tag tag;
    const hn::RebindToUnsigned<decltype(tag)> u;
    hn::Vec<decltype(u)> a, b;
    hn::LoadInterleaved2(u, from, a, b);
    x = Int<D>(hn::BitCast(tag, a));
    y = Int<D>(hn::BitCast(tag, b));
}
// Is there an instruction that packs lanes? Without it, storing them one by one is faster.
constexpr bool kPacksLanes = HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3;
// Stores x, y and z of the lanes whose bit is set, in order; the memory behind them, up to a
// register's worth, is undefined. Returns the number of those lanes.
template <class D>
SIMD_INLINE int store_packed(std::uint32_t lanes, Int<D> x, Int<D> y, Int<D> z, std::uint32_t* to) {
    const typename Int<D>::Tag tag;
    const hn::RebindToUnsigned<decltype(tag)> u;
    const std::uint8_t bits[8] = {static_cast<std::uint8_t>(lanes),
                                  static_cast<std::uint8_t>(lanes >> 8)};
    const auto mask = hn::LoadMaskBits(u, bits);
    const auto packed = [&](Int<D> a)
                            SIMD_LAMBDA { return hn::Compress(hn::BitCast(u, a.raw), mask); };
    hn::StoreInterleaved3(packed(x), packed(y), packed(z), u, to);
    return __builtin_popcount(lanes);
}
// The same for x alone, with a mask.
template <class D>
SIMD_INLINE std::uint32_t store_packed(Mask<D> lanes, Int<D> x, std::int32_t* to) {
    const typename Int<D>::Tag tag;
    const auto mask = hn::RebindMask(tag, lanes.raw);
    hn::StoreU(hn::Compress(x.raw, mask), tag, to);
    return static_cast<std::uint32_t>(hn::CountTrue(tag, mask));
}
// Stores x, y and z of every lane, in order: 16 bytes each, words in the machine's byte order.
template <class D>
SIMD_INLINE void store_interleaved(Int<D> x, Int<D> y, Double<D> z, void* to) {
    static_assert(std::endian::native == std::endian::little);
    static_assert(2 * hn::MaxLanes(typename Double<D>::Tag()) == Int<D>::kLanes); // two registers
    const hn::RebindToUnsigned<typename Double<D>::Tag> wide;
    const hn::RebindToUnsigned<typename Int<D>::Tag> words;
    const hn::Half<decltype(words)> half;
    const auto store_half = [&](auto of_half, auto doubles, std::uint64_t* at) SIMD_LAMBDA {
        const auto promoted = [&](Int<D> word) SIMD_LAMBDA {
            return hn::PromoteTo(wide, of_half(hn::BitCast(words, word.raw)));
        };
        const auto pairs = hn::Or(promoted(x), hn::ShiftLeft<32>(promoted(y)));
        hn::StoreInterleaved2(pairs, hn::BitCast(wide, doubles), wide, at);
    };
    const auto store_both = [&](std::uint64_t* at) SIMD_LAMBDA {
        store_half([&](auto all) SIMD_LAMBDA { return hn::LowerHalf(half, all); }, z.low, at);
        store_half([&](auto all) SIMD_LAMBDA { return hn::UpperHalf(half, all); }, z.high,
                   at + Int<D>::kLanes);
    };
#if HWY_TARGET == HWY_EMU128 // stores 64-bit words: `to` may hold other types (aliasing)
    std::uint64_t all[2 * Int<D>::kLanes];
    store_both(all);
    __builtin_memcpy(to, all, sizeof all);
#else
    store_both(static_cast<std::uint64_t*>(to));
#endif
}
// Prefetches kBytes that lie `ahead` of an address; the address may lie beyond the readable memory.
template <std::size_t kBytes>
SIMD_INLINE void prefetch(const void* from, std::size_t ahead) {
    constexpr std::size_t kLine = 64;
    const auto address = reinterpret_cast<std::uintptr_t>(from) + ahead;
    for (std::size_t line = 0; line < kBytes; line += kLine)
        __builtin_prefetch(reinterpret_cast<const void*>(address + line));
}
// first, first + 1, first + 2, ...
template <class T>
SIMD_INLINE T iota(std::int32_t first) {
    return T(hn::Iota(typename T::Tag(), first));
}

// --- the widths

using F32 = Float<hn::ScalableTag<float>>;
using I32 = Int<hn::ScalableTag<float>>;
using F64 = Double<hn::ScalableTag<float>>;
inline constexpr int kLanes = static_cast<int>(F32::kLanes);

using F32x8 = Float<hn::CappedTag<float, 8>>;
using I32x8 = Int<hn::CappedTag<float, 8>>;
using F64x8 = Double<hn::CappedTag<float, 8>>;
inline constexpr int kLanesX8 = static_cast<int>(F32x8::kLanes);

} // namespace scanout::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
