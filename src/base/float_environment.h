// Sets rounding to nearest and keeps denormals during its lifetime, however a library or the caller
// set them: the same bits need the same arithmetic in every thread (HARD-CASES D6).
#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace scanout {

class FloatEnvironment {
public:
    FloatEnvironment() : before_(control()) { set_control(kPlain); }
    ~FloatEnvironment() { set_control(before_); }
    FloatEnvironment(const FloatEnvironment&) = delete;
    FloatEnvironment& operator=(const FloatEnvironment&) = delete;

private:
#if defined(__SSE2__)
    static constexpr std::uint64_t kPlain = 0x1f80; // MXCSR: all exceptions masked, nothing else
    static std::uint64_t control() {
        return _mm_getcsr();
    }
    static void set_control(std::uint64_t word) {
        _mm_setcsr(static_cast<unsigned>(word));
    }
#elif defined(__aarch64__)
    static constexpr std::uint64_t kPlain = 0; // FPCR
    static std::uint64_t control() {
        std::uint64_t word = 0;
        __asm__ volatile("mrs %0, fpcr" : "=r"(word));
        return word;
    }
    static void set_control(std::uint64_t word) {
        __asm__ volatile("msr fpcr, %0" : : "r"(word));
    }
#else
#error "this processor's floating-point control word is not known here"
#endif
    std::uint64_t before_;
};

} // namespace scanout
