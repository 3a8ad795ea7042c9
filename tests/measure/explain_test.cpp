#include "image/compare.h"
#include "image/flip.h"
#include "measure/explain.h"
#include "measure/median.h"
#include "shade/resolve/reconstruction_filter.h"
#include "support/scenes.h"

#include <gmock/gmock.h>

namespace scanout::measure {
namespace {

using test::Shot;

ExplainOptions without_times() {
    ExplainOptions how;
    how.times = false;
    return how;
}

Explanation explained(const Shot& s, const ExplainOptions& how = without_times()) {
    const auto view = scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {}, s.options.width,
                                       s.options.height);
    Jobs jobs(2);
    auto result = explain(s.scene, *view, s.options, jobs, how);
    EXPECT_TRUE(result) << (result ? "" : result.error().what);
    return result.value_or(Explanation());
}

const EffectRow& row(const Explanation& e, std::string_view effect) {
    for (const EffectRow& found : e.rows)
        if (found.decision.effect == effect) return found;
    static const EffectRow none;
    ADD_FAILURE() << "no row " << effect;
    return none;
}

// Three materials side by side: textured, glossy, plain; a fifth of the picture each.
Shot stripes() {
    Shot s = test::shot("stripes", 50, 50);
    s.scene.materials = {test::textured(0), test::plain(Vec3(0.5F), Vec3(0.5F), 2),
                         test::plain(Vec3(0.5F))};
    s.scene.textures = {test::checkers()};
    for (int i = 0; i < 3; ++i) {
        const float left = -1 + 0.4F * static_cast<float>(i);
        test::add_quad(s.scene.mesh,
                       {{{left, -1, 0}, {left + 0.4F, -1, 0}, {left + 0.4F, 1, 0}, {left, 1, 0}}},
                       {0, 0, 1}, i);
    }
    for (Vec2& uv : s.scene.mesh.uv)
        uv = {uv.x * 20, uv.y * 20}; // far more texels than pixels
    s.camera.projection = scene::Projection::orthographic;
    s.options.cull = frame::Cull::back; // open, but seen from its front
    return s;
}

// On a display of 5 and 6 bits the pictures are those that it shows.
TEST(Explain, ComparesWhatTheDisplayShows) {
    Shot s = test::glossy("ball", "lambert");
    ExplainOptions how = without_times();
    EXPECT_FALSE(row(explained(s, how), "dither").change);
    const auto narrow = image::pixel_format("rgb565");
    ASSERT_TRUE(narrow);
    how.display = *narrow;
    s.options.bits = image::min_bits(*narrow);
    const image::Image picture = test::draw(s);
    const Explanation e = explained(s, how);
    const EffectRow& dither = row(e, "dither");
    EXPECT_EQ(dither.decision.technique, "bayer");
    EXPECT_THAT(dither.decision.because, testing::HasSubstr("5 bits"));
    EXPECT_EQ(dither.compared_with, "none");
    const image::Difference d =
        image::compare(image::as_displayed(*narrow, picture),
                       image::as_displayed(*narrow, image::without_dither(*narrow, picture)));
    ASSERT_TRUE(dither.change);
    EXPECT_GT(d.differing_pixels, 100);
    EXPECT_EQ(dither.change->pixels, d.differing_pixels);
    EXPECT_EQ(dither.change->largest_code, d.max_difference);
    // A step of the display is 8 codes: no other row is told in finer ones.
    EXPECT_GE(row(e, "directional_light").change->largest_code, 8);
    s.options.dither = "none";
    const Explanation plain = explained(s, how);
    EXPECT_EQ(row(plain, "dither").change->pixels, d.differing_pixels);
    EXPECT_EQ(row(plain, "dither").compared_with, "bayer");
}

TEST(Explain, HasARowForEveryEffectOfThePlanAsThePlanDecidedIt) {
    const Shot s = stripes();
    const Explanation e = explained(s);
    const auto view = scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {}, 50, 50);
    ASSERT_TRUE(view);
    const auto plan = frame::plan(s.options, frame::facts(s.scene), *view);
    ASSERT_EQ(e.rows.size(), plan->decisions.size());
    for (std::size_t i = 0; i < e.rows.size(); ++i)
        EXPECT_EQ(e.rows[i].decision, plan->decisions[i]);
    EXPECT_EQ(e.techniques, plan->techniques);
    EXPECT_EQ(e.width, 50);
    EXPECT_FALSE(e.cost);
}

