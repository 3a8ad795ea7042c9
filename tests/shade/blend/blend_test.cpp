// The modes of blending that compose colours, against the formula of Cabanier and Andronikos 2015
// in double; and what they leave as it is, to the bit.
#include "rows.h"
#include "shade/transparency.h"
#include "support/random.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace scanout::shade {
namespace {

using test::Random;

auto composing(std::string_view name) {
    const Blend* blend = find_row(shade::blend::kRows, name);
    EXPECT_TRUE(blend != nullptr && blend->compose != nullptr && blend->meet == nullptr) << name;
    return blend->compose;
}

TEST(Blend, MeetsByItsAlphaOrComposesByItsColour) {
    for (const Blend* blend : shade::blend::kRows)
        EXPECT_NE(blend->meet == nullptr, blend->compose == nullptr) << blend->card.name;
}

// Section 5 of Compositing and Blending Level 1, of colours that are not times their alpha.
double formula(bool multiply, double back, double back_alpha, double source, double alpha) {
    const double mixed = multiply ? back * source : 1 - (1 - back) * (1 - source);
    const double blended = (1 - back_alpha) * source + back_alpha * mixed;
    return alpha * blended + (1 - alpha) * back_alpha * back;
}

TEST(Blend, ComposesAsTheFormulaSays) {
    Random random(1);
    for (const bool multiply : {true, false}) {
        const auto compose = composing(multiply ? "multiply" : "screen");
        for (int i = 0; i < 20000; ++i) {
            const double back = random.unit(), source = random.unit(), alpha = random.unit();
            const double back_alpha = i % 3 == 0 ? 1 : i % 3 == 1 ? 0 : random.unit();
            EXPECT_NEAR(compose(static_cast<float>(back * back_alpha),
                                static_cast<float>(back_alpha), static_cast<float>(source),
                                static_cast<float>(alpha)),
                        formula(multiply, back, back_alpha, source, alpha), 3e-7);
        }
    }
}

TEST(Blend, MultiplyByWhiteAndScreenOfBlackChangeNoBit) {
    Random random(2);
    const auto multiply = composing("multiply"), screen = composing("screen");
    for (int i = 0; i < 20000; ++i) {
        const auto behind = static_cast<float>(random.in(0, 4)); // light may exceed white
        const auto alpha = static_cast<float>(i % 2 == 0 ? 1 : random.unit());
        const auto colour = static_cast<float>(random.unit());
        EXPECT_EQ(multiply(behind, 1, 1, alpha), behind);
        EXPECT_EQ(multiply(behind, 1, 0, 1), 0.0F);
        EXPECT_EQ(multiply(0, 1, colour, alpha), 0.0F);
        EXPECT_LE(multiply(behind, 1, colour, alpha), behind);
        EXPECT_EQ(screen(behind, 1, 0, alpha), behind);
        EXPECT_NEAR(screen(behind, 1, 1, 1), 1, 1e-6);
        EXPECT_GE(screen(behind, 1, colour, alpha), std::min(behind, 1.0F));
        for (const auto compose : {multiply, screen})
            EXPECT_EQ(compose(behind * 0.3F, 0.3F, colour, 0), behind * 0.3F);
    }
}

TEST(Blend, TheOrderOfMultipliedAndOfScreenedLayersDoesNotMatter) {
    Random random(3);
    for (const char* name : {"multiply", "screen"}) {
        const auto compose = composing(name);
        for (int i = 0; i < 5000; ++i) {
            float colour[4], alpha[4];
            for (std::size_t k = 0; k < 4; ++k) {
                colour[k] = static_cast<float>(random.unit());
                alpha[k] = static_cast<float>(random.unit() < 0.3 ? 1 : random.unit());
            }
            float a = i % 2 == 0 ? 1.0F : static_cast<float>(random.unit()), b = a;
            float first = static_cast<float>(random.unit()) * a, last = first;
            for (std::size_t k = 0; k < 4; ++k) {
                first = compose(first, a, colour[k], alpha[k]);
                last = compose(last, b, colour[3 - k], alpha[3 - k]);
                a += alpha[k] * (1 - a);
                b += alpha[3 - k] * (1 - b);
            }
            EXPECT_NEAR(first, last, 5e-7) << name;
        }
    }
}

} // namespace
} // namespace scanout::shade
