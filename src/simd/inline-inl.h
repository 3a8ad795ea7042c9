// What the lanes' functions and those of kernels are marked with. Included once for every target,
// so it has no guard.
//
// A register is one operand of the machine, and every function of registers belongs in its kernel.
// But plain lanes (EMU128) are arrays and loops, and sanitizers instrument each operation: with all
// of that in one function, g++ took 100 seconds for one kernel on plain lanes, clang++ 90 for one
// that is sanitized. Where compilers decide for themselves they take ten.
#include <hwy/highway.h>

#undef SIMD_INLINE
#if HWY_TARGET == HWY_EMU128 || defined(SCANOUT_SANITIZED)
#define SIMD_INLINE inline HWY_MAYBE_UNUSED
#else
#define SIMD_INLINE HWY_INLINE
#endif
