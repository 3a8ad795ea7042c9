// T3 [Compendium 11.4], HARD-CASES T3: values stepped from a vertex that lies between two lines.
#include "support/scenes.h"
#include "textbook/interpolation/interpolation.h"
#include "textbook/trap_page.h"

#include <algorithm>

namespace scanout::textbook::test {
namespace {

// The largest t of a triangle whose t is 0 at its top and 1 at its bottom.
double largest_t(InterpolationMethod method) {
    Triangle t;
    t.corner[0] = {10.5, 1.4, 0, 1, {0}};
    t.corner[1] = {4.5, 9.6, 0, 1, {1}};
    t.corner[2] = {20.5, 9.6, 0, 1, {1}};
    double most = 0;
    const Interpolator values = method(t);
    fill_flat_halves(points_of(t), [&](int y, int x0, int x1) {
        values(y, x0, x1, [&](int, int, const Values& v) { most = std::max(most, v[0]); });
    });
    return most;
}

TEST(Trap03, StepsFromAVertexPassOneAndStepsFromAPixelCentreDoNot) {
    EXPECT_GT(largest_t(interpolate_spans_from_vertex), 1.05);
    EXPECT_LE(largest_t(interpolate_spans_perspective), 1);
    record("t", largest_t(interpolate_spans_from_vertex));

    Shot s = scanout::test::textured_cube("cube", "nearest");
    s.options.width = 96;
    s.options.height = 72;
    Parts naive;
    naive.fill = Fill::flat_halves;
    naive.interpolation = Interpolation::spans_from_vertex;
    Parts cured;
    cured.interpolation = Interpolation::spans_perspective;
    const image::Image ours = scanout::test::draw(s), wrong = picture(s, naive);
    const int spoilt = different_pixels(wrong, ours, 8);
    EXPECT_LT(different_pixels(picture(s, cured), ours, 8), 20);
    EXPECT_GT(spoilt, 150);
    check_page(
        {3, "attribute-overshoot", "A step past the end",
         "A value that is stepped from line to line, from a vertex that lies between two, is "
         "late by a part of a step everywhere and passes the edge's end on the last line, t > "
         "1: spikes and shifted textures; the document clamps t, the cure is to begin at the "
         "first pixel centre.",
         "[Compendium 11.4]",
         fmt::format("t reaches {:.4f}; {} of {} pixels differ by more than 8 codes",
                     largest_t(interpolate_spans_from_vertex), spoilt, 96 * 72),
         enlarged(wrong, 3), enlarged(ours, 3)});
}

} // namespace
} // namespace scanout::textbook::test
