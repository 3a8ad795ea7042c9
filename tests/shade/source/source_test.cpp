// Computed textures: the same everywhere, without a seam, and no finer than a pixel can show.
#include "rows.h"
#include "shade/block.h"
#include "shade/source/permutation.h"

#include <cmath>
#include <limits>
#include <set>

namespace scanout::shade::test {
namespace {

struct Sampled {
    scene::Material material;
    std::unique_ptr<ShadingBlock> block = new_block(material);
    void place(int i, double u, double v, double u_slope = 0, double v_slope = 0) {
        block->u[i] = static_cast<float>(u);
        block->v[i] = static_cast<float>(v);
        block->u_x[i] = static_cast<float>(u_slope);
        block->v_y[i] = static_cast<float>(v_slope);
    }
    // On every target alike.
    void sample(const char* name) {
        const Source* source = find_row(shade::source::kRows, name);
        ASSERT_NE(source, nullptr);
        std::vector<float> first;
        scanout::test::on_every_target([&](const std::string&) {
            source->sample(*block);
            const std::vector<float> got(block->sampled[0], block->sampled[0] + kBlockSize);
            if (first.empty()) first = got;
            EXPECT_EQ(got, first);
            for (int i = 0; i < kBlockSize; ++i) {
                EXPECT_EQ(block->sampled[1][i], got[static_cast<std::size_t>(i)]);
                EXPECT_EQ(block->sampled[2][i], got[static_cast<std::size_t>(i)]);
            }
        });
    }
    double value(int i) const { return block->sampled[0][i]; }
};

std::vector<std::string> computed() {
    std::vector<std::string> names;
    for (const Source* source : shade::source::kRows)
        if (source->sample != nullptr) names.emplace_back(source->card.name);
    return names;
}

TEST(Source, IsFiniteAndWithin0And1WhateverTheCoordinates) {
    Random random(1);
    const float odd[] = {0,
                         -0.0F,
                         1,
                         -1,
                         1e30F,
                         -1e30F,
                         1e-40F,
                         std::numeric_limits<float>::infinity(),
                         std::numeric_limits<float>::quiet_NaN(),
                         16777216,
                         0.99999994F};
    ASSERT_EQ(computed().size(), 3U);
    for (const std::string& name : computed())
        for (int round = 0; round < 200; ++round) {
            Sampled s;
            const auto any = [&] { return odd[random.whole(0, 10)]; };
            for (int i = 0; i < kBlockSize; ++i) {
                s.place(i, any(), any(), any(), any());
                s.block->u_y[i] = any();
                s.block->v_x[i] = any();
            }
            s.sample(name.c_str());
            for (int i = 0; i < kBlockSize; ++i)
                ASSERT_TRUE(s.value(i) >= 0 && s.value(i) <= 1) << name << ' ' << s.value(i);
        }
}

TEST(Source, RepeatsWithTheTurnSoThatNoSeamShows) {
    Random random(2);
    for (const std::string& name : computed()) {
        Sampled here, there, edge;
        for (int i = 0; i < kBlockSize; ++i) {
            const double u = random.whole(0, 1023) / 1024.0, v = random.whole(0, 1023) / 1024.0;
            here.place(i, u, v, 0.001, 0.002);
            there.place(i, u + random.whole(-5, 5), v + random.whole(-5, 5), 0.001, 0.002);
            edge.place(i, i % 2 == 0 ? 0 : 1 - 0x1p-24, v);
        }
        here.sample(name.c_str());
        there.sample(name.c_str());
        for (int i = 0; i < kBlockSize; ++i)
            ASSERT_EQ(here.value(i), there.value(i)) << name;
        if (name != "perlin_noise") continue;
        for (int i = 0; i < kBlockSize; ++i) // smooth across the edge
            edge.place(i, i % 2 == 0 ? 0 : 1 - 0x1p-24, (i / 2) / 64.0);
        edge.sample(name.c_str());
        for (int i = 0; i < kBlockSize; i += 2)
            ASSERT_NEAR(edge.value(i), edge.value(i + 1), 1e-4);
    }
}

TEST(Source, GrowsEvenWhereAPixelSpansManyCells) {
    Random random(3);
    for (const auto& [name, mean, left] : {std::tuple{"checker", 0.45, 1e-4},
                                           {"white_noise", 0.5, 1e-3},
                                           {"perlin_noise", 0.5, 0.0}}) {
        Sampled s;
        for (int i = 0; i < kBlockSize; ++i)
            s.place(i, random.unit(), random.unit(), 20.5, 20.5);
        s.sample(name);
        for (int i = 0; i < kBlockSize; ++i)
            ASSERT_NEAR(s.value(i), mean, left) << name;
    }
}

TEST(Checker, IsTheMeanOverThePixelsSpan) {
    Random random(4);
    for (int round = 0; round < 40; ++round) {
        Sampled s;
        struct Box {
            double u, v, wide, high;
        };
        std::vector<Box> boxes;
        for (int i = 0; i < kBlockSize; ++i) {
            const Box b = {random.unit(), random.unit(), std::exp2(random.in(-9, 0)),
                           std::exp2(random.in(-9, 0))};
            boxes.push_back(b);
            s.place(i, b.u, b.v, b.wide, b.high);
            s.block->u_y[i] = static_cast<float>(-b.wide / 2); // the longer step counts
        }
        s.sample("checker");
        for (int i = 0; i < kBlockSize; ++i) {
            const Box& b = boxes[static_cast<std::size_t>(i)];
            const auto wave = [](double from, double to) { // mean of +1 in even squares, -1 in odd
                const auto integral = [](double x) {
                    const double t = x - 2 * std::floor(x / 2);
                    return t < 1 ? t : 2 - t;
                };
                return (integral(to * 8) - integral(from * 8)) / ((to - from) * 8);
            };
            const double mean =
                wave(b.u - b.wide / 2, b.u + b.wide / 2) * wave(b.v - b.high / 2, b.v + b.high / 2);
            ASSERT_NEAR(s.value(i), 0.45 - 0.35 * mean, 3e-4);
        }
    }
}

TEST(WhiteNoise, HasOneValueACellSpreadEvenly) {
    Sampled s;
    std::set<double> values;
    double sum = 0, squares = 0;
    for (int y = 0; y < 64; y += 2) {
        for (int i = 0; i < kBlockSize; ++i)
            s.place(i, (i % 64 + 0.01 + 0.98 * (i / 64)) / 64, (y + 0.5) / 64);
        s.sample("white_noise");
        for (int i = 0; i < 64; ++i) {
            ASSERT_EQ(s.value(i), s.value(i + 64)) << "everywhere in the cell";
            values.insert(s.value(i));
            sum += s.value(i);
            squares += s.value(i) * s.value(i);
        }
    }
    EXPECT_GT(values.size(), 2040U) << "of 2048 cells";
    EXPECT_NEAR(sum / 2048, 0.5, 0.02);
    EXPECT_NEAR(squares / 2048 - sum * sum / 2048 / 2048, 1.0 / 12, 0.01);
}

// As Perlin 2002 has it, at z = 0 on a lattice that repeats.
double reference_noise(double x, double y, int period) {
    const auto p = [](int i) {
        return static_cast<int>(source::kPermutation[static_cast<std::size_t>(i & 255)]);
    };
    const auto fade = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
    const auto lerp = [](double t, double a, double b) { return a + t * (b - a); };
    const auto grad = [](int hash, double gx, double gy, double gz) {
        const int h = hash & 15;
        const double u = h < 8 ? gx : gy, v = h < 4 ? gy : h == 12 || h == 14 ? gx : gz;
        return ((h & 1) == 0 ? u : -u) + ((h & 2) == 0 ? v : -v);
    };
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const int left = x0 & (period - 1), right = (x0 + 1) & (period - 1), below = y0 & (period - 1),
              above = (y0 + 1) & (period - 1);
    x -= x0;
    y -= y0;
    const auto corner = [&](int column, int row) { return p(p(p(column) + row)); };
    return lerp(
        fade(y),
        lerp(fade(x), grad(corner(left, below), x, y, 0), grad(corner(right, below), x - 1, y, 0)),
        lerp(fade(x), grad(corner(left, above), x, y - 1, 0),
             grad(corner(right, above), x - 1, y - 1, 0)));
}

TEST(PerlinNoise, IsTheSumOfFourOctavesOfImprovedNoise) {
    Random random(5);
    double lowest = 1, highest = 0;
    for (int round = 0; round < 300; ++round) {
        Sampled s;
        for (int i = 0; i < kBlockSize; ++i)
            s.place(i, random.unit(), random.unit(), round % 2 == 0 ? 0 : 1 / 48.0);
        s.sample("perlin_noise");
        for (int i = 0; i < kBlockSize; ++i) {
            double sum = 0.5, strength = 0.5;
            for (int period = 8; period <= 64; period *= 2, strength /= 2) {
                // Of 48 pixels a turn, 8 and 16 lumps show, 32 fade, 64 do not.
                const double shown = round % 2 == 0 ? 1
                                     : period < 32  ? 1
                                     : period == 32 ? 2 - 64 / 48.0
                                                    : 0;
                sum += strength * shown *
                       reference_noise(double{s.block->u[i]} * period,
                                       double{s.block->v[i]} * period, period);
            }
            ASSERT_NEAR(s.value(i), std::clamp(sum, 0.0, 1.0), 1e-5);
            lowest = std::min(lowest, s.value(i));
            highest = std::max(highest, s.value(i));
        }
    }
    EXPECT_LT(lowest, 0.2);
    EXPECT_GT(highest, 0.8);
}

} // namespace
} // namespace scanout::shade::test
