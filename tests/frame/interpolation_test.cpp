// Interpolation measured through the whole renderer, by what it shows: the texture coordinate runs
// through a texture of 16384 texels of different colours, repeated 1024 times, so that a pixel's
// colour tells u to 2^-24. HARD-CASES 32-35, P11.
#include "ruler.h"

namespace scanout::test {
namespace {

using oracle::Three;

double exact_u(const Known& t, int x, int y) {
    return oracle::perspective_at(t.corner, t.u, t.w, x * 256 + 128, y * 256 + 128).nearest();
}

class AtRatio : public testing::TestWithParam<double> {};

// HARD-CASES 32, P11: 10^5 triangles at four ratios of w, 25 000 each, one a cell of 16x16.
TEST_P(AtRatio, InterpolationIsWithinTwoToTheMinus20OfTheRange) {
    constexpr int kSide = 1024, kCell = 16, kCells = kSide / kCell, kFrames = 7;
    Random random(static_cast<std::uint64_t>(GetParam()) + 1);
    Ruler ruler(kSide);
    double worst = 0;
    std::int64_t samples = 0;
    int triangles = 0;
    for (int f = 0; f < kFrames; ++f) {
        ruler.clear();
        std::vector<Known> known;
        for (int cell = 0; cell < kCells * kCells; ++cell) {
            Known t;
            const int x0 = cell % kCells * kCell * 256, y0 = cell / kCells * kCell * 256;
            for (std::size_t i = 0; i < 3; ++i) {
                t.corner[i] = {x0 + random.whole(0, kCell * 256),
                               y0 + random.whole(0, kCell * 256)};
                t.w[i] = oracle::few_bits(std::exp2(random.unit() * std::log2(GetParam())));
                t.u[i] = static_cast<double>(random.whole(0, 1 << 20)) * 0x1p-20;
            }
            t.w[0] = 1;
            t.w[1] = oracle::few_bits(GetParam());
            t.u[0] = 0; // the whole range
            t.u[2] = 1 - 0x1p-20;
            known.push_back(t);
            ruler.add(t);
        }
        ruler.draw();
        for (std::size_t cell = 0; cell < known.size(); ++cell) {
            const int x0 = static_cast<int>(cell) % kCells * kCell,
                      y0 = static_cast<int>(cell) / kCells * kCell;
            bool seen = false;
            for (int y = y0; y < y0 + kCell; ++y)
                for (int x = x0 + (y & 1); x < x0 + kCell; x += 2) {
                    if (!ruler.covered(x, y)) continue;
                    worst = std::max(worst, ruler.error(x, y, exact_u(known[cell], x, y)));
                    ++samples;
                    seen = true;
                }
            triangles += seen ? 1 : 0;
        }
    }
    EXPECT_LE(worst, 16); // 2^-20
    EXPECT_GT(triangles, 25000);
    record("worst_in_2^-24_of_range", worst);
    record("triangles_seen", triangles);
    record("samples", static_cast<double>(samples));
}
INSTANTIATE_TEST_SUITE_P(P11, AtRatio, testing::Values(1.0, 10.0, 1e3, 1e6));

// HARD-CASES P11: what is the same at all three vertices is the same everywhere.
TEST(Interpolated, AConstantStaysThatConstant) {
    Random random(2);
    Ruler ruler(512);
    double worst = 0;
    int samples = 0;
    for (int f = 0; f < 40; ++f) {
        ruler.clear();
        const double u = random.whole(0, (1 << 24) - 1) * 0x1p-24;
        for (int i = 0; i < 40; ++i) {
            Known t;
            for (std::size_t k = 0; k < 3; ++k) {
                t.corner[k] = {random.whole(0, 512 * 256), random.whole(0, 512 * 256)};
                t.w[k] = oracle::few_bits(std::exp2(random.in(0, 20)));
                t.u[k] = u;
            }
            ruler.add(t);
        }
        ruler.draw();
        for (int y = 0; y < 512; y += 5)
            for (int x = 0; x < 512; ++x) {
                if (!ruler.covered(x, y)) continue;
                worst = std::max(worst, ruler.error(x, y, u));
                ++samples;
            }
    }
    EXPECT_EQ(worst, 0); // not one unit in the last place
    EXPECT_GT(samples, 200000);
    record("worst_in_2^-24", worst);
}

// HARD-CASES 33: at the ratios where affine interpolation is wrong by 0.17 and 0.024 of the range,
// ours is not; the naive error stands beside it.
TEST(Interpolated, DoesNotBendWhereAffineInterpolationDoes) {
    for (const auto& [ratio, naive_bound] : {std::pair{2.0, 0.17}, {1.125, 0.024}, {8.0, 0.45}}) {
        Ruler ruler(512);
        Known t{{{{0, 0}, {512 * 256, 0}, {0, 512 * 256}}}, {1, ratio, 1}, {0, 1 - 0x1p-20, 0}};
        ruler.add(t);
        ruler.draw();
        double worst = 0, affine = 0;
        for (int y = 0; y < 512; y += 7)
            for (int x = 0; x < 511 - y; ++x) {
                ASSERT_TRUE(ruler.covered(x, y));
                const double exact = exact_u(t, x, y);
                worst = std::max(worst, ruler.error(x, y, exact));
                affine = std::max(
                    affine,
                    std::abs(
                        oracle::linear_at(t.corner, t.u, x * 256 + 128, y * 256 + 128).nearest() -
                        exact));
            }
        EXPECT_LE(worst, 16) << ratio;
        EXPECT_GT(affine, naive_bound) << ratio;
        record("affine_at_" + testing::PrintToString(ratio), affine);
        record("ours_in_2^-24_at_" + testing::PrintToString(ratio), worst);
    }
}

// HARD-CASES 34: samples on edges and at vertices; u never leaves [min, max] of the vertices, where
// one step outside would show the texture's other end.
TEST(Interpolated, NeverLeavesTheRangeOfItsVertices) {
    Random random(3);
    Ruler ruler(256);
    std::int64_t outside = 0, on_edge = 0, samples = 0;
    for (int f = 0; f < 60; ++f) {
        ruler.clear();
        // u from 0 to 8191 texels: half of the colours never appear.
        constexpr double kTop = 8191 * 0x1p-24;
        std::vector<Known> known;
        for (int cell = 0; cell < 64; ++cell) {
            Known t;
            for (std::size_t i = 0; i < 3; ++i) {
                // Corners on pixel centres: samples on edges and vertices
                t.corner[i] = {(cell % 8 * 32 + random.whole(0, 31)) * 256 + 128,
                               (cell / 8 * 32 + random.whole(0, 31)) * 256 + 128};
                t.w[i] = oracle::few_bits(std::exp2(random.in(0, f % 2 == 0 ? 1 : 20)));
                t.u[i] = random.bits() % 2 == 0 ? 0 : kTop;
            }
            known.push_back(t);
            ruler.add(t);
        }
        const image::Image& picture = ruler.draw();
        for (int y = 0; y < 256; ++y)
            for (int x = 0; x < 256; ++x) {
                if (!ruler.covered(x, y)) continue;
                const Known& t = known[static_cast<std::size_t>(y / 32 * 8 + x / 32)];
                const Three e = oracle::areas_at(t.corner, x * 256 + 128, y * 256 + 128);
                on_edge += e[0] == 0 || e[1] == 0 || e[2] == 0 ? 1 : 0;
                outside += texel_of(picture.at(x, y)) > 8191 ? 1 : 0;
                ++samples;
            }
    }
    EXPECT_EQ(outside, 0);
    EXPECT_GT(on_edge, 5000);
    EXPECT_GT(samples, 100000);
    record("outside", static_cast<double>(outside));
    record("samples_on_edges", static_cast<double>(on_edge));
}

// HARD-CASES 35: over 3840 pixels nothing adds up. Without perspective, so that only the way across
// the picture is measured.
TEST(Interpolated, DoesNotDriftOver3840Pixels) {
    Ruler ruler(4096, 64);
    double worst = 0;
    for (const double top : {0.5, 0.75, 1 - 0x1p-24}) {
        ruler.clear();
        Known t{{{{128 * 256, 0}, {(128 + 3840) * 256, 0}, {128 * 256, 64 * 256}}},
                {1, 1, 1},
                {0, top, 0}};
        ruler.add(t);
        ruler.draw();
        for (int y = 0; y < 64; y += 9)
            for (int x = 128; x < 128 + 3840; ++x)
                if (ruler.covered(x, y))
                    worst = std::max(worst, ruler.error(x, y, exact_u(t, x, y)) / top);
    }
    EXPECT_LE(worst, 2);
    record("worst_in_2^-24_of_range", worst);
}

} // namespace
} // namespace scanout::test
