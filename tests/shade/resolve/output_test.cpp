// From light to codes: every encoding against its formula in double, dither against Bayer's
// promise, and the film's curve.
#include "image/dither.h"
#include "math/srgb.h"
#include "rows.h"
#include "shade/block.h"
#include "shade/resolve/output.h"
#include "shade/resolve/resolve.h"

#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace scanout::shade {
namespace {

using namespace test;

struct Rule {
    std::string name;
    std::function<double(double)> codes; // of light in [0, 1], not rounded
    double beside_srgb;                  // codes: the declared error
};
double srgb_codes(double x) {
    return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055);
}
const Rule kRules[] = {{"square_root", [](double x) { return 255 * std::sqrt(x); }, 10},
                       {"power_2_2", [](double x) { return 255 * std::pow(x, 1 / 2.2); }, 9},
                       {"srgb", srgb_codes, 0}};

// The codes of grey light, on every target.
std::vector<int> codes(const Encoding& encoding, const std::vector<float>& light,
                       const float* offset = nullptr) {
    std::vector<float> lanes = light;
    lanes.resize(light.size() + 16, 0.5F);
    std::vector<std::uint32_t> out(lanes.size()), first;
    scanout::test::on_every_target([&](const std::string&) {
        encoding.encode({lanes.data(), lanes.data(), lanes.data(), nullptr, offset},
                        static_cast<int>(light.size()), out.data());
        if (first.empty()) first = out;
        for (std::size_t i = 0; i < light.size(); ++i)
            ASSERT_EQ(out[i], first[i]) << encoding.card.name << " of " << light[i];
    });
    std::vector<int> result;
    for (std::size_t i = 0; i < light.size(); ++i) {
        const std::uint32_t red = first[i] & 255;
        EXPECT_EQ(first[i], 0xff000000 | red * 0x010101) << "channels differ";
        result.push_back(static_cast<int>(red));
    }
    return result;
}

// Floats in [0, 1], denser towards 0, with both ends.
std::vector<float> steps() {
    std::vector<float> light = {0, 1};
    for (std::uint32_t bits = 0x38000000; bits < 0x3f800000; bits += 997)
        light.push_back(std::bit_cast<float>(bits));
    std::sort(light.begin(), light.end());
    return light;
}

TEST(Encode, IsTheNearestCodeOfItsCurveAndNeverFalls) {
    const std::vector<float> light = steps();
    for (const Rule& rule : kRules) {
        const std::vector<int> got = codes(*find_row(shade::encode::kRows, rule.name), light);
        double worst = 0, beside = 0;
        for (std::size_t i = 0; i < light.size(); ++i) {
            const double x = light[i];
            worst = std::max(worst, std::abs(got[i] - rule.codes(x)));
            beside = std::max(beside, std::abs(rule.codes(x) - srgb_codes(x)));
            ASSERT_GE(got[i], got[i > 0 ? i - 1 : 0]) << rule.name << " at " << x;
        }
        EXPECT_LE(worst, 0.5 + 1e-4) << rule.name;
        EXPECT_EQ(got.front(), 0) << rule.name;
        EXPECT_EQ(got.back(), 255) << rule.name;
        // The rung's declared error is what it costs, no less and hardly more.
        EXPECT_LE(beside, rule.beside_srgb + 0.5) << rule.name;
        EXPECT_GE(beside, rule.beside_srgb - 1) << rule.name;
    }
}

TEST(Encode, ClampsAndTakesNoNumberForBlack) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const std::vector<float> light = {-1,      -0.0F, -kInfinity, std::nanf(""),
                                      1.0001F, 300,   kInfinity,  1e-40F};
    for (const Encoding* encoding : shade::encode::kRows)
        EXPECT_EQ(codes(*encoding, light), std::vector<int>({0, 0, 0, 0, 255, 255, 255, 0}))
            << encoding->card.name;
}

TEST(Encode, GivesEveryCodeBackFromItsLight) {
    std::vector<int> all(256);
    std::iota(all.begin(), all.end(), 0);
    for (const Encoding* encoding : shade::encode::kRows) {
        std::vector<float> light;
        for (const int code : all)
            light.push_back(encoding->decode(static_cast<std::uint8_t>(code)));
        EXPECT_EQ(codes(*encoding, light), all) << encoding->card.name;
        // Clean colours stay clean under dither.
        for (const unsigned place : {0u, 1u, 9u, 27u, 63u}) {
            const std::vector<float> offset(272, image::dither_offset(place % 8, place / 8));
            EXPECT_EQ(codes(*encoding, light, offset.data()), all) << encoding->card.name;
        }
    }
}