TEST(Explain, CountsThePixelsWhoseSurfaceCallsForAnEffect) {
    Shot s = stripes();
    const Explanation e = explained(s);
    const auto view = scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {}, 50, 50);
    ASSERT_TRUE(view);
    // Counted by hand from the ids: two triangles a stripe.
    frame::Visibility visible;
    test::draw(s, {.visibility = &visible});
    const auto share = [&](std::uint32_t first) {
        return static_cast<double>(std::count_if(
                   visible.id.begin(), visible.id.end(),
                   [&](std::uint32_t id) { return id == first || id == first + 1; })) /
               2500;
    };
    ASSERT_GT(share(0), 0.05);
    ASSERT_GT(share(2), 0.05);
    EXPECT_DOUBLE_EQ(*row(e, "texture").pixel_share, share(0));
    EXPECT_DOUBLE_EQ(*row(e, "highlight").pixel_share, share(2));
    EXPECT_DOUBLE_EQ(e.covered_share, share(0) + share(2) + share(4));
    EXPECT_FALSE(row(e, "vertex_colours").pixel_share) << "no matter of the material";
    // What is hidden is not counted: a plain wall in front of everything.
    s.scene.materials.push_back(test::plain(Vec3(1)));
    test::add_quad(s.scene.mesh, {{{-2, -2, 1}, {2, -2, 1}, {2, 2, 1}, {-2, 2, 1}}}, {0, 0, 1}, 3);
    EXPECT_EQ(*row(explained(s), "texture").pixel_share, 0);
}

TEST(Explain, CountsPixelsAlikeHoweverTheyAreSampled) {
    Shot s = stripes();
    const Explanation once = explained(s);
    for (const char* aa : {"samples_8", "supersampling_2", "tent", "gaussian", "area"}) {
        s.options.aa = aa;
        const Explanation e = explained(s);
        EXPECT_DOUBLE_EQ(e.covered_share, once.covered_share) << aa;
        EXPECT_DOUBLE_EQ(*row(e, "texture").pixel_share, *row(once, "texture").pixel_share) << aa;
    }
}

TEST(Explain, SaysWhatChangesWhenAnEffectIsSwitched) {
    const Shot s = stripes();
    const image::Image whole = test::draw(s);
    const Explanation e = explained(s);
    for (const EffectRow& r : e.rows) {
        if (r.decision.choice) continue;
        Shot other = s;
        other.options.effects[r.decision.effect] = !r.decision.on();
        const image::Difference d = image::compare(whole, test::draw(other));
        ASSERT_TRUE(r.change) << r.decision.effect;
        EXPECT_EQ(r.change->pixels, d.differing_pixels) << r.decision.effect;
        EXPECT_EQ(r.change->largest_code, d.max_difference) << r.decision.effect;
        EXPECT_EQ(r.change->pixels > 0, r.decision.on()) << r.decision.effect;
        EXPECT_EQ(r.change->mean_flip, image::mean_flip(whole, test::draw(other)));
        EXPECT_EQ(r.change->mean_flip > 0, r.decision.on()) << r.decision.effect;
    }
    EXPECT_GT(row(e, "texture").change->largest_code, 50);
    EXPECT_GT(row(e, "highlight").change->largest_code, 5);
}

TEST(Explain, ComparesAnAxisThatHasNoOffWithItsCheapestTechnique) {
    Shot s = test::solids("balls");
    Explanation e = explained(s);
    EXPECT_EQ(row(e, "shading").compared_with, "flat");
    Shot flat = s;
    flat.options.shading = "flat";
    ASSERT_TRUE(row(e, "shading").change);
    EXPECT_EQ(row(e, "shading").change->pixels,
              image::compare(test::draw(s), test::draw(flat)).differing_pixels);
    EXPECT_GT(row(e, "shading").change->pixels, 100);
    EXPECT_FALSE(row(e, "tone").change) << "nothing is less";
    EXPECT_EQ(row(e, "tone").compared_with, "");
}

