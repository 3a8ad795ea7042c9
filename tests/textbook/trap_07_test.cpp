// T7 [ClipSpace 6], [SoftwareGraphics note 6], HARD-CASES T7: the denominator of the clip
// parameter.
#include "textbook/clip/clip.h"
#include "textbook/hidden/hidden.h"
#include "textbook/trap_page.h"

#include <bit>
#include <cmath>
#include <limits>

namespace scanout::textbook::test {
namespace {

// Inside by x/w >= -1, as the document has it first; w = 0 counts as outside.
bool naive_inside(const DVec4& v) {
    return v.w != 0 && v.x / v.w >= -1;
}
Polygon naive_clip(const Polygon& polygon) {
    Polygon out;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vertex &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        if (naive_inside(a.clip)) out.push_back(a);
        if (naive_inside(a.clip) == naive_inside(b.clip)) continue;
        const double from = a.clip.x + a.clip.w, to = b.clip.x + b.clip.w;
        out.push_back(mix(a, b, from / (from - to)));
    }
    return out;
}

// The pixels of what is left, where x/w and y/w are numbers.
image::Image drawn(const Polygon& polygon) {
    image::Image out(96, 72, kPaper);
    for_each_of_fan(polygon, [&](const std::array<Vertex, 3>& t) {
        Points p;
        for (std::size_t i = 0; i < 3; ++i)
            p[i] = DVec2((t[i].clip.x / t[i].clip.w + 1) * 48 - 0.5,
                         (1 - t[i].clip.y / t[i].clip.w) * 36 - 0.5);
        for (int y = 0; y < 72; ++y)
            for (int x = 0; x < 96; ++x)
                if (covers(p, x, y)) out.at(x, y) = kInk;
    });
    return out;
}

TEST(Trap07, ByDividedCoordinatesTheClipParameterHasNoDenominatorAndByOursItAlwaysHas) {
    // The document's segment A(-2, y, z, 3)-B(4, y, z, -3): (-2 + 6t)/(3 - 6t) = -1 has no
    // solution.
    const DVec4 a(-2, 0, 0, 3), b(4, 0, 0, -3);
    EXPECT_NE(naive_inside(a), naive_inside(b)); // so it is cut
    EXPECT_EQ((a.x + a.w) - (b.x + b.w), 0);     // by nothing
    const Plane left{DVec4(1, 0, 0, 1), 0};
    EXPECT_GE(left.distance(a), 0); // by x + w >= 0 both are inside: there is no cut
    EXPECT_GE(left.distance(b), 0);

    // For one end at 0 or above and one below, the difference is a number above 0: gradual
    // underflow gives a difference to any two unequal doubles (IEEE 754). So the cut lies on the
    // edge, whatever the distances: y runs along it from 0 to 1.
    Random random(7);
    const Plane by_x{DVec4(1, 0, 0, 0), 0};
    const double limits[] = {0.0, 5e-324, 0x1p-1022, 1, 1e300};
    int cuts = 0;
    for (int i = 0; i < 200000; ++i) {
        double in = std::abs(std::bit_cast<double>(random.bits())),
               out = -std::abs(std::bit_cast<double>(random.bits()));
        if (i % 4 == 0) in = limits[random.whole(0, 4)];
        if (i % 8 == 0) out = -limits[random.whole(1, 4)];
        if (!(in < 1e307) || !(out > -1e307) || out == 0) continue; // no difference, or no cut
        const Polygon cut =
            clip_by_plane({{DVec4(in, 0, 0, 1), {}}, {DVec4(out, 1, 0, 1), {}}}, by_x);
        ASSERT_EQ(cut.size(), 3U) << in << ' ' << out; // the inner end, there and back
        for (const Vertex& v : cut) {
            EXPECT_TRUE(v.clip.y >= 0 && v.clip.y <= 1) << in << ' ' << out;
            EXPECT_TRUE(v.clip.x >= out && v.clip.x <= in) << in << ' ' << out;
        }
        ++cuts;
    }
    EXPECT_GT(cuts, 150000);

    // A triangle with a corner behind the eye.
    const Polygon t = {
        {DVec4(-2, -1, 0, 3), {}}, {DVec4(1.5, -0.5, 0, 2), {}}, {DVec4(4, 3, 0, -3), {}}};
    const Polygon wrong = naive_clip(t);
    int not_numbers = 0;
    for (const Vertex& v : wrong)
        not_numbers += std::isfinite(v.clip.x / v.clip.w) ? 0 : 1;
    EXPECT_GT(not_numbers, 0);
    const Polygon ours = clip_by_plane(clip_by_plane(t, {DVec4(0, 0, 0, 1), -0.1}), left);
    for (const Vertex& v : ours)
        EXPECT_GE(v.clip.x / v.clip.w, -1 - 1e-12);
    EXPECT_GT(different_pixels(drawn(ours), drawn(wrong)), 300);
    check_page(
        {7, "clip-denominator", "A cut that is nowhere",
         "Inside by x/w >= -1, the segment from A(-2, y, z, 3) to B(4, y, z, -3) is to be cut "
         "where (-2 + 6t)/(3 - 6t) = -1, which has no solution, 0/0; by x + w >= 0, behind a "
         "near plane, the two ends of a cut have different signs, and their difference is never "
         "0, in floating point either.",
         "[ClipSpace 6], [SoftwareGraphics]",
         fmt::format("{} of {} corners of the naive cut are no numbers", not_numbers, wrong.size()),
         enlarged(drawn(wrong), 3), enlarged(drawn(ours), 3)});
}

} // namespace
} // namespace scanout::textbook::test
