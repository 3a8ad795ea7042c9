// The mean of a pixel's samples is taken in linear light, in a fixed order, and encoded once:
// HARD-CASES 70, against sums in double over samples that exact arithmetic covers.
#include "oracle/coverage.h"
#include "raster/screen/sample_pattern.h"
#include "support/scenes.h"
#include "support/srgb_formula.h"

#include <cmath>
#include <set>

namespace scanout::test {
namespace {

constexpr int kResolvedSide = 64, kSheets = 25;

// Triangles of one colour each, one behind the other; the last is nearest.
struct ResolvedSheets {
    Shot shot = scanout::test::shot("resolve", kResolvedSide, kResolvedSide);
    std::vector<oracle::ExactTriangle> shape;
    std::vector<DVec3> colour;

    ResolvedSheets(Random& random, int samples) {
        shot.options.samples = samples;
        shot.options.background = {static_cast<std::uint8_t>(random.whole(0, 255)), 10, 200, 255};
        shot.scene.materials = {plain(Vec3(1 / scene::kAmbient))};
        // Square to both default lights: ambient light alone, so that colours are what they are.
        const Vec3 unlit{3.0F / 7, 6.0F / 7, -2.0F / 7};
        geom::Mesh& mesh = shot.scene.mesh;
        for (int i = 0; i < kSheets; ++i) {
            oracle::Corners v;
            const Vec3 c(random.unit() < 0.3 ? 1.0 : random.unit(), random.unit() * random.unit(),
                         random.unit());
            std::uint32_t index[3];
            for (std::size_t k = 0; k < 3; ++k) {
                v[k] = {random.whole(-4000, 20000), random.whole(-4000, 20000)};
                index[k] = add_vertex(mesh,
                                      {static_cast<float>(v[k].x) / 256,
                                       kResolvedSide - static_cast<float>(v[k].y) / 256,
                                       0.2F + 0.02F * static_cast<float>(i)},
                                      unlit);
                mesh.colour.push_back(c);
            }
            add_triangle(mesh, index[0], index[1], index[2], 0);
            shape.emplace_back(v);
            colour.emplace_back(c);
        }
    }
    image::Image picture() const { return draw_in_pixels(shot); }
    // The sheet that is seen at a point (1/256 pixel); -1: the background.
    int seen(int x, int y) const {
        int i = kSheets - 1;
        while (i >= 0 && !shape[static_cast<std::size_t>(i)].covers(x, y))
            --i;
        return i;
    }
    DVec3 linear(int sheet) const {
        const image::Rgba8 b = shot.options.background;
        return sheet < 0 ? DVec3(decoded(b.r), decoded(b.g), decoded(b.b))
                         : colour[static_cast<std::size_t>(sheet)];
    }
};

TEST(Resolve, OfEveryPixelIsWithinHalfACodeOfTheMeanInDouble) {
    Random random(1);
    double worst = 0, naive_worst = 0;
    int mixed = 0;
    for (int round = 0; round < 40; ++round) {
        const int samples = 2 << round % 4;
        const ResolvedSheets sheets(random, samples);
        const image::Image picture = sheets.picture();
        for (int y = 0; y < kResolvedSide; ++y)
            for (int x = 0; x < kResolvedSide; ++x) {
                DVec3 mean(0), mean_of_codes(0);
                std::set<int> seen;
                for (const raster::SampleOffset& at : raster::sample_pattern(samples)) {
                    const int sheet = sheets.seen(x * 256 + at.x, y * 256 + at.y);
                    const DVec3 c = sheets.linear(sheet);
                    mean += c / static_cast<double>(samples);
                    mean_of_codes += DVec3(encoded(c.x), encoded(c.y), encoded(c.z)) /
                                     static_cast<double>(samples);
                    seen.insert(sheet);
                }
                mixed += seen.size() > 1 ? 1 : 0;
                const image::Rgba8 p = picture.at(x, y);
                const int got[3] = {p.r, p.g, p.b};
                for (int k = 0; k < 3; ++k) {
                    worst = std::max(worst, std::abs(got[k] - encoded(mean[k])));
                    naive_worst =
                        std::max(naive_worst, std::abs(mean_of_codes[k] - encoded(mean[k])));
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
