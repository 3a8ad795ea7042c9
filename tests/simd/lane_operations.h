// Every operation of simd/lanes-inl.h over one register of operands, on the target that is chosen.
// Each is named by its formula, which the kernel compiles for lanes and the test for plain numbers.
#pragma once

#include <cstdint>

// clang-format off: it takes products for pointers
// Operands of every lane: floats a, b; integers i, j; doubles p, q; and c, r, within the limits of
// an int32.
#define SCANOUT_FLOAT_OPERATIONS(X)                                                                \
    X(a + b)                                                                                       \
    X(a - b)                                                                                       \
    X(a* b)                                                                                        \
    X(a / b)                                                                                       \
    X(-a)                                                                                          \
    X(sqrt(a))                                                                                     \
    X(abs(a))                                                                                      \
    X(minimum(a, b))                                                                               \
    X(maximum(a, b))                                                                               \
    X(select(a < b, a, b))                                                                         \
    X(select(i < j, a, b))                                                                         \
    X(to_f32(i))                                                                                   \
    X(to_f32(p))                                                                                   \
    X(to_f32(q))                                                                                   \
    X(from_bits(i))                                                                                \
    X(a* b + b) /* two roundings: never fused */                                                   \
    X(a - b * b)
#define SCANOUT_INT_OPERATIONS(X)                                                                  \
    X(i + j)                                                                                       \
    X(i - j)                                                                                       \
    X(i* j)                                                                                        \
    X(i& j)                                                                                        \
    X(i | j)                                                                                       \
    X(minimum(i, j))                                                                               \
    X(maximum(i, j))                                                                               \
    X(select(i < j, i, j))                                                                         \
    X(select(a < b, i, j))                                                                         \
    X(shift_left<5>(i))                                                                            \
    X(shift_left<31>(i))                                                                           \
    X(shift_right<7>(i))                                                                           \
    X(shift_right<31>(i))                                                                          \
    X(to_i32(c))                                                                                   \
    X(to_i32(r))                                                                                   \
    X(bits_of(a))
#define SCANOUT_DOUBLE_OPERATIONS(X)                                                               \
    X(p + q)                                                                                       \
    X(p - q)                                                                                       \
    X(p* q)                                                                                        \
    X(p / q)                                                                                       \
    X(-p)                                                                                          \
    X(abs(p))                                                                                      \
    X(minimum(p, q))                                                                               \
    X(maximum(p, q))                                                                               \
    X(select(p < q, p, q))                                                                         \
    X(select(p > q, p, q))                                                                         \
    X(select(p <= q, p, q))                                                                        \
    X(select(p >= q, p, q))                                                                        \
    X(select(p == q, p, q))                                                                        \
    X(select((!(p < q)) & (q <= p), p, q))                                                         \
    X(select((p < q) | (q == q), p, q))                                                            \
    X(select(to_f64(i < j), p, q))                                                                 \
    X(select(to_f64(a < b), p, q))                                                                 \
    X(to_f64(a))                                                                                   \
    X(to_f64(i))                                                                                   \
    X(p* q + q)
#define SCANOUT_MASK_OPERATIONS(X)                                                                 \
    X(a < b)                                                                                       \
    X(a > b)                                                                                       \
    X(a <= b)                                                                                      \
    X(a >= b)                                                                                      \
    X(a == b)                                                                                      \
    X(i < j)                                                                                       \
    X(i > j)                                                                                       \
    X(i <= j)                                                                                      \
    X(i >= j)                                                                                      \
    X(i == j)                                                                                      \
    X((a < b) & (i < j))                                                                           \
    X((a < b) | (i < j))                                                                           \
    X((a < b) ^ (i < j))                                                                           \
    X(!(a < b))                                                                                    \
    X(i == i)                                                                                      \
    X(!(i == i))
// clang-format on

namespace scanout::test {

#define SCANOUT_COUNT(formula) +1
inline constexpr int kFloatOperations = SCANOUT_FLOAT_OPERATIONS(SCANOUT_COUNT);
inline constexpr int kIntOperations = SCANOUT_INT_OPERATIONS(SCANOUT_COUNT);
inline constexpr int kDoubleOperations = SCANOUT_DOUBLE_OPERATIONS(SCANOUT_COUNT);
inline constexpr int kMaskOperations = SCANOUT_MASK_OPERATIONS(SCANOUT_COUNT);
#undef SCANOUT_COUNT

inline constexpr int kMaxLanes = 16;

struct Operands {
    float a[kMaxLanes], b[kMaxLanes], c[kMaxLanes];
    std::int32_t i[kMaxLanes], j[kMaxLanes];
    double p[kMaxLanes], q[kMaxLanes], r[kMaxLanes];
};
struct Results {
    int lanes; // of a register
    float f[kFloatOperations][kMaxLanes];
    std::int32_t i[kIntOperations][kMaxLanes];
    double d[kDoubleOperations][kMaxLanes];
    std::uint32_t bits[kMaskOperations];
    bool any[kMaskOperations], all[kMaskOperations];
};
constexpr std::uint32_t kPacked = 0x5a6d; // the lanes that are packed, a bit each
// What touches memory: from `numbers`, three times as many as there are lanes.
struct MemoryResults {
    struct Record {
        std::int32_t x, y;
        double z;
    } records[kMaxLanes + 1];                                 // of store_interleaved, of wide lanes
    float x[kMaxLanes], y[kMaxLanes], z[kMaxLanes];           // of load_interleaved
    std::int32_t ix[kMaxLanes], iy[kMaxLanes], iz[kMaxLanes]; // the same of integers
    std::int32_t pair[2][kMaxLanes];                          // of load_interleaved of two
    float gathered[kMaxLanes];                                // numbers[index]
    std::int32_t gathered_bits[kMaxLanes], counted[kMaxLanes]; // iota(-3)
    std::uint32_t copied[kMaxLanes];
    std::uint32_t packed[3 * kMaxLanes]; // ix, iy, iz of those lanes
    int packed_count;
    std::int32_t packed_alone[2 * kMaxLanes]; // ix of those of which x < numbers[index]
    std::uint32_t packed_alone_count;
};

// narrow: the types of at most 8 lanes.
void run_operations(bool narrow, const Operands& in, Results& out);
void run_memory(bool narrow, const float* numbers, const std::int32_t* index, MemoryResults& out);

} // namespace scanout::test
