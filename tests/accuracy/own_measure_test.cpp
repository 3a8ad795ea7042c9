// The axes' own measures say what their techniques are known for.
#include "accuracy/referenced.h"
#include "measure/own_measure.h"
#include "support/scenes.h"

#include <map>
#include <memory>
#include <string>

namespace scanout::measure {
namespace {

using test::Shot;

// What each rung of an axis measures; those that cannot be measured are missing.
std::map<std::string, double> measured(const Shot& s, const std::string& axis) {
    const scene::View view = test::view_of(s);
    const frame::SceneFacts facts = frame::facts(s.scene);
    const auto plan = frame::plan(without_rungs(s.options), facts, view);
    const auto look = app::look_of(*plan);
    const auto oracle = app::oracle_of(s.scene, view, *look);
    EXPECT_TRUE(plan && look && oracle);
    const trace::Reference reference = test::reference_of(s, {256});
    Jobs jobs(2);
    OwnMeasurer measurer(s.scene, facts, view, jobs, **oracle, reference.image);
    std::map<std::string, double> all;
    for (const std::string& rung : test::names_on(axis)) {
        frame::FrameOptions options = s.options;
        frame::ask(options, axis, rung);
        if (const auto value = measurer.measure(axis, options)) all[rung] = *value;
    }
    return all;
}

// Coverage's errors at edges of any direction, as HARD-CASES L1 has them; the star has more in its
// middle, where wedges are thinner than a pixel.
TEST(OwnMeasure, EdgesAreOffByWhatTheirSamplesLeave) {
    Shot s = test::star("a star");
    s.options.width = s.options.height = 160;
    auto aa = measured(s, "aa");
    for (const auto& [rung, error] :
         {std::pair{"none", 0.249}, std::pair{"samples_2", 0.159}, std::pair{"samples_4", 0.091},
          std::pair{"samples_8", 0.057}, std::pair{"samples_16", 0.044},
          std::pair{"supersampling_2", 0.086}, std::pair{"supersampling_4", 0.030}}) {
        EXPECT_GT(aa.at(rung), 0.95 * error) << rung;
        EXPECT_LT(aa.at(rung), 1.25 * error) << rung;
    }
    EXPECT_LT(aa.at("area"), 1.0 / 256);
}

TEST(OwnMeasure, TextureCoordinatesAreOffByTexels) {
    auto interpolate = measured(test::wall("a wall"), "interpolate");
    EXPECT_LT(interpolate.at("perspective"), 1.0 / 256);
    EXPECT_LT(interpolate.at("adaptive"), 1.0 / 256);
    EXPECT_GT(interpolate.at("affine_8"), 0.1);
    EXPECT_GT(interpolate.at("affine_16"), interpolate.at("affine_8"));
    EXPECT_GT(interpolate.at("affine"), 10 * interpolate.at("affine_16"));
    EXPECT_TRUE(measured(test::star("no texture"), "interpolate").empty());
}

// Where the lamp is hidden or not is no question inside a shadow; without shadows all of that is
// wrong.
TEST(OwnMeasure, ShadowsAreMissingOrWhereNoneShouldBe) {
    auto shadow = measured(test::shadowed("shadows", "auto"), "shadow");
    EXPECT_EQ(shadow.at("volume"), 0);
    EXPECT_LT(shadow.at("map_pcf"), 0.2);
    EXPECT_GT(shadow.at("projected"), 1); // on the floor alone
    EXPECT_GT(shadow.at("attached"), 5);
    shadow = measured(test::cornell_box(64, 60), "shadow");
    EXPECT_LT(shadow.at("map_soft"), 0.5);
}

// Reversed depth errs by what snapping moves the triangles, formats with fewer bits by their steps.
TEST(OwnMeasure, DepthsAreOffByTheStepsOfTheirFormat) {
    auto depth = measured(test::solids("solids"), "depth");
    EXPECT_LT(depth.at("reversed"), 0.1 * depth.at("fixed_24"));
    EXPECT_NEAR(depth.at("float_32"), depth.at("fixed_24"), 0.1 * depth.at("fixed_24"));
    EXPECT_NEAR(depth.at("fixed_16") / depth.at("fixed_24"), 256, 30);
    Shot flat = test::solids("orthographic");
    flat.camera.projection = scene::Projection::orthographic;
    EXPECT_TRUE(measured(flat, "depth").empty());
}

// Rounding to the nearest leaves bands, where all pixels of a square err alike; of 64 thresholds
// the mean of one colour is off by 1/128 at most.
TEST(OwnMeasure, DitherLeavesNoBands) {
    Shot s = test::solids("flat solids");
    s.options.shading = "flat";
    s.options.width = s.options.height = 160;
    auto dither = measured(s, "dither");
    EXPECT_GT(dither.at("none"), 0.1);
    EXPECT_LT(dither.at("bayer"), 1.0 / 128);
}

// What is measured by the pixel's middle is so whatever number of samples the picture has.
TEST(OwnMeasure, IsThereWhateverSamplesAreAskedFor) {
    for (const auto& [axis, shot] :
         {std::pair{"depth", test::solids("solids")}, std::pair{"dither", test::solids("solids")},
          std::pair{"shadow", test::shadowed("shadows", "auto")}}) {
        Shot sampled = shot;
        sampled.options.samples = 4;
        const auto found = measured(shot, axis);
        EXPECT_GE(found.size(), 2U) << axis;
        EXPECT_EQ(measured(sampled, axis), found) << axis;
    }
}

TEST(OwnMeasure, FewerPixelsBlurEdges) {
    auto scale = measured(test::solids("solids"), "render_scale");
    EXPECT_GT(scale.at("quarter"), scale.at("half"));
    EXPECT_GT(scale.at("half"), scale.at("full"));
}

// Inside surfaces, where no edge hides what the axis is about.
TEST(OwnMeasure, InsideSurfacesEdgesDoNotCount) {
    auto shading = measured(test::ball("ball"), "shading");
    EXPECT_LT(shading.at("per_pixel"), 0.5);
    EXPECT_GT(shading.at("per_pixel_raw"), 5);
    EXPECT_GT(shading.at("gouraud"), shading.at("per_pixel_raw"));
    EXPECT_GT(shading.at("flat"), shading.at("gouraud"));
    auto texture = measured(test::noisy_floor("floor", "auto"), "texture");
    EXPECT_LT(texture.at("anisotropic_16"), 5);
    EXPECT_GT(texture.at("trilinear"), 2 * texture.at("anisotropic_16"));
    auto transparency = measured(test::panes("panes", "auto"), "transparency");
    EXPECT_GT(transparency.at("sorted"), 2 * transparency.at("exact"));
    EXPECT_GT(transparency.at("cut_out"), transparency.at("sorted"));
}

// What is measured by the sample is measured at full size, however small the frame is asked for.
TEST(OwnMeasure, ARenderScaleDoesNotChangeWhatIsMeasuredByTheSample) {
    for (const auto& [axis, full] :
         {std::pair{"aa", test::star("edges")}, std::pair{"interpolate", test::wall("texels")},
          std::pair{"shadow", test::shadowed("shadows", "auto")},
          std::pair{"depth", test::solids("depths")}}) {
        Shot half = full;
        half.options.render_scale = "half";
        const auto expected = measured(full, axis);
        EXPECT_FALSE(expected.empty()) << axis;
        EXPECT_EQ(measured(half, axis), expected) << axis;
    }
}

} // namespace
} // namespace scanout::measure
