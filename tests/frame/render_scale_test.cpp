// Render scale: what is enlarged is the picture of the smaller size, and nothing else changes.
#include "frame/render_scale.h"
#include "image/enlarge.h"
#include "rows.h"
#include "support/scenes.h"

namespace scanout::test {
namespace {

// All that a picture may hold: textures, transparency, lines, an outline, other samples.
std::vector<Shot> varied() {
    std::vector<Shot> shots = {textured_cube("cube", "auto"),
                               panes("panes", "exact"),
                               edges("edges"),
                               star("star"),
                               solids("samples"),
                               star("wide"),
                               solids("outline"),
                               solids("clear"),
                               solids("areas")};
    shots[4].options.samples = 4;
    shots[5].options.aa = "gaussian";
    shots[6].options.stencil = "outline";
    shots[7].options.background = {0, 0, 0, 0};
    shots[8].options.aa = "area";
    for (Shot& s : shots) {
        s.options.width = 71; // no multiple of anything
        s.options.height = 50;
    }
    return shots;
}

scene::View view_of(const Shot& s) {
    return *scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {}, s.options.width,
                             s.options.height);
}

TEST(RenderScale, DrawsThePictureOfTheSmallerSizeEnlarged) {
    int pictures = 0;
    for (const frame::RenderScale* scale : frame::render_scale::kRows)
        for (Shot s : varied()) {
            const scene::View view = view_of(s);
            Shot small = s;
            small.options.width = scale->drawn(s.options.width);
            small.options.height = scale->drawn(s.options.height);
            const image::Image drawn = draw(small, view, {});
            image::Image expected(s.options.width, s.options.height);
            Jobs jobs(1);
            image::Enlarger().run(drawn, expected, jobs);
            s.options.render_scale = scale->card.name;
            EXPECT_EQ(draw(s, view, {}), scale->is_full() ? drawn : expected)
                << s.name << " " << scale->card.name;
            EXPECT_EQ(draw(s, view, {.threads = 3, .tile_size = 16}), draw(s, view, {}))
                << s.name << " " << scale->card.name;
            ++pictures;
        }
    EXPECT_EQ(pictures, 9 * 6);
}

TEST(RenderScale, FullIsTheDefaultToTheBit) {
    for (Shot s : varied()) {
        const image::Image automatic = draw(s);
        s.options.render_scale = "full";
        EXPECT_EQ(draw(s), automatic) << s.name;
    }
}

// A filter of the finished picture filters the large one.
TEST(RenderScale, TheFinishedPictureIsFiltered) {
    Shot s = star("star");
    s.options.render_scale = "half";
    image::Image expected = draw(s);
    std::vector<image::Plane> planes;
    frame::FrameOptions& o = s.options;
    o.convolution = "low_pass";
    find_row(image::convolution::kRows, "low_pass")->run(expected, planes);
    EXPECT_EQ(draw(s), expected);
}

TEST(RenderScale, APictureHasAPixelAtLeast) {
    Shot s = solids("tiny");
    s.options.width = s.options.height = 1;
    s.options.render_scale = "quarter";
    const image::Image picture = draw(s);
    EXPECT_EQ(picture.width(), 1);
    EXPECT_EQ(picture.height(), 1);
    EXPECT_EQ(frame::render_scale::two_thirds.drawn(100), 67);
    EXPECT_EQ(frame::render_scale::three_quarters.drawn(4), 3);
    EXPECT_EQ(frame::render_scale::full.drawn(16384), 16384);
}

// The same renderer, from one scale to another and back.
TEST(RenderScale, LeavesNothingBehindInTheRenderer) {
    Shot s = star("star");
    const scene::View view = view_of(s);
    Jobs jobs(2);
    frame::Renderer renderer(jobs);
    for (const char* name : {"full", "half", "full", "quarter", "third", "half", "full"}) {
        s.options.render_scale = name;
        const auto plan = frame::plan(s.options, frame::facts(s.scene), view);
        ASSERT_TRUE(plan);
        EXPECT_EQ(plan->shown_width, s.options.width);
        EXPECT_EQ(plan->is_enlarged(), std::string_view(name) != "full");
        EXPECT_EQ(renderer.render(s.scene, view, *plan), draw(s)) << name;
    }
}

} // namespace
} // namespace scanout::test
