// That the search for the frontier ends where it should: with the exact rungs of all axes.
#include "accuracy/referenced.h"
#include "measure/frontier.h"

#include <gtest/gtest.h>

namespace scanout {
namespace {

// Beside jagged edges, a square root instead of the exact curve errs less by chance. Once the edges
// are fine, the exact curve is what is left to gain from.
TEST(Frontier, ReachesExactRungsThatErrMoreAlone) {
    test::Shot s = test::shipped("spot/spot.obj", 160, 90);
    s.camera.azimuth_degrees = 150;
    s.camera.elevation_degrees = 20;
    const trace::Reference reference = test::reference_of(s, {.most_samples = 128});
    Jobs jobs(2);
    measure::FrontierOptions how;
    how.axes = {{"aa", "texture", "encode"}};
    how.seconds_a_point = 0.001;
    how.effects = false;
    how.flip = measure::FrontierOptions::Flip::none;
    const auto found = measure::frontier(s.scene, frame::facts(s.scene), test::view_of(s),
                                         s.options, jobs, reference.image, how);
    ASSERT_TRUE(found) << found.error().what;
    double encodings_alone = found->error(0), exact = 1e9;
    for (const measure::Ladder& ladder : found->ladders)
        for (const measure::LadderRung& rung : ladder.rungs)
            if (ladder.axis == "encode")
                encodings_alone = std::min(encodings_alone, found->error(*rung.point));
    ASSERT_LT(encodings_alone, found->error(0)) << "nothing is tested";
    for (const char* aa : {"supersampling_4", "area"})
        exact = std::min(
            exact, found->error(*found->points->at({{"aa", aa}, {"texture", "anisotropic_16"}})));
    EXPECT_LT(found->error(found->frontier.back().point), 1.1 * exact);
}

} // namespace
} // namespace scanout
