// The inlining attributes of the lanes' and the kernels' functions. Included once for every target,
// so it has no guard.
//
// A register is one operand of the machine, and every function of registers belongs in its kernel.
// But plain lanes (EMU128) are arrays and loops, and sanitizers instrument each operation: with all
// of that in one function, g++ took 100 seconds for one kernel on plain lanes, clang++ 90 for one
// that is sanitized. Where compilers decide for themselves they take ten.
#include <hwy/highway.h>

#undef SIMD_INLINE
#undef SIMD_LAMBDA // after a lambda's parameters
#if HWY_TARGET == HWY_EMU128 || defined(SCANOUT_SANITIZED)
#define SIMD_INLINE inline HWY_MAYBE_UNUSED
#define SIMD_LAMBDA HWY_ATTR
#else
// Without it, the inlining of a lambda depends on the other contents of the file.
#define SIMD_INLINE HWY_INLINE
#define SIMD_LAMBDA HWY_ATTR __attribute__((always_inline))
#endif