// Of a rung that the user names what counts is how far it is from what would be drawn without.
TEST(Explain, ComparesATechniqueThatTheUserNamesWithTheAutomaticOne) {
    Shot s = test::solids("balls");
    const image::Image whole = test::draw(s);
    const struct {
        const char *axis, *technique, *automatic;
        bool differs;
    } rows[] = {
        {"shading", "flat", "per_pixel", true},  {"shading", "gouraud", "per_pixel", true},
        {"depth_test", "greater", "less", true}, {"stencil", "outline", "none", true},
        {"tone", "filmic", "clamp", true},       {"convolution", "low_pass", "off", true},
        {"encode", "power_2_2", "srgb", true},   {"interpolate", "affine", "perspective", true},
        {"cull", "back", "none", false},         {"cull", "front", "none", true}};
    for (const auto& asked : rows) {
        SCOPED_TRACE(std::string(asked.axis) + " " + asked.technique);
        Shot other = s;
        ASSERT_TRUE(frame::ask(other.options, asked.axis, asked.technique));
        const EffectRow found = row(explained(other), asked.axis);
        EXPECT_EQ(found.decision.technique, asked.technique);
        EXPECT_EQ(found.compared_with, asked.automatic);
        ASSERT_TRUE(found.change);
        const image::Difference d = image::compare(test::draw(other), whole);
        EXPECT_EQ(found.change->pixels, d.differing_pixels);
        EXPECT_EQ(found.change->largest_code, d.max_difference);
        EXPECT_EQ(found.change->pixels > 0, asked.differs);
    }
}

TEST(Explain, SaysOfAnEffectWhatItsAutomaticTechniqueWouldChange) {
    Shot s = stripes();
    const image::Image whole = test::draw(s);
    EXPECT_FALSE(row(explained(s), "texture").automatic);
    s.options.texture = "nearest";
    ExplainOptions how;
    how.seconds_a_row = 0;
    const EffectRow texture = row(explained(s, how), "texture");
    ASSERT_TRUE(texture.automatic);
    EXPECT_EQ(texture.automatic->technique, "trilinear");
    EXPECT_TRUE(texture.automatic->price);
    const image::Difference d = image::compare(test::draw(s), whole);
    EXPECT_EQ(texture.automatic->change.pixels, d.differing_pixels);
    EXPECT_GT(d.differing_pixels, 100);
    EXPECT_EQ(texture.compared_with, "") << "the columns say what it changes to have none";
    s.options.texture = "trilinear"; // what it would have been
    EXPECT_FALSE(row(explained(s), "texture").automatic);
    s.options.effects = {{"texture", false}};
    s.options.texture = "nearest";
    EXPECT_FALSE(row(explained(s), "texture").automatic) << "none runs";
}

TEST(Explain, AForcedRowIsSwitchedBackToWhatTheSceneCallsFor) {
    Shot s = stripes();
    const image::Image whole = test::draw(s);
    s.options.effects = {{"texture", false}};
    const Explanation e = explained(s);
    EXPECT_TRUE(row(e, "texture").decision.forced);
    EXPECT_EQ(row(e, "texture").change->pixels,
              image::compare(whole, test::draw(s)).differing_pixels);
    EXPECT_EQ(row(e, "texture").bytes, 0U);
}

TEST(Explain, CountsTheBytesOfWhatRunsAndNoneOfWhatDoesNot) {
    const Shot s = stripes();
    const Explanation e = explained(s);
    EXPECT_EQ(row(e, "texture").bytes, s.scene.textures[0].image.pixels().size_bytes());
    for (const EffectRow& r : e.rows)
        EXPECT_TRUE(r.decision.on() || r.bytes == 0) << r.decision.effect;
    Shot unused = s; // a texture that no triangle shows holds nothing
    unused.scene.textures.push_back(test::checkers());
    unused.scene.materials.push_back(test::textured(1));
    EXPECT_EQ(row(explained(unused), "texture").bytes, row(e, "texture").bytes);
}

TEST(Explain, CountsTheListsOfWhatIsBlendedAndTheSameOnAnyThreads) {
    // One pane before the whole picture: a fragment a pixel, in the longest list 64 x 64 of them.
    Shot s = test::shot("pane", 100, 100);
    s.scene.materials = {test::plain(Vec3(0.5F))};
    s.scene.materials[0].opacity = 0.5F;
    test::add_quad(s.scene.mesh, {{{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}}}, {0, 0, 1}, 0);
    s.camera.projection = scene::Projection::orthographic;
    const Explanation one = explained(s);
    EXPECT_GT(row(one, "blending").bytes, 64U * 64 * (sizeof(shade::BlendFragment) + 4));
    EXPECT_LT(row(one, "blending").bytes, 2 * 64U * 64 * (sizeof(shade::BlendFragment) + 4));
    for (int threads = 1; threads <= 3; ++threads) {
        frame::FrameStats stats;
        test::draw(s, {.threads = threads, .stats = &stats});
        EXPECT_EQ(stats.blend_list_bytes, row(one, "blending").bytes) << threads;
    }
    // Twice as many panes, twice as many fragments with their depths.
    const std::uint64_t before = row(one, "blending").bytes;
    test::add_quad(s.scene.mesh, {{{-9, -9, 1}, {9, -9, 1}, {9, 9, 1}, {-9, 9, 1}}}, {0, 0, 1}, 0);
    EXPECT_GT(row(explained(s), "blending").bytes, before * 9 / 5);
    s.scene.materials[0].opacity = 1;
    EXPECT_EQ(row(explained(s), "blending").bytes, 0U);
}

