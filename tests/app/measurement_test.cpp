// Measuring: figures, the vertices that clicks choose, and what keys and the option show.
#include "app/frontier/measurement.h"
#include "app/options/command_line.h"
#include "app/view/pick.h"
#include "math/bits.h"
#include "session_fixture.h"

#include <sstream>

#include <gmock/gmock.h>

namespace scanout::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Measurement, SaysDistancesAndTheAngleBetween) {
    const DVec3 points[] = {{1, 1, 1}, {4, 5, 1}, {4, 5, 3}};
    EXPECT_THAT(measured_text(std::span(points).first(2)),
                ElementsAre("distance 5  dx 3  dy 4  dz 0"));
    EXPECT_THAT(measured_text(points),
                ElementsAre("distance 1 to 2: 5  dx 3  dy 4  dz 0",
                            "distance 2 to 3: 2  dx 0  dy 0  dz 2", "angle at 2: 90 degrees"));
    const DVec3 sharp[] = {{1, 0, 0}, {0, 0, 0}, {1, 1, 0}},
                back[] = {{1, 0, 0}, {0, 0, 0}, {2, 0, 0}},
                on[] = {{1, 0, 0}, {0, 0, 0}, {-3, 0, 0}};
    EXPECT_NEAR(*measure_points(sharp).angle, 45, 1e-13);
    EXPECT_EQ(*measure_points(back).angle, 0);
    EXPECT_NEAR(*measure_points(on).angle, 180, 1e-13);
    EXPECT_FALSE(measure_points(std::span(points).first(2)).angle);
}

struct Ball {
    geom::Mesh mesh;
    scene::View view;
};
// Of a convex body a vertex is seen where one of its faces looks to the eye.
std::vector<bool> seen_of(const Ball& ball) {
    std::vector<bool> seen(ball.mesh.position.size());
    for (std::size_t i = 0; i < ball.mesh.index.size(); i += 3) {
        const auto at = [&](std::size_t k) {
            return ball.view.linear * DVec3(ball.mesh.position[ball.mesh.index[i + k]]) +
                   ball.view.translation;
        };
        const bool flat = ball.view.projection == scene::Projection::orthographic;
        const DVec3 sight = flat ? DVec3(0, 0, -1) : at(0);
        if (dot3(cross3(at(1) - at(0), at(2) - at(0)), sight) < 0)
            for (std::size_t k = 0; k < 3; ++k)
                seen[ball.mesh.index[i + k]] = true;
    }
    return seen;
}

TEST_F(Session, ThePointerMeansTheNearestVertexThatIsSeen) {
    std::string ball;
    constexpr int kAround = 24, kUp = 12;
    for (int j = 0; j <= kUp; ++j)
        for (int i = 0; i < kAround; ++i) {
            const double a = 6.283185307179586 * i / kAround, e = 3.141592653589793 * j / kUp;
            ball += fmt::format("v {} {} {}\n", std::sin(e) * std::cos(a), std::cos(e),
                                std::sin(e) * std::sin(a));
        }
    for (int j = 0; j < kUp; ++j)
        for (int i = 0; i < kAround; ++i) {
            const int a = j * kAround + i + 1, b = j * kAround + (i + 1) % kAround + 1;
            if (j > 0) ball += fmt::format("f {} {} {}\n", a, b, a + kAround);
            if (j + 1 < kUp) ball += fmt::format("f {} {} {}\n", b, b + kAround, a + kAround);
        }
    const LoadedModel model = *load_model(folder.write("ball.obj", ball), settings, jobs, {});
    for (const auto projection :
         {scene::Projection::perspective, scene::Projection::orthographic}) {
        settings.camera.projection = projection;
        const Ball shown{model.scene.mesh, *scene::make_view(model.scene.mesh, {}, {},
                                                             fitted(model), {}, width, height)};
        const std::vector<bool> seen = seen_of(shown);
        int found = 0;
        for (int y = 2; y < height; y += 9)
            for (int x = 3; x < width; x += 7) {
                double nearest = kPickPixels;
                for (std::size_t v = 0; v < seen.size(); ++v) {
                    if (!seen[v]) continue;
                    const DVec3 p =
                        shown.view.linear * DVec3(shown.mesh.position[v]) + shown.view.translation;
                    const double away = projection == scene::Projection::perspective ? -p.z : 1;
                    const double dx =
                        (p.x / (away * shown.view.half_width) + 1) / 2 * width - x - 0.5;
                    const double dy =
                        (1 - p.y / (away * shown.view.half_height)) / 2 * height - y - 0.5;
                    nearest = std::min(nearest, std::sqrt(dx * dx + dy * dy));
                }
                const auto vertex = seen_vertex(shown.mesh, shown.view, width, height, {x, y});
                EXPECT_EQ(vertex.has_value(), nearest < kPickPixels) << x << ' ' << y;
                if (!vertex) continue;
                ++found;
                EXPECT_TRUE(seen[*vertex]) << x << ' ' << y;
                const DVec3 p = shown.view.linear * DVec3(shown.mesh.position[*vertex]) +
                                shown.view.translation;
                const double away = projection == scene::Projection::perspective ? -p.z : 1;
                const double dx = (p.x / (away * shown.view.half_width) + 1) / 2 * width - x - 0.5;
                const double dy =
                    (1 - p.y / (away * shown.view.half_height)) / 2 * height - y - 0.5;
                EXPECT_NEAR(std::sqrt(dx * dx + dy * dy), nearest, 1e-9) << x << ' ' << y;
            }
        EXPECT_GT(found, 50);
    }
}