TEST(Encode, DitheredIsTheUnroundedCodeOnAverageAndAtMostOneBeside) {
    std::vector<float> light;
    for (int i = 1; i < 500; ++i)
        light.push_back(static_cast<float>(i * i) / 250000);
    for (const Rule& rule : kRules) {
        const Encoding& encoding = *find_row(shade::encode::kRows, rule.name);
        std::vector<double> mean(light.size(), 0.0);
        for (unsigned place = 0; place < 64; ++place) {
            const std::vector<float> offset(light.size() + 16,
                                            image::dither_offset(place % 8, place / 8));
            const std::vector<int> got = codes(encoding, light, offset.data());
            for (std::size_t i = 0; i < light.size(); ++i) {
                ASSERT_LT(std::abs(got[i] - rule.codes(light[i])), 1);
                mean[i] += got[i] / 64.0;
            }
        }
        for (std::size_t i = 0; i < light.size(); ++i)
            ASSERT_NEAR(mean[i], rule.codes(light[i]), 1.0 / 128 + 1e-4) << rule.name;
    }
}

TEST(Dither, HasEveryThresholdOnceAndMeansAHalf) {
    std::vector<int> seen(64, 0);
    double sum = 0;
    for (unsigned y = 0; y < 8; ++y)
        for (unsigned x = 0; x < 8; ++x) {
            ++seen[image::dither_threshold(x, y)];
            sum += double{image::dither_offset(x, y)};
            EXPECT_EQ(image::dither_threshold(x, y), image::dither_threshold(x + 800, y + 16));
        }
    EXPECT_EQ(seen, std::vector<int>(64, 1));
    EXPECT_EQ(sum / 64, 0.5);
}

// --- the mean of samples

// Of two codes, in 16 samples of which `first` show the first.
int mixed(const char* space, int code_1, int code_2, int first) {
    const Output output{find_row(shade::encode::kRows, "srgb"),
                        find_row(shade::blend_space::kRows, space)};
    const Encoding& encoding = output.sum_encoding();
    PixelSums sums;
    sums.reset(1);
    const auto value = [&](int code) { return encoding.decode(static_cast<std::uint8_t>(code)); };
    const float mean = value(code_1) * static_cast<float>(first) / 16 +
                       value(code_2) * static_cast<float>(16 - first) / 16;
    sums.red[0] = sums.green[0] = sums.blue[0] = mean;
    std::uint32_t out[32];
    resolve_pixels(sums, output, {}, nullptr, 1, out);
    EXPECT_EQ(out[0] >> 24, 255U);
    return static_cast<int>(out[0] & 255);
}

TEST(BlendSpace, OfCodesIsDarkerByUpToItsDeclaredError) {
    int worst = 0;
    for (int a = 0; a < 256; a += 15)
        for (int b = 0; b < 256; b += 15)
            for (int first = 0; first <= 16; ++first) {
                const int linear = mixed("linear", a, b, first);
                const int encoded = mixed("encoded", a, b, first);
                ASSERT_LE(encoded, linear + 1); // rounding alone makes it brighter
                worst = std::max(worst, linear - encoded);
                if (a == b) {
                    ASSERT_EQ(linear, a);
                    ASSERT_EQ(encoded, a);
                }
            }
    EXPECT_LE(worst, 74);
    EXPECT_GE(worst, 72);
    EXPECT_EQ(mixed("linear", 0, 255, 8), 188);
    EXPECT_EQ(mixed("encoded", 0, 255, 8), 128);
}

// --- tone

std::unique_ptr<ShadingBlock> ramp(const scene::Material& material) {
    auto b = new_block(material);
    for (int i = 0; i < kPaddedBlock; ++i)
        for (int c = 0; c < 3; ++c)
            b->colour[c][i] = static_cast<float>(i * (c + 1)) / 16;
    return b;
}

TEST(Exposure, OfNoStopsIsNeutralToTheBit) {
    const scene::Material material;
    const auto before = ramp(material);
    auto b = ramp(material);
    run_stage("exposure", "stops", *b, identity_frame());
    EXPECT_TRUE(same_lanes(*b, *before, 0, b->count));
}

TEST(Exposure, IsAPowerOfTwo) {
    const scene::Material material;
    FrameState frame = identity_frame();
    frame.exposure = 0.25F;
    auto b = ramp(material);
    run_stage("exposure", "stops", *b, frame);
    for (int i = 0; i < b->count; ++i)
        ASSERT_EQ(b->colour[1][i], static_cast<float>(i) / 32);
}

