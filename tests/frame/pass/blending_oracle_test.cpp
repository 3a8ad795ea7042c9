// Blending against an oracle of its own: at every sample all surfaces sorted by their exact depth,
// composited in double from the back, the mean of the samples in linear light.
#include "oracle/coverage.h"
#include "oracle/plane.h"
#include "raster/screen/sample_pattern.h"
#include "support/scenes.h"
#include "support/srgb_formula.h"

#include <cmath>

namespace scanout::test {
namespace {

constexpr int kOracleSide = 64;

struct Colour {
    DVec3 linear{0}; // times alpha
    double alpha = 0;
};

// Triangles of one colour each, seen along z: mesh x and y are pixels, z is depth.
struct Sheets {
    Shot shot = scanout::test::shot("sheets", kOracleSide, kOracleSide);
    std::vector<oracle::Corners> corners;
    std::vector<oracle::ExactTriangle> shape;
    std::vector<oracle::Three> depth;
    std::vector<DVec3> colour;
    std::vector<double> alpha;

    explicit Sheets(int samples) { shot.options.samples = samples; }
    void add(const oracle::Corners& v, const oracle::Three& z, const Vec3& c, float d) {
        // Square to both default lights: ambient light alone, so that colours are what they are.
        const Vec3 unlit{3.0F / 7, 6.0F / 7, -2.0F / 7};
        geom::Mesh& mesh = shot.scene.mesh;
        std::uint32_t index[3];
        for (std::size_t k = 0; k < 3; ++k) {
            index[k] = add_vertex(mesh,
                                  {static_cast<float>(v[k].x) / 256,
                                   kOracleSide - static_cast<float>(v[k].y) / 256,
                                   static_cast<float>(z[k])},
                                  unlit);
            mesh.colour.push_back(c);
        }
        add_triangle(mesh, index[0], index[1], index[2],
                     static_cast<int>(shot.scene.materials.size()));
        shot.scene.materials.push_back(glass(Vec3(1 / scene::kAmbient), d));
        corners.push_back(v);
        shape.emplace_back(v);
        depth.push_back(z);
        colour.emplace_back(c);
        alpha.push_back(d);
    }
    image::Image picture() const { return draw_in_pixels(shot); }
    // What a sample shows (1/256 pixel). `close`: two depths too near each other to tell.
    Colour at(int x, int y, bool& close) const {
        struct Hit {
            double depth;
            std::size_t sheet;
        };
        std::vector<Hit> hits;
        for (std::size_t i = 0; i < shape.size(); ++i)
            if (shape[i].covers(x, y))
                hits.push_back({oracle::linear_at(corners[i], depth[i], x, y).nearest(), i});
        std::sort(hits.begin(), hits.end(),
                  [](const Hit& a, const Hit& b) { return a.depth < b.depth; });
        const image::Rgba8 b = shot.options.background;
        const double back = b.a / 255.0;
        Colour c{DVec3(decoded(b.r), decoded(b.g), decoded(b.b)) * back, back};
        for (std::size_t k = 0; k < hits.size(); ++k) {
            close |= k > 0 && hits[k].depth - hits[k - 1].depth < 4e-6;
            mix(c, colour[hits[k].sheet], alpha[hits[k].sheet]);
        }
        return c;
    }
    // One more layer in front. Only what is opaque, or over, covers what lies behind.
    void mix(Colour& c, const DVec3& layer, double a) const {
        const std::string& mode = shot.options.blend;
        if (mode == "none") a = 1;
        if (a == 1 || mode == "auto" || mode == "over") {
            c.linear = layer * a + c.linear * (1 - a);
            c.alpha = a + c.alpha * (1 - a);
        } else if (mode == "multiply" || mode == "screen") {
            // Cabanier and Andronikos 2015, 5: Cs = (1 - ab) Cs + ab B(Cb, Cs), then over.
            const DVec3 b = c.alpha > 0 ? c.linear / c.alpha : DVec3(0);
            for (int k = 0; k < 3; ++k) {
                const double mixed =
                    mode == "multiply" ? b[k] * layer[k] : b[k] + layer[k] - b[k] * layer[k];
                const double source = (1 - c.alpha) * layer[k] + c.alpha * mixed;
                c.linear[k] = a * source + (1 - a) * c.linear[k];
            }
            c.alpha = a + c.alpha * (1 - a);
        } else {
            c.linear += layer * (mode == "add" ? a : -a);
        }
    }
};

Sheets random_sheets(Random& random, int samples, int count) {
    Sheets sheets(samples);
    const int back_alpha[] = {255, 0, 100};
    sheets.shot.options.background = {200, 10, static_cast<std::uint8_t>(random.whole(0, 255)),
                                      static_cast<std::uint8_t>(back_alpha[random.whole(0, 2)])};
    for (int i = 0; i < count; ++i) {
        oracle::Corners v;
        oracle::Three z;
        for (std::size_t k = 0; k < 3; ++k) {
            v[k] = {random.whole(-4000, 20000), random.whole(-4000, 20000)};
            z[k] = random.in(0.1, 0.9);
        }
        const Vec3 c(random.unit() < 0.3 ? 1.0 : random.unit(), random.unit() * random.unit(),
                     random.unit());
        const double roll = random.unit();
        sheets.add(v, z, c, roll < 0.15 ? 1.0F : static_cast<float>(random.in(0.02, 0.99)));
    }
    return sheets;
}

class BlendingModes : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(All, BlendingModes,
                         testing::Values("none", "over", "add", "subtract", "multiply", "screen"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST_P(BlendingModes, AreWithinHalfACodeOfTheOracleInEveryPixel) {
    Random random(7);
    double worst = 0, worst_alpha = 0;
    int pixels = 0, left_out = 0;
    for (int round = 0; round < 24; ++round) {
        const int samples = 1 << round % 5;
        Sheets sheets = random_sheets(random, samples, 20);
        sheets.shot.options.blend = GetParam();
        const bool sums = GetParam() == std::string("add") || GetParam() == std::string("subtract");
        if (sums) sheets.shot.options.background.a = 255; // what is added has no alpha
        const image::Image picture = sheets.picture();
        for (int y = 0; y < kOracleSide; ++y) {
            for (int x = 0; x < kOracleSide; ++x) {
                Colour mean;
                bool close = false;
                for (const raster::SampleOffset& at : raster::sample_pattern(samples)) {
                    const Colour c = sheets.at(x * 256 + at.x, y * 256 + at.y, close);
                    mean.linear += c.linear / static_cast<double>(samples);
                    mean.alpha += c.alpha / samples;
                }
                if (close) {
                    ++left_out;
                    continue;
                }
                ++pixels;
                const image::Rgba8 p = picture.at(x, y);
                worst_alpha = std::max(worst_alpha, std::abs(p.a + 0.5 - 255 * mean.alpha));
                if (mean.alpha < 0.01) continue;
                const int got[3] = {p.r, p.g, p.b};
                for (int k = 0; k < 3; ++k)
                    worst = std::max(
                        worst,
                        std::abs(got[k] - encoded(std::max(mean.linear[k] / mean.alpha, 0.0))));
            }
        }
    }
    EXPECT_LE(worst, 0.5 + 2e-3);
    EXPECT_LE(worst_alpha, 0.5 + 1e-3); // rounded down
    EXPECT_GT(pixels, 80000);
    EXPECT_LT(left_out, 5000);
    RecordProperty("worst_codes", testing::PrintToString(worst));
    RecordProperty("left_out", left_out);
}

// HARD-CASES 48.
TEST(Blending, OfTwoHundredAndFiftySixLayersIsWithinACodeOfDouble) {
    Random random(8);
    Sheets sheets(1);
    for (int i = 0; i < 256; ++i)
        sheets.add({{{-100, -100}, {40000, -100}, {-100, 40000}}},
                   {random.in(0.05, 0.9), random.in(0.05, 0.9), random.in(0.05, 0.9)},
                   Vec3(random.unit(), random.unit() * 0.1, random.unit()),
                   static_cast<float>(random.in(0.002, 0.05)));
    const image::Image picture = sheets.picture();
    double worst = 0, worst_of_codes = 0;
    for (int y = 0; y < kOracleSide; ++y) {
        for (int x = 0; x < kOracleSide; ++x) {
            bool close = false;
            const Colour c = sheets.at(x * 256 + 128, y * 256 + 128, close);
            const image::Rgba8 p = picture.at(x, y);
            const int got[3] = {p.r, p.g, p.b};
            for (int k = 0; k < 3; ++k)
                worst = std::max(worst, std::abs(got[k] - encoded(c.linear[k])));
        }
    }
    // What keeping each layer's sum in 8 bits makes of a pixel.
    double code = 200;
    double exact = decoded(200);
    for (int i = 0; i < 256; ++i) {
        const double a = 0.01, c = 0.8;
        exact = c * a + exact * (1 - a);
        code = std::nearbyint(encoded(c * a + decoded(static_cast<int>(code)) * (1 - a)));
    }
    worst_of_codes = std::abs(code - encoded(exact));
    EXPECT_LE(worst, 1);
    EXPECT_GT(worst_of_codes, 2);
    RecordProperty("worst_codes", testing::PrintToString(worst));
}

} // namespace
} // namespace scanout::test