// The cube's edge from 0,0,1 to 1,0,1, seen from the front: clicks near its ends.
TEST_F(Session, ClicksMeasureBetweenVertices) {
    settings.camera.azimuth_degrees = settings.camera.elevation_degrees = 0;
    port::HeadlessDisplay display = make_display();
    const LoadedModel model = *load_model(settings.arguments.front(), settings, jobs, {});
    const scene::View view =
        *scene::make_view(model.scene.mesh, {}, {}, fitted(model), {}, width, height);
    const DVec3 ends[] = {{0, 0, 1}, {1, 0, 1}};
    std::string script = "toggle_measuring\n";
    const MeasuredMarks marks = measured_marks(ends, view, model.scene.mesh, width, height);
    ASSERT_EQ(marks.points.size(), 2U);
    for (const PixelPlace& at : marks.points)
        script += fmt::format("+1 pointer {} {}\n+1 drag_begin\n+1 drag_end\n", at.x + 2, at.y - 2);
    settings.no_pointer = true; // not drawn
    script += "+1 frame " + folder.file("seen.png") + "\n+1 close\n+1 frame " +
              folder.file("closed.png") + "\n";
    ASSERT_TRUE(play(script, display));
    const image::Image seen = *image::load(folder.file("seen.png"));
    image::Image expected = rendered({});
    EXPECT_TRUE(*image::load(folder.file("closed.png")) == expected);
    Overlay overlay;
    overlay.measured = marks;
    overlay.message = "distance 1  dx 1  dy 0  dz 0";
    draw_overlay(expected, overlay);
    EXPECT_TRUE(seen == expected);
}

TEST(Measurement, EachLineOfItsTextIsALineOnThePicture) {
    const auto rows_under = [](const std::string& message) {
        image::Image picture(400, 200, {90, 90, 90, 255});
        const image::Image before = picture;
        Overlay overlay;
        overlay.message = message;
        draw_overlay(picture, overlay);
        int rows = 0;
        for (int y = 0; y < picture.height(); ++y)
            rows += picture.row(y)[0] == before.row(y)[0] ? 0 : 1;
        return rows;
    };
    const int line = rows_under("a\nb") - rows_under("a");
    EXPECT_GT(line, 10);
    EXPECT_EQ(rows_under("a\nb\nc"), rows_under("a") + 2 * line);
}

TEST(MeasureOption, ReadsTwoPointsOrThree) {
    const auto parsed = [](const std::string& text) {
        std::istringstream stream("render a.obj -o a.png --measure " + text);
        return parse_command_line({std::istream_iterator<std::string>(stream), {}});
    };
    EXPECT_THAT(parsed("0,0,0:1,-2,3")->settings.measured, ElementsAre(DVec3(0), DVec3(1, -2, 3)));
    EXPECT_EQ(parsed("0,0,0:1,2,3:4,5,6")->settings.measured.size(), 3U);
    for (const char* wrong : {"1,2,3", "1,2:3,4", "1,2,3:", "1,2,3:4,5,6:7,8,9:0,0,0", "x"})
        EXPECT_FALSE(parsed(wrong)) << wrong;
}

} // namespace
} // namespace scanout::app
