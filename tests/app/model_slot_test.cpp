#include "app/view/model_slot.h"
#include "support/temporary_folder.h"

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

struct ModelOnShow : ::testing::Test {
    LoadedModel triangle() {
        const std::string file = folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        return *load_model(file, {}, jobs, {});
    }
    test::TemporaryFolder folder;
    Jobs jobs{1};
    ModelSlot slot;
};

TEST_F(ModelOnShow, IsEmptyWithoutAnErrorAtFirst) {
    EXPECT_EQ(slot.model(), nullptr);
    EXPECT_EQ(slot.mesh(), nullptr);
    EXPECT_EQ(slot.error(), "");
    EXPECT_FALSE(slot.has_held_model());
}

TEST_F(ModelOnShow, AnErrorTakesTheModelsPlaceAndAModelTheErrors) {
    slot.put(triangle(), {});
    ASSERT_NE(slot.model(), nullptr);
    EXPECT_EQ(slot.mesh(), &slot.model()->scene.mesh);
    const int of_model = slot.generation();
    slot.put_error("t.obj:1: what");
    EXPECT_EQ(slot.model(), nullptr);
    EXPECT_EQ(slot.mesh(), nullptr);
    EXPECT_EQ(slot.error(), "t.obj:1: what");
    EXPECT_NE(slot.generation(), of_model);
    EXPECT_TRUE(slot.has_held_model()) << "once";
    const int of_error = slot.generation();
    slot.put(triangle(), {});
    EXPECT_EQ(slot.error(), "");
    EXPECT_NE(slot.generation(), of_error) << "the same file again is another picture";
}

TEST_F(ModelOnShow, PlansAreOfTheModelThatItHolds) {
    LoadedModel model = triangle();
    slot.put(triangle(), {});
    const scene::View view = *scene::make_view(*slot.mesh(), {}, {}, {}, {}, 32, 32);
    frame::FrameOptions options;
    options.width = options.height = 32;
    const frame::FramePlan expected = *frame::plan(options, frame::facts(model.scene), view);
    EXPECT_EQ((*slot.plan(options, view))->decisions, expected.decisions);
}

} // namespace
} // namespace scanout::app
