// The reference in steps is the reference at once, to the bit.
#include "support/meshes.h"
#include "trace/progressive.h"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>
#include <malloc.h>

namespace scanout::trace {
namespace {

using namespace std::chrono_literals;
constexpr auto kAtOnce = Progressive::Time::max();

// A sphere over a floor, with the soft shadow of a lamp: pixels of 16 samples and of thousands, and
// some that are traced once more.
struct Stepwise : ::testing::Test {
    Stepwise() {
        scene.mesh = test::empty_mesh();
        scene.materials = {{}};
        test::add_square(scene.mesh, 1, -0.5F, 0);
        test::add_sphere(scene.mesh, Vec3(0), 0.3F, 32, 16, 0);
        view.projection = scene::Projection::orthographic;
        look.width = 24;
        look.height = 17;
        look.shadows = true;
        scene::Light lamp;
        lamp.frame = scene::LightFrame::camera;
        lamp.towards = DVec3(1, 2, 2) / 3.0;
        lamp.size = 0.2;
        look.lights = {lamp};
    }
    std::unique_ptr<Progressive> make(bool estimate_first, std::uint32_t most = 512) {
        return *Progressive::create(scene, view, look, {most, estimate_first});
    }
    Reference at_once() {
        Jobs jobs(1);
        return *render(scene, view, look, jobs, {}, {512, false});
    }
    scene::Scene scene;
    scene::View view;
    Look look;
};

void expect_same(const Reference& a, const Reference& b) {
    EXPECT_EQ(a.image, b.image);
    EXPECT_EQ(a.light, b.light);
    EXPECT_EQ(a.error, b.error);
    EXPECT_EQ(a.samples, b.samples);
}

TEST_F(Stepwise, AnyCutOfTheWorkGivesTheSamePicture) {
    const Reference whole = at_once();
    EXPECT_GT(whole.samples, 24 * 17 * 17U);
    for (const bool estimate_first : {false, true})
        for (const int threads : {1, 3}) {
            Jobs jobs(threads);
            auto made = make(estimate_first);
            int steps = 0;
            // Each step ends as soon as it may, most of them within a pixel.
            for (; !made->finished() && steps < 1'000'000; ++steps)
                made->step(jobs, Progressive::Time::min());
            EXPECT_GT(steps, 1000);
            expect_same(made->take(), whole);
        }
}

TEST_F(Stepwise, AnEstimateOfEachPixelComesBeforeTheHardOnes) {
    Jobs jobs(2);
    auto made = make(true);
    EXPECT_EQ(made->share(), 0);
    const auto pixels_known = [&](Known least) {
        int count = 0;
        for (int pixel = 0; pixel < 24 * 17; ++pixel)
            count += made->known(pixel) >= least ? 1 : 0;
        return count;
    };
    double share = 0;
    while (pixels_known(Known::estimate) < 24 * 17) {
        made->step(jobs, Progressive::Time::min());
        EXPECT_GE(made->share(), share);
        share = made->share();
    }
    const int settled = pixels_known(Known::final);
    EXPECT_GT(settled, 24 * 17 / 4);
    EXPECT_LT(settled, 24 * 17);
    const image::Image estimate = made->image();
    made->step(jobs, kAtOnce);
    EXPECT_TRUE(made->finished());
    EXPECT_EQ(made->share(), 1);
    EXPECT_NE(made->image(), estimate);
    EXPECT_EQ(made->image(), at_once().image);
}

// What is known early is spread over the picture.
TEST_F(Stepwise, EachEighthOfTheRowsIsSeenInTheFirstQuarterOfTheWork) {
    look.height = 64;
    Jobs jobs(1);
    auto made = make(true);
    const auto rows_known = [&] {
        std::vector<int> rows;
        for (int y = 0; y < 64; ++y)
            if (made->known(y * 24) != Known::nothing) rows.push_back(y);
        return rows;
    };
    while (rows_known().size() < 16)
        made->step(jobs, Progressive::Time::min());
    const std::vector<int> rows = rows_known();
    for (std::size_t i = 1; i < rows.size(); ++i)
        EXPECT_LE(rows[i] - rows[i - 1], 8);
    EXPECT_GE(rows.back(), 64 - 8);
}

TEST_F(Stepwise, AStepEndsSoonAfterItsTime) {
    look.width = look.height = 400;
    Jobs jobs(2);
    auto made = make(false, kMostSamples);
    auto longest = 0ns;
    for (int i = 0; i < 50; ++i) {
        const auto until = std::chrono::steady_clock::now() + 2ms;
        made->step(jobs, until);
        longest =
            std::max<std::chrono::nanoseconds>(longest, std::chrono::steady_clock::now() - until);
    }
    EXPECT_FALSE(made->finished());
    EXPECT_LT(longest, 500ms) << "a busy machine; the picture takes longer by far";
}

TEST_F(Stepwise, ALateStepBeginsNoWorkOfTheNextStage) {
    scene.mesh = test::empty_mesh(); // each pixel is settled by its first samples
    Jobs jobs(1);
    auto made = make(true);
    const auto settled = [&] {
        for (int pixel = 0; pixel < 24 * 17; ++pixel)
            if (made->known(pixel) != Known::final) return false;
        return true;
    };
    while (!settled())
        made->step(jobs, Progressive::Time::min());
    int stages = 0;
    for (; !made->finished(); ++stages)
        made->step(jobs, Progressive::Time::min());
    EXPECT_EQ(stages, 2) << "to settle, and once more beside hard ones: none has pixels";
}

TEST_F(Stepwise, TakesTheMemoryThatItSays) {
    look.width = 1000;
    look.height = 500;
    const auto held = [] {
        const struct mallinfo2 info = mallinfo2();
        return info.uordblks + info.hblkhd;
    };
    const auto taken_by = [&](const auto& make_one) {
        const std::size_t before = held();
        const auto made = make_one();
        return static_cast<double>(held() - before);
    };
    const auto reference = [&] { return make(false); };
    reference(); // what is made once
    const double in_all = taken_by(reference);
    // Large pages round it up.
    const double picture = taken_by([&] { return image::Image(1000, 500); });
    look.width = look.height = 1;
    const double hierarchy = taken_by(reference);
    if (in_all == 0) GTEST_SKIP() << "this malloc does not count";
    const double taken = in_all - picture - hierarchy + 4 * 1000 * 500;
    EXPECT_NEAR(static_cast<double>(Progressive::bytes(1000, 500)), taken, 0.02 * taken);
}

TEST_F(Stepwise, IsCancelledWhileTheHierarchyIsBuilt) {
    const std::atomic<bool> cancelled = true;
    const auto made = Progressive::create(scene, view, look, {}, &cancelled);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().exit, Exit::usage);
}

} // namespace
} // namespace scanout::trace
