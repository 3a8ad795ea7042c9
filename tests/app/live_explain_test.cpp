#include "app/view/live_explain.h"
#include "support/temporary_folder.h"

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

struct Live : ::testing::Test {
    std::unique_ptr<measure::Explainer> explainer() {
        const std::string file = folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        model = *load_model(file, {}, jobs, {});
        frame::FrameOptions options;
        options.width = options.height = 32;
        const scene::View view = *scene::make_view(model.scene.mesh, {}, {}, {}, {}, 32, 32);
        measure::ExplainOptions how;
        how.times = false;
        return *measure::Explainer::create(model.scene, frame::facts(model.scene), view, options,
                                           jobs, how);
    }
    test::TemporaryFolder folder;
    Jobs jobs{1};
    LoadedModel model;
    LiveExplain live;
    PictureKey key = picture_key({}, 1);
};

TEST_F(Live, ExplainsThePictureThatItBeganWithAndNoOther) {
    EXPECT_FALSE(live.explains(key));
    live.begin(explainer(), key);
    EXPECT_TRUE(live.explains(key));
    EXPECT_FALSE(live.explains(picture_key({}, 2))) << "another model";
    Look turned;
    turned.pose.yaw = 1;
    EXPECT_FALSE(live.explains(picture_key(turned, 1)));
    live.stop();
    EXPECT_FALSE(live.explains(key));
    EXPECT_FALSE(live.has_all_rows(key));
}

// Whether the model is about to turn changes nothing of the picture.
TEST_F(Live, TheTurntablesSwitchIsNoPartOfThePicture) {
    Look turning;
    turning.turntable = true;
    EXPECT_EQ(picture_key(turning, 1), key);
}

TEST_F(Live, FiguresComeRowByRowUntilAllAreThere) {
    live.begin(explainer(), key);
    const std::vector<std::string> before = live.page(100, 200, 1).lines;
    int rows = 0;
    for (; !live.has_all_rows(key) && rows < 1000; ++rows)
        live.measure();
    EXPECT_GT(rows, 20);
    EXPECT_LT(rows, 1000);
    EXPECT_NE(live.page(100, 200, 1).lines, before);
    live.begin(explainer(), key);
    EXPECT_FALSE(live.has_all_rows(key)) << "from the beginning";
    EXPECT_EQ(live.page(100, 200, 1).lines, before);
}

} // namespace
} // namespace scanout::app
