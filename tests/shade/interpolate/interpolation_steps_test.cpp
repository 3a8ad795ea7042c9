// Interpolation that divides seldom, against the exact weights in double: the ladder of
// HARD-CASES L3, independence of runs, and the bound that adaptive interpolation keeps.
#include "shade/block.h"
#include "shade/setup/interpolation_step.h"

#include <cmath>
#include <map>

namespace scanout::shade::test {
namespace {

constexpr int kScreenWidth = 512; // pixels

// A triangle on the screen by its corners in 1/256 pixel and the inverse of their distances.
Primitive triangle(const DVec2 (&p)[3], const double (&inverse_w)[3]) {
    Primitive t{};
    double area = 0;
    for (int k = 0; k < 3; ++k) {
        const DVec2 &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
        t.a[k] = a.y - b.y;
        t.b[k] = b.x - a.x;
        t.c[k] = a.x * b.y - a.y * b.x;
        t.least[k] = 0;
        t.inverse_w[k] = static_cast<float>(inverse_w[k]);
        area += t.c[k];
    }
    if (area < 0)
        for (int k = 0; k < 3; ++k) {
            t.a[k] = -t.a[k];
            t.b[k] = -t.b[k];
            t.c[k] = -t.c[k];
        }
    return t;
}

double exact(const Primitive& t, double x, double y, const float (&f)[3]) {
    double top = 0, bottom = 0;
    for (int k = 0; k < 3; ++k) {
        const double weight = (t.a[k] * x + t.b[k] * y + t.c[k]) * double{t.inverse_w[k]};
        top += weight * double{f[k]};
        bottom += weight;
    }
    return top / bottom;
}

// u of `count` pixels from pixel x on in row y, in one block, cut into runs of the given lengths.
class Row {
public:
    Row() : block_(new_block(material_)) {
        texture_.image = image::Image(4, 4);
        frame_ = identity_frame();
        frame_.attributes = {.uv = true, .maps = bit_of(kDiffuseMap)};
    }
    std::vector<float> u(const std::string& name, const Primitive& t, int x, int y, int count,
                         int piece = kBlockSize) {
        std::vector<float> result;
        for (int done = 0; done < count; done += kBlockSize) {
            ShadingBlock& b = *block_;
            b.count = std::min(kBlockSize, count - done);
            b.lit = true;
            b.map[kDiffuseMap].texture = &texture_;
            b.runs = 0;
            for (int first = 0; first < b.count; first += piece)
                b.run[b.runs++] = {&t, first, std::min(piece, b.count - first)};
            for (int i = 0; i < kPaddedBlock; ++i) {
                b.x[i] = (x + done + i) * 256 + 128;
                b.y[i] = y * 256 + 128;
            }
            run(name);
            result.insert(result.end(), b.u, b.u + b.count);
        }
        return result;
    }

private:
    // On every target, to the same bits. (run_stage() takes one run a block.)
    void run(const std::string& name) {
        std::vector<float> first;
        scanout::test::on_every_target([&](const std::string&) {
            std::fill_n(block_->u, kPaddedBlock, 77.0F);
            stage("interpolate", name).run(*block_, frame_);
            const std::vector<float> u(block_->u, block_->u + block_->count);
            if (first.empty()) first = u;
            EXPECT_EQ(u, first) << name;
        });
    }

