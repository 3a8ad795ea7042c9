// While a model is turned in the viewer, nothing is allocated between a frame and the next: plan,
// picture, what lies on it, and the way onto the display.
#include "app/moving/motion_file.h"
#include "app/view/view_session.h"
#include "port/headless.h"
#include "support/allocations.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#ifndef SCANOUT_SANITIZED

namespace scanout::app {
namespace {

constexpr std::size_t kFrames = 400;

// Notes what has been allocated whenever a frame comes.
class CountingDisplay final : public port::Display {
public:
    CountingDisplay() : display_(*port::HeadlessDisplay::create(160, 120, {})) {
        counts_.reserve(2 * kFrames);
    }
    const port::DisplayInfo& info() const override { return display_.info(); }
    bool ready() const override { return display_.ready(); }
    Result<void> present(const image::Image& frame, std::span<const image::Rect> damage) override {
        counts_.push_back(test::allocations);
        return display_.present(frame, damage);
    }
    bool paced() const override { return display_.paced(); }
    int event_fd() const override { return display_.event_fd(); }
    Result<void> dispatch() override { return display_.dispatch(); }
    bool lost() const override { return display_.lost(); }

    const std::vector<std::size_t>& counts() const { return counts_; }

private:
    port::HeadlessDisplay display_;
    std::vector<std::size_t> counts_;
};

class NoInput final : public port::Input {
public:
    int event_fd() const override { return -1; }
    Result<void> dispatch(std::vector<port::Event>&) override { return {}; }
    std::string description() const override { return "none"; }
};

std::vector<std::size_t> counts_of(const Settings& settings, const std::string& step) {
    std::string text = "scanout-actions 1\n";
    for (std::size_t i = 0; i < kFrames; ++i)
        text += "+1 " + step + "\n";
    CountingDisplay display;
    NoInput input;
    Jobs jobs(1);
    const Script script = *parse_script(text + "+1 quit\n", "script");
    auto session = ViewSession::create(settings, {display, input, jobs, {}, {}, script, true});
    EXPECT_TRUE((*session)->run());
    return display.counts();
}

Settings spot() {
    Settings settings;
    settings.arguments = {SCANOUT_SOURCE_DIR "/models/spot/spot.obj"};
    settings.replay = "script";
    settings.quiet = true;
    return settings;
}

// The most frames in a row between which nothing was.
std::size_t longest_rest(const std::vector<std::size_t>& counts) {
    std::size_t longest = 0, rest = 0;
    for (std::size_t i = 1; i < counts.size(); ++i) {
        rest = counts[i] == counts[i - 1] ? rest + 1 : 0;
        longest = std::max(longest, rest);
    }
    return longest;
}

// Buffers grow to what the fullest frame needs, which frame after frame asks for other parts of
// the model: so there is a late one that grows them again. But whatever every frame did would leave
// no hundred frames in a row.
TEST(SteadySession, ATurnedModelAllocatesNothing) {
    scene::Light sun;
    sun.towards = {-1, 2, 1};
    for (const char* const step : {"repeat rotate_left", "repeat roll_left"}) { // keys are held
        for (const bool shadows : {false, true}) {
            Settings settings = spot();
            if (shadows) settings.frame.lights = {sun};
            const auto counts = counts_of(settings, step);
            ASSERT_GE(counts.size(), kFrames) << step;
            EXPECT_GE(longest_rest(counts), 100U) << step << (shadows ? ", with shadows" : "");
            EXPECT_GT(counts[1] - counts[0], 0U) << "the first are seen to allocate";
        }
    }
}

// Model and camera are moved by tracks of every kind; lights would have the frame planned anew.
TEST(SteadySession, AMotionThatPlaysAllocatesNothing) {
    Settings settings = spot();
    Warnings warnings;
    settings.motion = parse_motion(R"(
end = "loop"
[model.turn]
keys = [{ time = 0, value = [0, 0, 0, 1] }, { time = 1, value = [0, 1, 0, 0] },
        { time = 2, value = [0, 0, 0, -1] }]
[model.translate]
by = "spline"
keys = [{ time = 0, value = [0, 0, 0] }, { time = 1, value = [0, 0.2, 0] },
        { time = 2, value = [0, 0, 0] }]
[model.scale]
by = "hermite"
keys = [{ time = 0, value = 1 }, { time = 2, value = 1, in = [1, 1, 1] }]
[camera.azimuth]
ease = "in-out"
keys = [{ time = 0, value = 0 }, { time = 2, value = 40 }]
)",
                                   "motion", settings.camera, settings.frame.lights, warnings)
                          .value();
    const auto counts = counts_of(settings, "pointer 5 5");
    ASSERT_GE(counts.size(), kFrames);
    EXPECT_GE(longest_rest(counts), 100U);
}

} // namespace
} // namespace scanout::app

#endif
