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

Noise noise_of(const Shot& s, std::uint32_t samples) {
    std::vector<Reference> made;
    for (int seed = 0; seed < kSeeds; ++seed)
        made.push_back(test::reference_of(s, {samples, false, seed}));
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
        noise.said += r.noise / kSeeds;
    noise.within /= unsure;
    return noise;
}

struct Row {
    Shot shot;
    double within;      // the share of pixels, at least
    double said = 0.85; // of the real noise, at least
};

void expect_noise(std::vector<Row> rows, std::uint32_t samples, double low, double high) {
    for (Row& row : rows) {
        row.shot.options.width = std::min(row.shot.options.width, 40);
        row.shot.options.height = std::min(row.shot.options.height, 40);
        const Noise noise = noise_of(row.shot, samples);
        EXPECT_GE(noise.said, std::min(low, row.said) * noise.real) << row.shot.name;
        EXPECT_LE(noise.said, high * noise.real) << row.shot.name;
        EXPECT_GE(noise.within, row.within) << row.shot.name;
    }
}

std::vector<Row> rows() {
    return {{test::shipped("spot/spot.obj", 40, 30), 0.9},
            {test::shipped("suzanne/suzanne.obj", 40, 30), 0.85},
            {test::cornell_box(32, 0), 0.9},
            {test::cornell_box(32, 60), 0.85, 0.8}, // 0.82 of 16 pictures: a soft shadow's edge
            {test::panes("panes", "auto"), 0.9},
            {test::star("a star"), 0.85},
            {test::noisy_floor("a floor", "auto"), 0.9}};
}

// Six pictures tell the real noise of the few pixels that make most of it to about a tenth.
TEST(ReferenceNoise, IsAsLargeAsItSays) {
    expect_noise(rows(), 512, 0.85, 1.25);
}

// Of as few samples as --quick takes, errors do not yet fall evenly.
TEST(ReferenceNoise, IsAboutAsLargeOfFewSamples) {
    expect_noise(rows(), 128, 0.75, 1.25);
}

} // namespace
} // namespace scanout::trace