    scene::Material material_;
    scene::Texture texture_;
    std::unique_ptr<ShadingBlock> block_;
    FrameState frame_;
};

TEST(InterpolationSteps, HaveTheErrorsOfTheLadder) {
    const double ratios[] = {1.1, 2, 10, 1000};
    const std::map<std::string, std::array<double, 4>> ladder = {
        {"affine", {0.024, 0.17, 0.52, 0.94}},
        {"affine_16", {2.7e-5, 4.7e-4, 0.015, 0.68}},
        {"affine_8", {6.7e-6, 1.2e-4, 4.5e-3, 0.56}},
        {"perspective", {3e-7, 3e-7, 3e-7, 3e-7}}};
    Row row;
    for (const auto& [name, errors] : ladder)
        for (std::size_t i = 0; i < 4; ++i) {
            // From left to right the distance grows by the ratio; the row lies on one edge.
            Primitive t =
                triangle({{0, 128}, {kScreenWidth * 256, 128}, {0, 60000}}, {1, 1 / ratios[i], 1});
            t.uv[0][0] = 0;
            t.uv[0][1] = 1;
            t.uv[0][2] = 0;
            const std::vector<float> got = row.u(name, t, 0, 0, kScreenWidth);
            double worst = 0;
            for (int x = 0; x < kScreenWidth; ++x)
                worst = std::max(worst, std::abs(double{got[static_cast<std::size_t>(x)]} -
                                                 exact(t, x * 256 + 128, 128, t.uv[0])));
            EXPECT_LE(worst, errors[i] * 1.05) << name << " at " << ratios[i];
            if (name != "perspective") {
                EXPECT_GE(worst, errors[i] * 0.8) << name << " at " << ratios[i];
            }
        }
}

Primitive random_primitive(Random& random, double ratio) {
    DVec2 p[3];
    double area = 0;
    do {
        for (DVec2& corner : p)
            corner = {static_cast<double>(random.whole(-20000, 150000)),
                      static_cast<double>(random.whole(-20000, 150000))};
        area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
    } while (std::abs(area) < 1e8);
    double inverse_w[3] = {1, 1 / std::pow(ratio, random.unit()), 1 / ratio};
    std::swap(inverse_w[0], inverse_w[random.whole(0, 2)]);
    Primitive t = triangle(p, inverse_w);
    for (auto& component : t.uv)
        for (float& f : component)
            f = static_cast<float>(random.in(-1, 2));
    return t;
}

// The pixels of row y that the triangle covers: first, and how many.
std::pair<int, int> covered(const Primitive& t, int y) {
    int first = 0, count = 0;
    for (int x = -100; x < 600; ++x) {
        bool inside = true;
        for (int k = 0; k < 3; ++k)
            inside = inside && t.a[k] * (x * 256 + 128) + t.b[k] * (y * 256 + 128) + t.c[k] >= 0;
        if (!inside) continue;
        if (count++ == 0) first = x;
    }
    return {first, count};
}

TEST(InterpolationSteps, DoNotDependOnWhereRunsEnd) {
    Random random(3);
    Row row;
    int rows = 0;
    for (int round = 0; round < 40; ++round) {
        Primitive t = random_primitive(random, std::exp2(random.in(0, 10)));
        const int y = random.whole(0, 500);
        const auto [first, count] = covered(t, y);
        if (count < 3) continue;
        ++rows;
        for (const char* name : {"affine", "affine_16", "affine_8"}) {
            const std::vector<float> whole = row.u(name, t, first, y, count);
            for (const int piece : {1, 7, 16, 37})
                ASSERT_EQ(row.u(name, t, first, y, count, piece), whole) << name;
            const int skip = count / 3; // as in another tile
            const std::vector<float> later = row.u(name, t, first + skip, y, count - skip);
            ASSERT_TRUE(std::equal(later.begin(), later.end(), whole.begin() + skip)) << name;
        }
    }
    EXPECT_GT(rows, 15);
}

TEST(InterpolationSteps, ThatAreChosenKeepTheBoundAndAreTheCheapestRungs) {
    Random random(4);
    Row row;
    std::map<int, int> chosen;
    double closest = 0;
    for (int round = 0; round < 400; ++round) {
        Primitive t = random_primitive(random, 1 + std::exp2(random.in(-14, 6)));
        StepLimits limits;
        limits.attributes.uv = true;
        limits.uv = 1.0 / 256 / std::exp2(random.in(0, 8)); // 1/256 texel of 1 to 256 a unit
        t.step = step_for(t, limits);
        ++chosen[t.step];
        const int y = random.whole(0, 500);
        const auto [first, count] = covered(t, y);
        if (count == 0) continue;
        const std::vector<float> got = row.u("adaptive", t, first, y, count);
        double worst = 0;
        for (int x = 0; x < count; ++x)
            worst = std::max(worst,
                             std::abs(double{got[static_cast<std::size_t>(x)]} -
                                      exact(t, (first + x) * 256 + 128, y * 256 + 128, t.uv[0])));
        ASSERT_LE(worst, limits.uv) << "step " << int{t.step};
        closest = std::max(closest, worst / limits.uv);
    }
    for (const int step : {0, 8, 16, int{kAffine}})
        EXPECT_GT(chosen[step], 5) << step;
    EXPECT_GT(closest, 0.5); // the bound is no waste
}

TEST(InterpolationSteps, OfEqualDistancesAreNoneAndOfUncertainNormalsAll) {
    Random random(5);
    StepLimits limits;
    limits.attributes = {.normal = true, .uv = true, .colour = true, .ray = true, .position = true};
    for (int round = 0; round < 50; ++round) {
        Primitive t = random_primitive(random, 1);
        EXPECT_EQ(step_for(t, limits), kAffine); // limits of 0: it is exact
        t.inverse_w[0] = 0.5F;
        EXPECT_EQ(step_for(t, limits), 0);
        t.clipped = true;
        t.inverse_w[0] = 1;
        EXPECT_EQ(step_for(t, limits), 0); // has no areas on the screen
    }
    Primitive t = random_primitive(random, 1.01);
    limits = {};
    limits.attributes.normal = true;
    limits.normal = 1;
    for (int k = 0; k < 3; ++k)
        t.normal[2][k] = 1;
    EXPECT_EQ(step_for(t, limits), kAffine);
    t.normal[2][0] = -1; // their mean may vanish
    EXPECT_EQ(step_for(t, limits), 0);
}

} // namespace
} // namespace scanout::shade::test
