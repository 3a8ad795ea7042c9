// The painter's algorithm: what it sorts by, and where a ring of faces is cut.
#include "support/scenes.h"
#include "textbook/models.h"

namespace scanout::textbook::test {
namespace {

// Three squares one behind the other, the nearest first in the file. In an orthographic view all
// have w = 1.
TEST(TextbookPainters, OrthographicFacesAreSortedByTheirDistance) {
    Shot s = scanout::test::shot("squares", 64, 64);
    for (int i = 0; i < 3; ++i) {
        scene::Material m = scanout::test::plain(Vec3(0.05F));
        m.diffuse[i] = 0.8F;
        s.scene.materials.push_back(m);
        const auto k = static_cast<float>(i);
        scanout::test::add_square(s.scene.mesh, 0.2F + 0.2F * k, 0.5F - 0.5F * k, i);
    }
    for (const auto projection :
         {scene::Projection::perspective, scene::Projection::orthographic}) {
        s.camera.projection = projection;
        const image::Image expected = picture(s, with(Hidden::z_pseudo));
        EXPECT_EQ(different_pixels(picture(s, with(Hidden::painters)), expected), 0);
        EXPECT_EQ(different_pixels(picture(s, with(Hidden::painters_ordered)), expected), 0);
        EXPECT_GT(different_pixels(picture(s, with(Hidden::drawing_order)), expected), 200);
    }
}

// A card lies over the low end of a beam, outside of the ring, and its middle is the farthest of
// all. It waits for its beam, and so for the ring: the ring must be cut at a beam.
TEST(TextbookPainters, ARingIsNotCutAtAFaceThatWaitsForIt) {
    Shot s = ring();
    s.scene.materials.push_back(scanout::test::plain(Vec3(0.9F)));
    scanout::test::add_quad(s.scene.mesh,
                            {{{-0.95F, -0.33F, -0.15F},
                              {-0.76F, -0.33F, -0.15F},
                              {-0.76F, -0.18F, -0.15F},
                              {-0.95F, -0.18F, -0.15F}}},
                            {0, 0, 1}, 3);
    const image::Image exact = picture(s), ordered = picture(s, with(Hidden::painters_ordered));
    int of_card = 0, hidden = 0; // the card alone is as bright in red, green and blue
    for (std::size_t i = 0; i < exact.pixels().size(); ++i) {
        const image::Rgba8 &p = exact.pixels()[i], &q = ordered.pixels()[i];
        if (p.r < 100 || p.g < 100 || p.b < 100) continue;
        ++of_card;
        hidden += p == q ? 0 : 1;
    }
    EXPECT_GT(of_card, 20);
    EXPECT_EQ(hidden, 0);
    EXPECT_GT(different_pixels(ordered, exact), 40); // one beam of the ring is still wrong
}

} // namespace
} // namespace scanout::textbook::test