TEST(Tone, FilmicRisesFromBlackToWhiteAsNarkowiczSays) {
    const scene::Material material;
    for (const float exposure : {1.0F, 0.125F}) {
        FrameState frame = identity_frame();
        frame.exposure = exposure;
        auto b = ramp(material);
        run_stage("exposure", "stops", *b, frame);
        run_stage("tone", "filmic", *b, frame);
        for (int i = 0; i < b->count; ++i) {
            const double x = double{exposure} * i / 16;
            const double f = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
            ASSERT_NEAR(b->colour[0][i], std::min(f, 1.0), 1e-6) << x;
            ASSERT_GE(b->colour[0][i], b->colour[0][std::max(i - 1, 0)]);
        }
        EXPECT_EQ(b->colour[0][0], 0);
    }
}

TEST(Tone, FilmicShowsDifferencesThatClampingLosesAndNothingOverflows) {
    const scene::Material material;
    auto b = new_block(material);
    const float light[] = {1, 2, 4, 7, 8, 1e4F, 1e30F, std::numeric_limits<float>::max()};
    for (int i = 0; i < 8; ++i)
        b->colour[0][i] = light[i];
    run_stage("tone", "filmic", *b, identity_frame());
    for (int i = 1; i < 4; ++i)
        EXPECT_GT(b->colour[0][i], b->colour[0][i - 1] + 0.01F);
    for (int i = 4; i < 8; ++i)
        EXPECT_EQ(b->colour[0][i], 1) << light[i];
}

// What the shoulder makes of a light, in a scene that gets as bright as white.
std::vector<float> rolled_off(float white, const std::vector<float>& light) {
    const scene::Material material;
    FrameState frame = identity_frame();
    frame.white = white;
    std::vector<float> rolled;
    for (std::size_t first = 0; first < light.size(); first += kBlockSize) {
        auto b = new_block(material);
        b->count = static_cast<int>(std::min<std::size_t>(kBlockSize, light.size() - first));
        for (auto& channel : b->colour)
            std::copy_n(light.data() + first, b->count, channel);
        run_stage("tone", "shoulder", *b, frame);
        rolled.insert(rolled.end(), b->colour[2], b->colour[2] + b->count);
    }
    return rolled;
}

TEST(Tone, TheShoulderLeavesTheDarksAloneAndMakesTheMostLightWhite) {
    for (const float white : {1.0F, 1.0001F, 1.01F, 1.2F, 2.0F, 7.0F, 1e4F, 1e30F}) {
        std::vector<float> light;
        constexpr int kSteps = 1024;
        for (int i = 0; i <= kSteps; ++i) // closer together about the knee than about white
            light.push_back(white * static_cast<float>(i) / kSteps * static_cast<float>(i) /
                            kSteps);
        const std::vector<float> rolled = rolled_off(white, light);
        for (std::size_t i = 0; i < light.size(); ++i) {
            ASSERT_TRUE(rolled[i] == light[i] || light[i] > 1 / white) << white << ' ' << i;
            ASSERT_LE(rolled[i], std::min(light[i] * (1 + 1e-6F), 1.0F)) << white << ' ' << i;
            if (i == 0) continue;
            ASSERT_GE(rolled[i], rolled[i - 1] - 1e-7F) << white << ' ' << i;
            // The slope begins at 1, and falls.
            ASSERT_LE(rolled[i] - rolled[i - 1], light[i] - light[i - 1] + 1e-6F) << white;
        }
        EXPECT_NEAR(rolled.back(), 1, 1e-6) << white;
        EXPECT_EQ(rolled_off(white, {std::numeric_limits<float>::max()})[0], rolled.back());
        const float knee = 1 / white, step = (1 - knee) / 256;
        const std::vector<float> bend = rolled_off(white, {knee, knee + step});
        EXPECT_NEAR(bend[1] - bend[0], step, step * 0.01 + 1e-7) << white;
    }
}

TEST(Tone, TheShoulderBendsOnlyAsMuchAsTheLightAsks) {
    std::vector<float> light;
    for (int i = 0; i <= 2000; ++i)
        light.push_back(static_cast<float>(i) / 400);
    for (const float white : {1.0F, 1.004F, 1.05F, 1.3F, 2.0F, 5.0F}) {
        const std::vector<float> a = rolled_off(white, light);
        const std::vector<float> b = rolled_off(white + 0.001F, light);
        for (std::size_t i = 0; i < light.size(); ++i)
            ASSERT_NEAR(std::min(a[i], 1.0F), b[i], 0.00101) << white << ' ' << light[i];
    }
}

} // namespace
} // namespace scanout::shade
