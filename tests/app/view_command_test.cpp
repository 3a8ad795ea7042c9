#include "app/options/command_line.h"
#include "app/view/view_command.h"
#include "triangle_mesh.h"

#include <sstream>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::app {
namespace {

std::vector<std::string> words(const std::string& text) {
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), {}};
}

// Where a view shows a place, -1 to 1 from edge to edge, and how far away.
DVec3 seen(const scene::View& view, const DVec3& place) {
    const DVec3 p = view.linear * place + view.translation;
    const bool perspective = view.projection == scene::Projection::perspective;
    const double distance = perspective ? -p.z : 1;
    return {(p.x / distance - view.middle.x) / view.half_width,
            (p.y / distance - view.middle.y) / view.half_height,
            perspective ? p.z : p.z - view.translation.z};
}

Settings settings_of(const std::string& options) {
    const Result<CommandLine> line =
        parse_command_line(words("render model.obj -o x.png " + options));
    EXPECT_TRUE(line) << options << "\n" << line.error().what;
    return line->settings;
}

// Whatever keys and mouse did, from wherever the command line began.
RC_GTEST_PROP(ViewCommand, ShowsTheSameAgain, ()) {
    const geom::Mesh mesh = test::triangle_mesh();
    const std::string start = *rc::gen::element<std::string>(
        "", "--camera 30,-20,4 --fov 60", "--scale 1,2,-0.5 --rotate 10,20,30 --up z",
        "--eye 1,2,4 --look-at 0.1,0,0 --translate 0.2,0,0.1",
        "--shear x:0.3,-0.5 --rotate-axis 1,2,-1:40 --about 1,0,0.5 --scale 1,2,1.5 --fov 30",
        "--frustum -0.1,0.3,-0.2,0.1,0.4,9 --rotate 0,20,0", "--ortho -1,2,-1,0.5,-3,9",
        "--near 0.5 --far 7 --screen-fit width", "--screen-fit stretch --projection orthographic");
    const Settings settings = settings_of(start);
    Viewer viewer(settings, 640, 480, 1);
    for (int i = 0; i < 20; ++i) {
        const auto id =
            static_cast<ActionId>(*rc::gen::inRange(0, static_cast<int>(ActionId::cull_next)));
        if (id == ActionId::scale_up || id == ActionId::scale_down) continue;
        viewer.apply({id, {}, {}, false}, &mesh);
    }
    const std::string options = view_options(viewer, settings, mesh);
    const Settings again = settings_of(options);
    const Viewer other(again, 640, 480, 1);
    RC_ASSERT(again.frame.width == 640 && again.frame.height == 480);
    const scene::View before = *viewer.view(mesh), after = *other.view(mesh);
    RC_ASSERT(after.mirrored == before.mirrored);
    RC_ASSERT(after.cut_far == before.cut_far && after.cut_near == before.cut_near);
    for (const DVec3& place : {DVec3(0, 0, 0), DVec3(1, 0, 0), DVec3(0, 1, 0), DVec3(0, 0, 1)}) {
        const DVec3 a = seen(before, place), b = seen(after, place);
        if (before.projection == scene::Projection::perspective && a.z > -0.05)
            continue; // too near
        RC_ASSERT(length(a - b) < 1e-6);
    }
}

TEST(ViewCommand, QuotesWhatAShellWouldTakeApart) {
    EXPECT_EQ(view_command("a/b.obj", "--up y"), "scanout render a/b.obj --up y -o view.png");
    EXPECT_EQ(view_command("it's $x.obj", "--up y"),
              "scanout render 'it'\\''s $x.obj' --up y -o view.png");
}

} // namespace
} // namespace scanout::app
