#include "image/enlarge.h"

#include "base/check.h"

#include <algorithm>
#include <array>
#include <bit>

namespace scanout::image {
namespace {

constexpr std::uint32_t kOne = 16; // of weights; both axes together: 256
constexpr int kRowsAtOnce = 16;
constexpr std::uint64_t kChannels = 0x00ff'00ff'00ff'00ff;

// Four channels of a pixel, 16 bits each: sums of codes times 256 just fit.
std::uint64_t spread(const Rgba8& pixel) {
    std::uint64_t p = std::bit_cast<std::uint32_t>(pixel);
    p = (p | p << 16) & 0x0000'ffff'0000'ffff;
    return (p | p << 8) & kChannels;
}
// The nearest codes of sums times 256.
Rgba8 packed(std::uint64_t sums) {
    std::uint64_t p = ((sums + 0x0080'0080'0080'0080) >> 8) & kChannels;
    p = (p | p >> 8) & 0x0000'ffff'0000'ffff;
    return std::bit_cast<Rgba8>(static_cast<std::uint32_t>(p | p >> 16));
}

bool is_opaque(std::span<const Rgba8> row) {
    return std::all_of(row.begin(), row.end(), [](const Rgba8& p) { return p.a == 255; });
}

// What is transparent has no colour that could mix.
Rgba8 weighted(const std::array<Rgba8, 4>& pixels, const std::array<std::uint32_t, 4>& weights) {
    std::array<std::uint32_t, 4> sums{}; // of r, g, b times alpha, and of alpha
    for (std::size_t i = 0; i < 4; ++i) {
        const std::uint32_t alpha = weights[i] * pixels[i].a;
        sums[0] += alpha * pixels[i].r;
        sums[1] += alpha * pixels[i].g;
        sums[2] += alpha * pixels[i].b;
        sums[3] += alpha;
    }
    const std::uint32_t alpha = sums[3];
    if (alpha < 128) return {0, 0, 0, 0};
    const auto mean = [&](std::uint32_t sum) {
        return static_cast<std::uint8_t>((sum + alpha / 2) / alpha);
    };
    return {mean(sums[0]), mean(sums[1]), mean(sums[2]),
            static_cast<std::uint8_t>((alpha + 128) >> 8)};
}

} // namespace

// The middle of large pixel i is at (2 i + 1) small / (2 large) - 1/2 among the middles of the
// small ones.
Enlarger::Place Enlarger::place(int at, int small, int large) {
    const std::int64_t below = 2 * std::int64_t{large};
    const std::int64_t above = (2 * std::int64_t{at} + 1) * small - large;
    const std::int64_t sixteenths = (above * 32 + below) / (2 * below); // rounded; below 0: to 0
    if (above <= 0) return {0, 0, 0};
    const auto first = static_cast<std::int32_t>(sixteenths / 16);
    return {std::min(first, small - 1), std::min(first + 1, small - 1),
            static_cast<std::uint32_t>(sixteenths % 16)};
}

void Enlarger::run(const Image& small, Image& large, Jobs& jobs) {
    CHECK(!small.empty() && large.width() >= small.width() && large.height() >= small.height());
    columns_.resize(static_cast<std::size_t>(large.width()));
    for (int x = 0; x < large.width(); ++x)
        columns_[static_cast<std::size_t>(x)] = place(x, small.width(), large.width());
    const auto draw_row = [&](int y, std::vector<std::uint64_t>& mixed) {
        const Place row = place(y, small.height(), large.height());
        const std::span<const Rgba8> first = small.row(row.first), second = small.row(row.second);
        const std::span<Rgba8> out = large.row(y);
        if (!is_opaque(first) || !is_opaque(second)) {
            for (std::size_t x = 0; x < out.size(); ++x) {
                const Place& p = columns_[x];
                const auto a = static_cast<std::size_t>(p.first),
                           b = static_cast<std::size_t>(p.second);
                const std::uint32_t top = kOne - row.weight, left = kOne - p.weight;
                out[x] = weighted(
                    {first[a], first[b], second[a], second[b]},
                    {top * left, top * p.weight, row.weight * left, row.weight * p.weight});
            }
            return;
        }
        for (std::size_t x = 0; x < first.size(); ++x)
            mixed[x] = spread(first[x]) * (kOne - row.weight) + spread(second[x]) * row.weight;
        for (std::size_t x = 0; x < out.size(); ++x) {
            const Place& p = columns_[x];
            out[x] = packed(mixed[static_cast<std::size_t>(p.first)] * (kOne - p.weight) +
                            mixed[static_cast<std::size_t>(p.second)] * p.weight);
        }
    };
    const int parts = (large.height() + kRowsAtOnce - 1) / kRowsAtOnce;
    rows_.resize(static_cast<std::size_t>(jobs.threads()));
    for (std::vector<std::uint64_t>& row : rows_)
        row.resize(static_cast<std::size_t>(small.width()));
    jobs.for_each(parts, [&](int part, int worker) {
        std::vector<std::uint64_t>& mixed = rows_[static_cast<std::size_t>(worker)];
        const int end = std::min((part + 1) * kRowsAtOnce, large.height());
        for (int y = part * kRowsAtOnce; y < end; ++y)
            draw_row(y, mixed);
    });
}

} // namespace scanout::image
