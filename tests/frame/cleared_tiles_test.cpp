// A renderer leaves tiles alone that show nothing and showed nothing before: whatever it has drawn
// until then, its picture is that of a new one.
#include "file_model.h"

#include <array>

namespace scanout::test {
namespace {

// Somewhere in the picture, or beside it.
FileModel moved(const FileModel& model, Random& random) {
    FileModel m = model;
    m.eye = {random.in(-4, 4), random.in(-4, 4), 12};
    m.target = {random.in(-6, 6), random.in(-6, 6), 0};
    return m;
}

// Most frames as the last one; some in another size, over another background, by what writes beside
// the tiles that show something.
frame::FrameOptions next(frame::FrameOptions options, Random& random) {
    const auto some = [&] { return random.whole(0, 7) == 0; };
    if (some()) options.width = 200 + random.whole(0, 1) * 61;
    if (some()) options.background.r = static_cast<std::uint8_t>(random.whole(0, 1) * 200);
    static constexpr const char* kSmoothing[] = {
        "auto", "auto", "auto", "samples_4", "supersampling_2", "tent", "area"};
    if (some()) options.aa = kSmoothing[random.whole(0, 6)];
    options.convolution = some() ? "high_pass" : "auto";
    options.stencil = some() ? std::array{"outline", "overdraw"}[random.whole(0, 1)] : "auto";
    return options;
}

TEST(ClearedTiles, FramesAreThoseOfANewRenderer) {
    Random random(11);
    const FileModel model = file_soup(random, 60, false);
    Jobs jobs(2);
    frame::Renderer old(jobs);
    frame::FrameOptions options = picture_options(1);
    const scene::Scene scene = model.load();
    const frame::SceneFacts facts = frame::facts(scene);
    int shown = 0;
    for (int i = 0; i < 400; ++i) {
        options = next(options, random);
        const scene::View view =
            moved(model, random).view(scene.mesh, options.width, options.height);
        const auto plan = frame::plan(options, facts, view);
        ASSERT_TRUE(plan) << plan.error().what;
        const int tile_size = random.whole(0, 7) == 0 ? 32 : 64;
        frame::Renderer fresh(jobs);
        const image::Image& expected = fresh.render(scene, view, *plan, nullptr, tile_size);
        ASSERT_TRUE(old.render(scene, view, *plan, nullptr, tile_size) == expected) << i;
        shown += fresh.stats().items_shaded > 0 ? 1 : 0;
    }
    EXPECT_GT(shown, 200);
    EXPECT_LT(shown, 390);
}

} // namespace
} // namespace scanout::test
