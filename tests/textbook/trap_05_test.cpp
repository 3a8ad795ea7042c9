// T5 [Compendium 6.1], [Course 4.3.1], [Primer 5.3.1]: faces that overlap in a ring, or cross.
#include "textbook/trap_page.h"

namespace scanout::textbook::test {
namespace {

// Two squares through each other.
Shot cross() {
    Shot s = scanout::test::shot("cross", 96, 72);
    s.scene.materials = {scanout::test::plain({0.8F, 0.1F, 0.05F}),
                         scanout::test::plain({0.1F, 0.6F, 0.2F})};
    for (const float side : {-1.0F, 1.0F})
        scanout::test::add_quad(s.scene.mesh,
                                {{{-0.7F, -0.6F, -0.4F * side},
                                  {0.7F, -0.6F, 0.4F * side},
                                  {0.7F, 0.6F, 0.4F * side},
                                  {-0.7F, 0.6F, -0.4F * side}}},
                                {0, 0, 1}, side < 0 ? 0 : 1);
    return s;
}

TEST(Trap05, NoOrderOfFacesIsRightWhereTheyOverlapInARingOrCross) {
    int wrong_of_ring = 0;
    for (const Shot& s : {ring(), cross()}) {
        const image::Image production = scanout::test::draw(s);
        const image::Image exact = picture(s, with(Hidden::z_pseudo));
        for (const Hidden hidden :
             {Hidden::painters, Hidden::painters_ordered, Hidden::drawing_order}) {
            const int wrong = different_pixels(picture(s, with(hidden)), exact, 8);
            EXPECT_GT(wrong, 40) << s.name << ' ' << static_cast<int>(hidden);
            if (s.name == "ring" && hidden == Hidden::painters) wrong_of_ring = wrong;
        }
        EXPECT_EQ(different_pixels(picture(s, with(Hidden::warnock)), exact), 0);
        EXPECT_LT(different_pixels(exact, production, 8), 12) << s.name;
    }
    check_page(
        {5, "painters-ring", "A ring of faces",
         "The painter's algorithm draws whole faces from far to near: where three lie over each "
         "other in a ring, or two cross, no order is right; a depth a pixel is.",
         "[Compendium 6.1], [Course 4.3.1]",
         fmt::format("{} of {} pixels show the wrong beam", wrong_of_ring, 96 * 72),
         enlarged(picture(ring(), with(Hidden::painters)), 3),
         enlarged(scanout::test::draw(ring()), 3)});
}

} // namespace
} // namespace scanout::textbook::test
