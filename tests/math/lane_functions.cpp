#include "math/lane_functions.h"

#include <tuple>

#define SIMD_FILE "math/lane_functions.cpp"
#include "simd/for_each_target.h"

#include "math/srgb-inl.h"
#include "math/transcendental-inl.h"

SIMD_BEGIN(scanout::test)

// Arrays have room for whole registers.
void run_log2(const float* x, int count, float* out) {
    for (int i = 0; i < count; i += kLanes)
        store(log2(load<F32>(x + i)), out + i);
}
void run_exp2(const float* x, int count, float* out) {
    for (int i = 0; i < count; i += kLanes)
        store(exp2(load<F32>(x + i)), out + i);
}
void run_pow(const float* x, const float* y, int count, float* out) {
    for (int i = 0; i < count; i += kLanes)
        store(pow(load<F32>(x + i), load<F32>(y + i)), out + i);
}
void run_pow_of_share(const float* x, const float* y, int count, float* out) {
    for (int i = 0; i < count; i += kLanes)
        store(pow_of_share(load<F32>(x + i), load<F32>(y + i)), out + i);
}
void run_atan2(const float* y, const float* x, int count, float* out) {
    for (int i = 0; i < count; i += kLanes)
        store(atan2(load<F32>(y + i), load<F32>(x + i)), out + i);
}
void run_encode(const float* linear, int count, std::int32_t* out) {
    for (int i = 0; i < count; i += kLanes)
        store(srgb_encode(load<F32>(linear + i)), out + i);
}
void run_decode(const std::int32_t* codes, int count, float* out) {
    for (int i = 0; i < count; i += kLanes)
        store(srgb_decode(load<I32>(codes + i)), out + i);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::test {

SIMD_REGISTER(run_log2);
SIMD_REGISTER(run_exp2);
SIMD_REGISTER(run_pow);
SIMD_REGISTER(run_pow_of_share);
SIMD_REGISTER(run_atan2);
SIMD_REGISTER(run_encode);
SIMD_REGISTER(run_decode);

namespace {

constexpr std::size_t kRegister = 16;

// kernel(input..., count, output) over copies that have room for whole registers.
template <class Out, class Kernel, class... In>
std::vector<Out> apply(Kernel kernel, In... input) {
    const std::size_t count = std::get<0>(std::tie(input...)).size();
    (input.resize(count + kRegister), ...);
    std::vector<Out> out(count + kRegister);
    kernel(input.data()..., static_cast<int>(count), out.data());
    out.resize(count);
    return out;
}

} // namespace

Floats log2_lanes(const Floats& x) {
    return apply<float>(SIMD_KERNEL(run_log2), x);
}
Floats exp2_lanes(const Floats& x) {
    return apply<float>(SIMD_KERNEL(run_exp2), x);
}
Floats pow_lanes(const Floats& x, const Floats& y) {
    return apply<float>(SIMD_KERNEL(run_pow), x, y);
}
Floats pow_of_share_lanes(const Floats& x, const Floats& y) {
    return apply<float>(SIMD_KERNEL(run_pow_of_share), x, y);
}
Floats atan2_lanes(const Floats& y, const Floats& x) {
    return apply<float>(SIMD_KERNEL(run_atan2), y, x);
}
std::vector<std::int32_t> srgb_encode_lanes(const Floats& linear) {
    return apply<std::int32_t>(SIMD_KERNEL(run_encode), linear);
}
Floats srgb_decode_lanes(const std::vector<std::int32_t>& codes) {
    return apply<float>(SIMD_KERNEL(run_decode), codes);
}

} // namespace scanout::test
#endif
