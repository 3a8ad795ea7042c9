#include "app/overlay/overlay_text.h"
#include "support/temporary_folder.h"

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

struct Words : ::testing::Test {
    Words() {
        const std::string file = folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        settings.arguments = {file, "other.obj"};
        slot.put(*load_model(file, {}, jobs, {}), settings.frame);
    }
    Viewer viewer_after(std::initializer_list<ActionId> actions) {
        Viewer viewer(settings, 640, 480, 2);
        for (const ActionId id : actions)
            viewer.apply({id, {}, {}, false}, slot.mesh());
        return viewer;
    }
    test::TemporaryFolder folder;
    Settings settings;
    Jobs jobs{1};
    ModelSlot slot;
    const KeyMap keys = KeyMap::standard();
};

TEST_F(Words, NothingOpenIsNothingSaid) {
    EXPECT_EQ(overlay_text(viewer_after({}), slot, settings, "", keys), Overlay());
}

TEST_F(Words, InformationNamesFileCountsAndState) {
    const Overlay overlay = overlay_text(
        viewer_after({ActionId::toggle_info, ActionId::toggle_drive}), slot, settings, "", keys);
    EXPECT_EQ(overlay.info, (std::vector<std::string>{
                                "t.obj  (1 of 2)", "1 triangles  3 vertices  0 warnings  640x480",
                                "perspective  up y  cull material  camera mode"}));
    EXPECT_TRUE(overlay.help.empty());
}

TEST_F(Words, AnErrorStandsInTheMiddleAndNoCountsAreThere) {
    slot.put_error("other.obj: no such file");
    const Overlay overlay =
        overlay_text(viewer_after({ActionId::toggle_info}), slot, settings, "", keys);
    EXPECT_EQ(overlay.notice, std::vector<std::string>{"other.obj: no such file"});
    EXPECT_EQ(overlay.info.size(), 2U);
}

TEST_F(Words, AMessageComesBeforeTheLineOfTheLight) {
    const Viewer viewer = viewer_after({ActionId::light_next});
    EXPECT_NE(overlay_text(viewer, slot, settings, "", keys).message, "");
    EXPECT_EQ(overlay_text(viewer, slot, settings, "wrote a.png", keys).message, "wrote a.png");
}

TEST_F(Words, FiguresOfAFrameStandOnlyInOpenBlocksAndOnlyWhereTimesMay) {
    Overlay closed, open;
    open.info = {"t.obj"};
    open.explain = {"plan"};
    Overlay steady = open;
    add_frame_text(closed, {});
    EXPECT_EQ(closed, Overlay());
    add_frame_text(open, {});
    EXPECT_EQ(open.info.size(), 2U);
    EXPECT_EQ(open.explain.size(), 2U);
    add_frame_text(steady, {{}, false, 0, {}});
    EXPECT_EQ(steady.info.size(), 1U);
    EXPECT_EQ(steady.explain.size(), 1U);
}

TEST_F(Words, AModelOutOfViewIsSaidUnlessThereIsAMessage) {
    Overlay silent, talking;
    talking.message = "wrote a.png";
    for (Overlay* overlay : {&silent, &talking})
        add_frame_text(*overlay, {frame::Blank::outside, true, 0, {}});
    EXPECT_EQ(silent.message, "model out of view: press R");
    EXPECT_EQ(talking.message, "wrote a.png");
}

TEST_F(Words, AFrameOfFewerPixelsSaysItsScale) {
    Overlay open;
    open.info = {"t.obj"};
    FrameFacts frame;
    frame.render_scale = "half";
    add_frame_text(open, frame);
    EXPECT_EQ(open.info.back(), "0.0 ms  0 fps  render scale half");
}

} // namespace
} // namespace scanout::app
