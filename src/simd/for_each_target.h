// Compiles the rest of a kernel's .cpp once for every SIMD target of the program (Highway). A
// kernel file reads:
//
//     #include "shade/stage.h"                        // what does not depend on a target
//
//     #define SIMD_FILE "shade/texture/nearest.cpp"   // this file
//     #include "simd/for_each_target.h"
//
//     SIMD_BEGIN(scanout::shade::texture)
//     void run(ShadingBlock& block, const FrameState&) { ... F32 x = load(...); ... }
//     SIMD_END
//
//     #if SIMD_ONCE
//     namespace scanout::shade::texture {
//     SIMD_REGISTER(run);
//     ... SIMD_CALL(run, block, frame) ...            // on the best target that is allowed
//     }
//     #endif
//
// Code between SIMD_BEGIN and SIMD_END sees the lanes of simd/lanes-inl.h. It must not use
// templates or inline functions of the standard library or of other headers on its hot path: they
// are compiled for the baseline and cannot be inlined. Headers with lanes are named *-inl.h and
// come after this one.
//
// The build compiles several kernel files together (cmake/unity.cmake): SIMD_UNIT is then the file
// that includes them, and is read once for every target in their place, so that one reading of
// Highway serves all of them.
#undef HWY_TARGET_INCLUDE
#ifdef SIMD_UNIT
#define HWY_TARGET_INCLUDE SIMD_UNIT
#else
#define HWY_TARGET_INCLUDE SIMD_FILE
#endif

// The order matters.
// clang-format off
#include <hwy/foreach_target.h>
#include "simd/lanes-inl.h"
// clang-format on

#ifndef SCANOUT_SIMD_FOR_EACH_TARGET_H
#define SCANOUT_SIMD_FOR_EACH_TARGET_H

#define SIMD_BEGIN(space)                                                                          \
    HWY_BEFORE_NAMESPACE();                                                                        \
    namespace space::HWY_NAMESPACE {                                                               \
    namespace {                                                                                    \
    using namespace ::scanout::simd::HWY_NAMESPACE;
#define SIMD_END                                                                                   \
    }                                                                                              \
    }                                                                                              \
    HWY_AFTER_NAMESPACE();
// SIMD_FOR (int k = 0; k < 3; ++k): a loop of a few rounds over vertices or registers, unrolled, so
// that its arrays become registers. clang-format knows it (ForEachMacros).
#ifdef __clang__
#define SIMD_FOR(...) _Pragma("clang loop unroll(full)") for (__VA_ARGS__)
#else
#define SIMD_FOR(...) _Pragma("GCC unroll 8") for (__VA_ARGS__)
#endif
#define SIMD_ONCE HWY_ONCE
#define SIMD_REGISTER(kernel) HWY_EXPORT(kernel)
#define SIMD_KERNEL(kernel) HWY_DYNAMIC_DISPATCH(kernel) // the pointer to it
#define SIMD_CALL(kernel, ...) SIMD_KERNEL(kernel)(__VA_ARGS__)

#endif
