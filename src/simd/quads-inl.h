// Lanes from four words in memory each: loaded a lane at a time and transposed, which takes less
// time for all four than a hardware gather for each word. Included once for every SIMD target.
#if defined(SCANOUT_SIMD_QUADS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SIMD_QUADS_INL_H
#undef SCANOUT_SIMD_QUADS_INL_H
#else
#define SCANOUT_SIMD_QUADS_INL_H
#endif

#include <type_traits>

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scanout::simd::HWY_NAMESPACE {

// Of lane i words 0 to 3 are a quad of 128 bits: row[i % 4], quad i / 4 of that register.
template <class D>
struct Quads128 {
    using Tag = typename Int<D>::Tag;
    hn::Vec<Tag> row[4];

    SIMD_INLINE Int<D> word(int number) const {
        const Tag tag;
        const auto pair = [&](int i) SIMD_LAMBDA {
            return number < 2 ? hn::InterleaveLower(tag, row[i], row[i + 2])
                              : hn::InterleaveUpper(tag, row[i], row[i + 2]);
        };
        return Int<D>(number % 2 == 0 ? hn::InterleaveLower(tag, pair(0), pair(1))
                                      : hn::InterleaveUpper(tag, pair(0), pair(1)));
    }
    // Words 2 and 3.
    SIMD_INLINE Double<D> last_double() const {
        const typename Double<D>::HalfTag tag;
        const auto pair = [&](int i) SIMD_LAMBDA {
            return hn::InterleaveUpper(tag, hn::BitCast(tag, row[i]), hn::BitCast(tag, row[i + 1]));
        };
        static_assert(Int<D>::kLanes <= 8);
        if constexpr (Int<D>::kLanes == 4)
            return Double<D>::of_halves(pair(0), pair(2));
        else
            return Double<D>::of_halves(hn::ConcatLowerLower(tag, pair(2), pair(0)),
                                        hn::ConcatUpperUpper(tag, pair(2), pair(0)));
    }
};

// Word kNumber of each quad of 128 bits, in all of the quad.
template <int kNumber, class D>
SIMD_INLINE Float<D> broadcast_in_quad(Float<D> a) {
    return Float<D>(hn::Broadcast<kNumber>(a.raw));
}

// row(number): a std::integral_constant of 0 to 3; floats of the lanes number, number + 4, ...
template <class D, class Row>
SIMD_INLINE Quads128<D> quads_of_rows(const Row& row) {
    const auto words = [&](auto number) SIMD_LAMBDA { return bits_of(row(number)).raw; };
    return {{words(std::integral_constant<int, 0>()), words(std::integral_constant<int, 1>()),
             words(std::integral_constant<int, 2>()), words(std::integral_constant<int, 3>())}};
}

// Load(tag, lane): the four words of one lane.
template <class Tag, class Load>
SIMD_INLINE hn::Vec<Tag> load_row(Tag tag, int lane, const Load& load) {
    if constexpr (hn::MaxLanes(Tag()) == 4) {
        return load(tag, lane);
    } else {
        const hn::Half<Tag> half;
        return hn::Combine(tag, load_row(half, lane + static_cast<int>(hn::MaxLanes(half)), load),
                           load_row(half, lane, load));
    }
}

template <class D, class Load>
SIMD_INLINE Quads128<D> load_rows(const Load& load) {
    Quads128<D> quads;
    SIMD_FOR (int i = 0; i < 4; ++i)
        quads.row[i] = load_row(typename Int<D>::Tag(), i, load);
    return quads;
}

// at(lane): where its four words are.
template <class D, class At>
SIMD_INLINE Quads128<D> load_four(const At& at) {
    return load_rows<D>([&](auto tag, int lane) SIMD_LAMBDA { return hn::LoadU(tag, at(lane)); });
}
// Where two are.
template <class D, class At>
SIMD_INLINE Quads128<D> load_two(const At& at) {
    return load_rows<D>([&](auto tag, int lane) SIMD_LAMBDA {
        const hn::Half<decltype(tag)> half;
        return hn::ZeroExtendVector(tag, hn::LoadU(half, at(lane)));
    });
}
// Where three are: they become words 0, 1 and kThird.
#if HWY_TARGET <= HWY_AVX2 && HWY_ARCH_X86 // loads three and leaves the fourth alone
inline constexpr int kThird = 2;
template <class D, class At>
SIMD_INLINE Quads128<D> load_three(const At& at) {
    return load_rows<D>([&](auto tag, int lane) SIMD_LAMBDA {
        return hn::MaskedLoad(hn::FirstN(tag, 3), tag, at(lane));
    });
}
#else
inline constexpr int kThird = 3;
template <class D, class At>
SIMD_INLINE Quads128<D> load_three(const At& at) {
    return load_rows<D>([&](auto tag, int lane) SIMD_LAMBDA {
        const hn::Half<decltype(tag)> half;
        const std::int32_t* from = at(lane);
        return hn::Combine(tag, hn::LoadU(half, from + 1), hn::LoadU(half, from));
    });
}
#endif

} // namespace scanout::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
