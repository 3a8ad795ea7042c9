// The mean of a pixel's samples is taken in linear light, in a fixed order, and encoded once:
// HARD-CASES row 70, against sums in double over samples that exact arithmetic covers.
#include "oracle/coverage.h"
#include "raster/sample_pattern.h"
#include "support/scenes.h"

#include <cmath>

namespace scanout::test {
namespace {

double decoded(int code) {
    const double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}
double encoded(double linear) { // in codes, not rounded
    const double x = std::min(linear, 1.0);
    return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055);
}

TEST(Resolve, OfEveryPixelIsWithinHalfACodeOfTheMeanInDouble) {
    constexpr int kSide = 64;
    Random random(1);
    double worst = 0, naive_worst = 0;
    int mixed = 0;
    for (int round = 0; round < 40; ++round) {
        const int samples = 2 << round % 4;
        Shot s = shot("resolve", kSide, kSide);
        s.options.samples = samples;
        s.options.background = {static_cast<std::uint8_t>(random.whole(0, 255)), 10, 200, 255};
        scene::Material material = plain(Vec3(1 / scene::kAmbient));
        s.scene.materials = {material};
        // Square to both default lights: ambient light alone, so that colours are what they are.
        const Vec3 unlit{3.0F / 7, 6.0F / 7, -2.0F / 7};
        struct Sheet {
            oracle::ExactTriangle shape;
            Vec3 colour;
        };
        std::vector<Sheet> sheets; // the last one is nearest
        constexpr int kSheets = 25;
        for (int i = 0; i < kSheets; ++i) {
            oracle::Corners v;
            const Vec3 colour(random.unit() < 0.3 ? 1.0 : random.unit(),
                              random.unit() * random.unit(), random.unit());
            std::uint32_t index[3];
            for (std::size_t k = 0; k < 3; ++k) {
                v[k] = {random.whole(-4000, 20000), random.whole(-4000, 20000)};
                index[k] = add_vertex(s.scene.mesh,
                                      {static_cast<float>(v[k].x) / 256,
                                       kSide - static_cast<float>(v[k].y) / 256,
                                       0.2F + 0.02F * static_cast<float>(i)},
                                      unlit);
                s.scene.mesh.colour.push_back(colour);
            }
            add_triangle(s.scene.mesh, index[0], index[1], index[2], 0);
            sheets.push_back({oracle::ExactTriangle(v), colour});
        }
        scene::View view; // mesh x and y are pixels, z is depth
        view.projection = scene::Projection::orthographic;
        view.half_width = view.half_height = kSide / 2.0;
        view.translation = {-kSide / 2.0, -kSide / 2.0, 0};
        const auto plan = frame::plan(s.options, frame::facts(s.scene));
        ASSERT_TRUE(plan);
        Jobs jobs(1);
        frame::Renderer renderer(jobs);
        const image::Image& picture = renderer.render(s.scene, view, *plan);
        const image::Rgba8 b = s.options.background;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                std::array<double, 3> sum{}, codes{};
                bool several = false;
                int first = -2;
                for (const raster::SampleOffset& at : raster::sample_pattern(samples)) {
                    int seen = kSheets - 1;
                    while (seen >= 0 && !sheets[static_cast<std::size_t>(seen)].shape.covers(
                                            x * 256 + at.x, y * 256 + at.y))
                        --seen;
                    several = several || (first != -2 && first != seen);
                    first = seen;
                    const DVec3 back(decoded(b.r), decoded(b.g), decoded(b.b));
                    const DVec3 c =
                        seen < 0 ? back : DVec3(sheets[static_cast<std::size_t>(seen)].colour);
                    for (int k = 0; k < 3; ++k) {
                        sum[static_cast<std::size_t>(k)] += c[k] / samples;
                        codes[static_cast<std::size_t>(k)] += encoded(c[k]) / samples;
                    }
                }
                mixed += several ? 1 : 0;
                const image::Rgba8 p = picture.at(x, y);
                const int got[3] = {p.r, p.g, p.b};
                for (std::size_t k = 0; k < 3; ++k) {
                    worst = std::max(worst, std::abs(got[k] - encoded(sum[k])));
                    naive_worst = std::max(naive_worst, std::abs(codes[k] - encoded(sum[k])));
                }
            }
    }
    EXPECT_LE(worst, 0.5 + 1e-3); // single precision sums move a code's threshold by so much
    EXPECT_GT(mixed, 20000);
    EXPECT_GT(naive_worst, 20); // the mean of codes is another picture
    RecordProperty("worst_codes", testing::PrintToString(worst));
    RecordProperty("naive_mean_of_codes_worst", testing::PrintToString(naive_worst));
    RecordProperty("mixed_pixels", mixed);
}

} // namespace
} // namespace scanout::test
