// T18 [Compendium 9.4]: a picture that is drawn where the display reads it, in a model of a
// monitor. That the viewer's display never writes what is shown,
// tests/platform/kms_display_test.cpp holds on a card in memory; here is why.
#include "support/scenes.h"
#include "textbook/trap_page.h"

#include <algorithm>
#include <functional>

namespace scanout::textbook::test {
namespace {

constexpr int kLines = 72, kRefreshes = 40;

// A monitor reads a line of the shown buffer a tick, over and over. The drawer writes `writes`
// lines a tick, frame after frame, and calls done() after each.
struct Machine {
    std::vector<image::Image> frames; // to be drawn, over and over
    double writes = 1.7;
    int written = 0; // lines of the frame that is being drawn

    // What the monitor showed, refresh by refresh. `write`: where a line goes; `shown`: what is
    // read.
    std::vector<image::Image> run(const std::function<image::Image&()>& write,
                                  const std::function<const image::Image&()>& shown,
                                  const std::function<bool()>& done,
                                  const std::function<void()>& blank) {
        std::vector<image::Image> seen;
        double line = 0;
        std::size_t frame = 0;
        bool waits = false;
        for (int refresh = 0; refresh < kRefreshes; ++refresh) {
            image::Image picture(96, kLines);
            for (int y = 0; y < kLines; ++y) {
                for (line += waits ? 0 : writes; !waits && line >= 1; line -= 1) {
                    const int at = written++;
                    copy_line(frames[frame % frames.size()], write(), at);
                    if (written < kLines) continue;
                    written = 0;
                    ++frame;
                    waits = done();
                }
                copy_line(shown(), picture, y);
            }
            blank();
            waits = false;
            seen.push_back(std::move(picture));
        }
        return seen;
    }

    static void copy_line(const image::Image& from, image::Image& to, int y) {
        for (int x = 0; x < from.width(); ++x)
            to.at(x, y) = from.at(x, y);
    }
};

TEST(Trap18, OneBufferShowsPartsOfTwoFramesAndTwoBuffersNever) {
    std::vector<image::Image> frames;
    for (const double azimuth : {0.0, 25.0, 50.0}) {
        Shot s = scanout::test::textured_cube("cube", "nearest");
        s.options.width = 96;
        s.options.height = kLines;
        s.camera.azimuth_degrees = azimuth;
        frames.push_back(scanout::test::draw(s));
    }
    const auto torn = [&](const std::vector<image::Image>& seen) {
        std::vector<image::Image> bad;
        for (std::size_t i = 3; i < seen.size(); ++i) { // after the first ones, which begin empty
            bool whole = false;
            for (const image::Image& frame : frames)
                whole = whole || different_pixels(seen[i], frame) == 0;
            if (!whole) bad.push_back(seen[i]);
        }
        return bad;
    };
    image::Image single(96, kLines);
    const auto naive = torn(Machine{frames}.run([&]() -> image::Image& { return single; },
                                                [&]() -> const image::Image& { return single; },
                                                [] { return false; }, [] {}));
    // A finished frame waits for the blank between two refreshes, then the buffers change places.
    image::Image buffers[2] = {image::Image(96, kLines), image::Image(96, kLines)};
    int front = 0;
    bool finished = false;
    const auto flipped = torn(Machine{frames}.run(
        [&]() -> image::Image& { return buffers[1 - front]; },
        [&]() -> const image::Image& { return buffers[front]; }, [&] { return finished = true; },
        [&] {
            if (finished) front = 1 - front;
            finished = false;
        }));
    // Copied when it is done, without a look at the monitor: the copy tears as well.
    image::Image back(96, kLines), copied(96, kLines);
    const auto untimed = torn(Machine{frames}.run([&]() -> image::Image& { return back; },
                                                  [&]() -> const image::Image& { return copied; },
                                                  [&] {
                                                      copied = back;
                                                      return false;
                                                  },
                                                  [] {}));
    EXPECT_GT(naive.size(), 12U);
    EXPECT_GT(untimed.size(), 12U);
    EXPECT_EQ(flipped.size(), 0U);
    ASSERT_FALSE(naive.empty());
    // The one that is least like any frame.
    std::size_t shown = 0;
    int most = 0;
    for (std::size_t i = 0; i < naive.size(); ++i) {
        int least = 96 * kLines;
        for (const image::Image& frame : frames)
            least = std::min(least, different_pixels(naive[i], frame));
        if (least > most) {
            most = least;
            shown = i;
        }
    }
    check_page(
        {18, "tearing", "Drawn while it is read",
         "Where the picture is drawn into the memory that the monitor reads, a refresh shows "
         "parts of two frames, and so it does where a finished frame is copied at any time; two "
         "buffers that change places between two refreshes show whole frames alone. The pictures "
         "are those of a model, a monitor that reads a line a tick and a drawer that writes 1.7: "
         "on a card in memory, `tests/platform/kms_display_test.cpp` holds the viewer to it.",
         "[Compendium 9.4]",
         fmt::format("{} of {} refreshes are torn with one buffer, {} with a copy at any time, "
                     "{} with a flip",
                     naive.size(), kRefreshes - 3, untimed.size(), flipped.size()),
         enlarged(naive[shown], 3), enlarged(frames[0], 3)});
}

} // namespace
} // namespace scanout::textbook::test
