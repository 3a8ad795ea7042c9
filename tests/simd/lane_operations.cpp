#include "simd/lane_operations.h"

#define SIMD_FILE "simd/lane_operations.cpp"
#include "simd/for_each_target.h"

SIMD_BEGIN(scanout::test)

template <class F, class I, class D>
SIMD_INLINE void operations(const Operands& in, Results& out) {
    const F a = load<F>(in.a), b = load<F>(in.b), c = load<F>(in.c);
    const I i = load<I>(in.i), j = load<I>(in.j);
    const D p = load<D>(in.p), q = load<D>(in.q), r = load<D>(in.r);
    out.lanes = static_cast<int>(F::kLanes);
    int row = 0;
#define STORE_FLOAT(formula) store(formula, out.f[row++]);
    SCANOUT_FLOAT_OPERATIONS(STORE_FLOAT)
    row = 0;
#define STORE_INT(formula) store(formula, out.i[row++]);
    SCANOUT_INT_OPERATIONS(STORE_INT)
    row = 0;
#define STORE_DOUBLE(formula) store(formula, out.d[row++]);
    SCANOUT_DOUBLE_OPERATIONS(STORE_DOUBLE)
    row = 0;
#define STORE_MASK(formula)                                                                        \
    out.bits[row] = bits(formula);                                                                 \
    out.any[row] = any(formula);                                                                   \
    out.all[row] = all(formula);                                                                   \
    ++row;
    SCANOUT_MASK_OPERATIONS(STORE_MASK)
#undef STORE_FLOAT
#undef STORE_INT
#undef STORE_DOUBLE
#undef STORE_MASK
}

template <class F, class I>
SIMD_INLINE void memory(const float* numbers, const std::int32_t* index, MemoryResults& out) {
    F x, y, z;
    load_interleaved(numbers, x, y, z);
    store(x, out.x);
    store(y, out.y);
    store(z, out.z);
    const auto* bit_patterns = reinterpret_cast<const std::uint32_t*>(numbers);
    I ix, iy, iz;
    load_interleaved(bit_patterns, ix, iy, iz);
    store(ix, out.ix);
    store(iy, out.iy);
    store(iz, out.iz);
    out.packed_count =
        store_packed(kPacked & ((2U << (I::kLanes - 1)) - 1), ix, iy, iz, out.packed);
    out.packed_alone_count =
        store_packed(x < gather(numbers, load<I>(index)), ix, out.packed_alone);
    store(gather(numbers, load<I>(index)), out.gathered);
    store(gather(reinterpret_cast<const std::int32_t*>(numbers), load<I>(index)),
          out.gathered_bits);
    I first, second;
    load_interleaved(bit_patterns, first, second);
    store(first, out.pair[0]);
    store(second, out.pair[1]);
    store(iota<I>(-3), out.counted);
    store(load<I>(bit_patterns), out.copied);
}

void run_wide(const Operands& in, Results& out) {
    operations<F32, I32, F64>(in, out);
}
void run_narrow(const Operands& in, Results& out) {
    operations<F32x8, I32x8, F64x8>(in, out);
}
void memory_wide(const float* numbers, const std::int32_t* index, MemoryResults& out) {
    memory<F32, I32>(numbers, index, out);
    store_interleaved(load<I32>(out.ix), I32(0) - load<I32>(out.iy), to_f64(load<F32>(out.z)),
                      out.records);
}
void memory_narrow(const float* numbers, const std::int32_t* index, MemoryResults& out) {
    memory<F32x8, I32x8>(numbers, index, out);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::test {

SIMD_REGISTER(run_wide);
SIMD_REGISTER(run_narrow);
SIMD_REGISTER(memory_wide);
SIMD_REGISTER(memory_narrow);

void run_operations(bool narrow, const Operands& in, Results& out) {
    narrow ? SIMD_CALL(run_narrow, in, out) : SIMD_CALL(run_wide, in, out);
}
void run_memory(bool narrow, const float* numbers, const std::int32_t* index, MemoryResults& out) {
    narrow ? SIMD_CALL(memory_narrow, numbers, index, out)
           : SIMD_CALL(memory_wide, numbers, index, out);
}

} // namespace scanout::test
#endif