TEST(Explain, CountsWhatWideFiltersAndConvolutionsHold) {
    Shot s = stripes();
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(s.options.width) * static_cast<std::uint64_t>(s.options.height);
    EXPECT_EQ(row(explained(s), "aa").bytes, 0U);
    EXPECT_EQ(row(explained(s), "convolution").bytes, 0U);
    s.options.aa = "tent";
    // A colour and its share, and the place of its parts; these are more by the length of edges.
    const std::uint64_t held = row(explained(s), "aa").bytes;
    EXPECT_GE(held, pixels * 20);
    EXPECT_LT(held, pixels * 20 + pixels / 2 * sizeof(shade::FilterSplat));
    for (int threads = 1; threads <= 3; ++threads) {
        frame::FrameStats stats;
        test::draw(s, {.threads = threads, .stats = &stats});
        EXPECT_EQ(stats.splat_bytes, held) << threads;
    }
    s.options.aa = "auto";
    for (const auto& [name, planes] : {std::pair("low_pass", 5), {"high_pass", 5}}) {
        s.options.convolution = name; // four channels of doubles and one more, or three and two
        EXPECT_EQ(row(explained(s), "convolution").bytes,
                  pixels * static_cast<std::uint64_t>(planes) * 8);
    }
}

TEST(Explain, APlainSceneHasNothingSpecial) {
    EXPECT_EQ(explained(test::solids("plain")).special, 0);
    EXPECT_EQ(explained(stripes()).special, 3);
}

TEST(Explain, MeasuresTimesAndTellsHowFarItIs) {
    std::vector<double> shares;
    ExplainOptions how;
    how.seconds_a_row = 0;
    how.progress = [&](double share) { shares.push_back(share); };
    const Explanation e = explained(stripes(), how);
    EXPECT_GE(shares.size(), e.rows.size());
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_GE(shares.front(), 0);
    EXPECT_LT(shares.back(), 1);
    ASSERT_TRUE(e.cost);
    EXPECT_GT(e.cost->wall_ms, 0);
    EXPECT_GT(e.cost->cpu_ms, 0);
    EXPECT_EQ(e.cost->instructions.has_value(), counts_instructions());
    for (const EffectRow& r : e.rows)
        EXPECT_EQ(r.price.has_value(), r.change.has_value()) << r.decision.effect;
}

// Whatever is forced on where nothing calls for it, and runs nothing: by construction it takes no
// time. What is on runs something.
TEST(Explain, TimesNoPlanThatDoesTheSameWork) {
    ExplainOptions how;
    how.seconds_a_row = 0;
    const Explanation e = explained(stripes(), how);
    for (const char* effect : {"texture", "highlight", "shading"}) {
        ASSERT_TRUE(row(e, effect).price) << effect;
        EXPECT_FALSE(row(e, effect).price->by_construction) << effect;
        EXPECT_GE(row(e, effect).price->pairs, kLeastPairs) << effect;
    }
    int same = 0;
    for (const EffectRow& r : e.rows) {
        if (!r.price || !r.price->by_construction) continue;
        ++same;
        EXPECT_EQ(r.price->pairs, 0U) << r.decision.effect;
        EXPECT_EQ(r.change->pixels, 0) << r.decision.effect;
    }
    EXPECT_GT(same, 5);
}

TEST(Explain, FailsLikeThePlan) {
    Shot s = stripes();
    s.options.texture = "fog";
    const auto view = scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {}, 50, 50);
    Jobs jobs(1);
    const auto result = explain(s.scene, *view, s.options, jobs);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().exit, Exit::usage);
}

TEST(Median, IsTheLowerMiddleValue) {
    EXPECT_EQ(median({}), 0);
    EXPECT_EQ(median({4}), 4);
    EXPECT_EQ(median({9, 1, 5}), 5);
    EXPECT_EQ(median({9, 1, 5, 7}), 5);
}

} // namespace
} // namespace scanout::measure
