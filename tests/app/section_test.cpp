// --section, and the keys that cut the model on show.
#include "app/options/command_line.h"
#include "app/view/viewer.h"
#include "session_fixture.h"

#include <sstream>

#include <xkbcommon/xkbcommon-keysyms.h>

namespace scanout::app {
namespace {

using SectionInView = Session;

Result<CommandLine> parsed(const std::string& options) {
    std::istringstream stream("render a.obj -o a.png " + options);
    return parse_command_line({std::istream_iterator<std::string>(stream), {}});
}

TEST(SectionOption, ReadsAxesAndPlanes) {
    const std::optional<scene::SectionSpec> low = parsed("--section -z:0.25")->settings.section;
    ASSERT_TRUE(low);
    EXPECT_EQ(to_string(*low), "-z:0.25");
    EXPECT_TRUE(low->low);
    const std::optional<scene::SectionSpec> plane =
        parsed("--section 1,0,-2.5,4")->settings.section;
    ASSERT_TRUE(plane);
    EXPECT_EQ(to_string(*plane), "1,0,-2.5,4");
    EXPECT_FALSE(parsed("--section x:0.5 --section none")->settings.section);
    for (const char* wrong :
         {"w:0.5", "x", "x:", "x:1.5", "x:-0.1", "-:0.5", "0,0,0,1", "1,2,3", "xy:0.5", "x:0.5:1"})
        EXPECT_FALSE(parsed(std::string("--section ") + wrong)) << wrong;
}

TEST_F(SectionInView, KeysShowWhatTheOptionShows) {
    settings.frame.background = {10, 20, 30, 255};
    settings.camera.azimuth_degrees = 30;
    const std::string file = folder.file("cut.png");
    port::HeadlessDisplay display = make_display();
    ASSERT_TRUE(play("section_next\nsection_down\n+1 repeat section_down\n+1 frame " + file + "\n",
                     display));
    const image::Image seen = *image::load(file);
    settings.section = scene::SectionSpec{.axis = scene::SectionAxis::x, .share = 0.46};
    EXPECT_TRUE(seen == rendered({}));
    settings.section.reset();
    EXPECT_FALSE(seen == rendered({}));
}

TEST_F(SectionInView, GoesThroughTheAxesToNoneAndIsUndone) {
    const LoadedModel model = *load_model(settings.arguments.front(), settings, jobs, {});
    Viewer viewer(settings, width, height, 1);
    const auto after = [&](ActionId id, std::array<int, 3> numbers = {}) {
        viewer.apply({id, numbers, {}, false}, &model.scene.mesh);
        const auto& section = viewer.state().look.section;
        return section ? to_string(*section) : "none";
    };
    EXPECT_EQ(after(ActionId::section_up), "none");
    EXPECT_EQ(viewer.answer(), "no section to slide: J makes one");
    EXPECT_EQ(after(ActionId::section_next), "x:0.5");
    EXPECT_EQ(viewer.answer(), "section: x:0.5");
    EXPECT_EQ(after(ActionId::section_up), "x:0.52");
    EXPECT_EQ(after(ActionId::slide_section, {-16, 0, 0}), "x:0.48");
    EXPECT_EQ(after(ActionId::section_flip), "-x:0.48");
    EXPECT_EQ(after(ActionId::undo), "x:0.48");
    EXPECT_EQ(after(ActionId::section_next), "y:0.5");
    EXPECT_EQ(after(ActionId::section_next), "z:0.5");
    EXPECT_EQ(after(ActionId::section_next), "none");
    EXPECT_EQ(after(ActionId::undo), "z:0.5");
    EXPECT_EQ(after(ActionId::reset), "none");
}

TEST_F(SectionInView, ThePrintedCommandHasIt) {
    port::HeadlessDisplay display = make_display();
    TimedInput input({{20ms, {press('j')}}, {20ms, {press('k')}}, {20ms, {quit()}}});
    auto session = ViewSession::create(settings, {display, input, jobs, {}, {}, {}, false});
    ASSERT_TRUE(session);
    ASSERT_TRUE((*session)->run());
    ASSERT_EQ((*session)->noted_commands().size(), 1U);
    EXPECT_NE((*session)->noted_commands()[0].find(" --section x:0.5 "), std::string::npos)
        << (*session)->noted_commands()[0];
}

TEST_F(SectionInView, TheCameraStaysWhereTheWholeModelFits) {
    const LoadedModel whole = *load_model(settings.arguments.front(), settings, jobs, {});
    settings.section = scene::SectionSpec{.axis = scene::SectionAxis::y, .share = 0.1};
    const LoadedModel cut = *load_model(settings.arguments.front(), settings, jobs, {});
    EXPECT_EQ(fitted_camera_of(settings, cut).distance, fitted_camera_of(settings, whole).distance);
    EXPECT_LT(cut.scene.mesh.box_max.y, 1.1);
    EXPECT_EQ(cut.scene.mesh.radius, whole.scene.mesh.radius);
}

TEST_F(SectionInView, AWarningNamesTheModelThatIsNotCut) {
    settings.section = scene::SectionSpec{.axis = scene::SectionAxis::y, .share = 1};
    const LoadedModel model = *load_model(settings.arguments.front(), settings, jobs, {});
    ASSERT_EQ(model.warnings.size(), 1U);
    EXPECT_EQ(model.warnings[0], settings.arguments.front() +
                                     ": --section y:1 changes nothing: nothing of the model "
                                     "lies in front of it");
    EXPECT_EQ(model.scene.materials.size(), 0U);
}

// --colour and --opacity stand for what the file says of materials.
TEST_F(SectionInView, ColourAndOpacityReplaceTheMaterials) {
    folder.write("two.mtl", "newmtl a\nKd 1 0 0\nd 0.5\nnewmtl b\nKd 0 1 0\n");
    const std::string file =
        folder.write("two.obj", "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n"
                                "usemtl a\nf 1 2 3\nusemtl b\nf 2 4 3\n");
    Settings of = parsed("--colour 255,0,128 --opacity 0.25")->settings;
    const LoadedModel model = *load_model(file, of, jobs, {});
    for (const scene::Material& material : model.scene.materials) {
        EXPECT_EQ(material.diffuse.x, 1);
        EXPECT_EQ(material.diffuse.y, 0);
        EXPECT_NEAR(material.diffuse.z, 0.2158F, 1e-4);
        EXPECT_EQ(material.opacity, 0.25F);
    }
    EXPECT_EQ(model.scene.unnamed.opacity, 0.25F);
    const LoadedModel kept = *load_model(file, parsed("--opacity auto")->settings, jobs, {});
    EXPECT_EQ(kept.scene.materials[0].opacity, 0.5F);
    EXPECT_EQ(kept.scene.materials[0].diffuse, Vec3(1, 0, 0));
    EXPECT_TRUE(parsed("--colour #ff0080")->settings.colour == of.colour);
    for (const char* wrong :
         {"--colour 1,2", "--colour 256,0,0", "--colour 0.5,0,0", "--opacity 2", "--opacity x"})
        EXPECT_FALSE(parsed(wrong)) << wrong;
}

TEST_F(SectionInView, OpacityTakesACutOfTheFileAway) {
    const std::string file = folder.write(
        "cut.gltf",
        R"({"asset":{"version":"2.0"},"accessors":[{"componentType":5126,"type":"VEC3","count":3}],)"
        R"("materials":[{"alphaMode":"MASK"}],"nodes":[{"mesh":0}],"meshes":[{"primitives":)"
        R"([{"attributes":{"POSITION":0},"material":0}]}]})");
    const auto cut = [&](const char* options) {
        return load_model(file, parsed(options)->settings, jobs, {})->scene.materials[0].alpha_cut;
    };
    EXPECT_EQ(cut(""), 0.5F);
    EXPECT_EQ(cut("--opacity 0.25"), std::nullopt);
}

TEST_F(SectionInView, ColourTakesTexturesAndColoursOfVerticesAway) {
    const std::string file =
        folder.write("c.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n");
    EXPECT_FALSE(load_model(file, parsed("")->settings, jobs, {})->scene.mesh.colour.empty());
    EXPECT_TRUE(
        load_model(file, parsed("--colour red")->settings, jobs, {})->scene.mesh.colour.empty());
    const std::string spot = SCANOUT_SOURCE_DIR "/models/spot/spot.obj";
    EXPECT_TRUE(
        load_model(spot, parsed("")->settings, jobs, {})->scene.materials[0].map_diffuse.given());
    EXPECT_FALSE(load_model(spot, parsed("--colour red")->settings, jobs, {})
                     ->scene.materials[0]
                     .map_diffuse.given());
}

} // namespace
} // namespace scanout::app
