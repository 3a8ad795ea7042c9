// What the reference says of its own noise is true: pictures of other samples, chosen
// independently, differ as much.
#include "accuracy/referenced.h"
#include "support/scenes.h"
#include "support/srgb_formula.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace scanout::trace {
namespace {

using test::Shot;

constexpr int kSeeds = 6;

struct Noise {
    double real = 0, said = 0; // roots of mean squares of standard errors, codes
    double within = 0;         // share of pixels that are not sure whose error is within its bound
};

double code(const Reference& r, std::size_t pixel, int channel) {
    return test::encoded(double{r.light[pixel][channel]});
}

Noise noise_of(const Shot& s) {
    std::vector<Reference> made;
    for (int seed = 0; seed < kSeeds; ++seed)
        made.push_back(test::reference_of(s, {512, false, seed}));
    Noise noise;
    double unsure = 0;
    const std::size_t pixels = made[0].light.size();
    for (std::size_t i = 0; i < pixels; ++i) {
        double variance = 0, most[kSeeds] = {};
        for (int c = 0; c < 3; ++c) {
            double mean = 0, squares = 0;
            for (const Reference& r : made)
                mean += code(r, i, c) / kSeeds;
            for (int k = 0; k < kSeeds; ++k) {
                // From the mean of all, which shares a sixth of the error.
                const double off =
                    (code(made[k], i, c) - mean) * std::sqrt(kSeeds / (kSeeds - 1.0));
                squares += off * off / kSeeds;
                most[k] = std::max(most[k], std::abs(off));
            }
            variance = std::max(variance, squares);
        }
        noise.real += variance / static_cast<double>(pixels);
        if (variance < 1e-12) continue; // all alike, but for rounding
        for (int k = 0; k < kSeeds; ++k) {
            unsure += 1;
            noise.within += most[k] <= double{made[k].error[i]} ? 1 : 0;
        }
    }
    noise.real = std::sqrt(noise.real);
    for (const Reference& r : made)
        noise.said += r.mean_error() / kSeeds;
    noise.within /= unsure;
    return noise;
}

// Never too low by more than a tenth; too high by up to a third where edges make the noise, and
// more where smooth texture does, whose samples converge faster than an estimate may count on.
TEST(ReferenceNoise, IsAsLargeAsItSays) {
    struct Row {
        Shot shot;
        double most;
    };
    for (Row row : std::vector<Row>{{test::shipped("spot/spot.obj", 40, 30), 1.8},
                                    {test::shipped("suzanne/suzanne.obj", 40, 30), 1.5},
                                    {test::cornell_box(32, 0), 1.8},
                                    {test::cornell_box(32, 60), 1.8},
                                    {test::panes("panes", "auto"), 1.5},
                                    {test::star("a star"), 1.5},
                                    {test::noisy_floor("a floor", "auto"), 2.5}}) {
        row.shot.options.width = std::min(row.shot.options.width, 40);
        row.shot.options.height = std::min(row.shot.options.height, 40);
        const Noise noise = noise_of(row.shot);
        EXPECT_GE(noise.said, 0.9 * noise.real) << row.shot.name;
        EXPECT_LE(noise.said, row.most * noise.real) << row.shot.name;
        EXPECT_GE(noise.within, 0.85) << row.shot.name;
    }
}

} // namespace
} // namespace scanout::trace
