// D in the viewer: the hazards of the file, and the worst place of each.
#include "app/view/live_doctor.h"
#include "app/view/viewer.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

using Id = ActionId;

// Two quads beside one along an edge, with three decimals; a face without an area.
constexpr const char* kSeam = "v 0 0 0\nv 1 0 0\nv 1 1 0.2\nv 0 1 0.2\nv 2 0 0\nv 2 0.5 0.1\n"
                              "v 2 1 0.2\nv 1.0003 0.5 0.1\n"
                              "f 1 2 3 4\nf 2 5 6 8\nf 8 6 7 3\nf 5 5 6\n";

class HazardsInView : public ::testing::Test {
protected:
    Effect act(Id id) { return viewer.apply({id, {}, {}, false}, &mesh); }
    DVec3 seen(const DVec3& place) const {
        const scene::View view = *viewer.view(mesh);
        return view.linear * (scene::radii_from_centre(mesh, place) * mesh.radius) +
               view.translation;
    }
    static geom::Mesh square() {
        geom::Mesh mesh = scanout::test::empty_mesh();
        scanout::test::add_square(mesh, 0.7F);
        return mesh;
    }
    geom::Mesh mesh = square();
    Viewer viewer{Settings(), 640, 480, 1};
};

// From every side, by both projections: in the middle, where the camera looks, and eight times as
// large; of what lies on the other side of the model nothing is before it.
TEST_F(HazardsInView, DFliesToEachPlaceAndUComesBack) {
    const std::vector<DVec3> corners = {{1, 0, 0}, {-1, 0.2, 0}, {0, 1, 0},      {0.1, -1, 0.2},
                                        {0, 0, 1}, {0, 0, -1},   {-.5, .4, -.7}, {0, 0, 0}};
    std::vector<DVec3> places;
    std::vector<std::optional<HazardSpot>> spots;
    for (const DVec3& corner : corners) { // about the model's centre, in file coordinates
        places.push_back(mesh.centre + corner * std::ldexp(0.9 * mesh.radius, mesh.exponent));
        spots.push_back(HazardSpot{places.back(), DVec3(0)});
    }
    viewer.set_hazards(spots);
    for (const bool orthographic : {false, true}) {
        if (orthographic) act(Id::toggle_projection);
        act(Id::rotate_left);
        for (std::size_t i = 0; i < places.size(); ++i) {
            const Look before = viewer.state().look;
            EXPECT_EQ(act(Id::toggle_doctor), Effect::none);
            EXPECT_EQ(viewer.state().doctor, static_cast<int>(i) + 1);
            EXPECT_EQ(viewer.hazard_place(), places[i]);
            const std::optional<PixelPlace> pixel = viewer.pixel_of(places[i], mesh);
            ASSERT_TRUE(pixel) << i;
            EXPECT_NEAR(pixel->x, 320, 1) << i;
            EXPECT_NEAR(pixel->y, 240, 1) << i;
            if (corners[i] != DVec3(0)) {
                EXPECT_GT(seen(places[i]).z, seen(mesh.centre).z + 5) << i << ": in front";
            }
            const Look there = viewer.state().look;
            act(Id::undo);
            EXPECT_EQ(viewer.state().look, before);
            EXPECT_NE(there, before);
        }
        act(Id::toggle_doctor);
        EXPECT_EQ(viewer.state().doctor, 0) << "behind the last one it closes";
    }
}

// A sheet is seen from its front, wherever it lies about the model's centre.
TEST_F(HazardsInView, DLooksAtTheFrontOfTheSurface) {
    for (const DVec3 normal : {DVec3(0, 0, 1), DVec3(0, 0, -1), DVec3(0, 3, 0), DVec3(-1, -2, 2)}) {
        viewer.set_hazards({HazardSpot{mesh.centre + DVec3(0.1, 0, 0), normal}});
        act(Id::toggle_doctor);
        const DVec3 seen = viewer.view(mesh)->normal * normal;
        EXPECT_GT(seen.z, 0.9999 * std::sqrt(dot3(seen, seen))) << "towards the eye";
        act(Id::close);
    }
}

TEST_F(HazardsInView, OneOfXAndDIsOpenAndEscapeClosesIt) {
    viewer.set_hazards({std::nullopt, std::nullopt});
    act(Id::toggle_explain);
    const Look before = viewer.state().look;
    act(Id::toggle_doctor);
    EXPECT_EQ(viewer.state().look, before) << "it has no place";
    EXPECT_EQ(viewer.state().explain, 0);
    EXPECT_EQ(viewer.state().doctor, 1);
    act(Id::toggle_explain);
    EXPECT_EQ(viewer.state().doctor, 0);
    act(Id::toggle_doctor);
    EXPECT_EQ(act(Id::close), Effect::none);
    EXPECT_EQ(viewer.state().doctor, 0);
}

TEST_F(HazardsInView, ThePanelListsWhatDoctorFindsAndNeverMoreThanFits) {
    const scanout::test::TemporaryFolder folder;
    const std::string path = folder.write("seam.obj", kSeam);
    Jobs jobs(2);
    LiveDoctor doctor;
    EXPECT_FALSE(doctor.knows(3));
    doctor.examine(path, Settings(), jobs, 3, true, [](double) { return true; });
    EXPECT_TRUE(doctor.knows(3));
    ASSERT_GE(doctor.places().size(), 2U);
    ASSERT_TRUE(doctor.places()[0]);
    EXPECT_NEAR(doctor.places()[0]->at.x, 1.0003, 1e-9) << "the T-vertex, though drawing mends it";
    const std::vector<std::string> lines = doctor.lines(78, 40, 1);
    EXPECT_EQ(lines[0], "hazards in the file (1 of " + std::to_string(doctor.places().size()) +
                            "); D: the next one");
    EXPECT_EQ(lines[1], "> t-vertices: 1 vertex lies within another face's edge");
    EXPECT_EQ(lines[2].substr(0, 8), "    face");
    EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const std::string& line) {
        return line == "  zero-areas: 1 face has no area";
    }));
    const auto last = static_cast<int>(doctor.places().size());
    for (const std::size_t rows : {1U, 3U, 6U, 9U})
        for (int selected = 1; selected <= last; ++selected) {
            const std::vector<std::string> few = doctor.lines(30, rows, selected);
            EXPECT_LE(few.size(), rows);
            for (const std::string& line : few)
                EXPECT_LE(line.size(), 30U);
            if (rows > 1) {
                EXPECT_TRUE(
                    std::any_of(few.begin(), few.end(),
                                [](const std::string& line) { return line.starts_with("> "); }))
                    << rows << ' ' << selected;
            }
        }
    // Whoever leaves while the model is examined is not kept waiting.
    int calls_after = 0;
    bool left = false;
    doctor.examine(path, Settings(), jobs, 5, true, [&](double share) {
        calls_after += left ? 1 : 0;
        left = left || share > 0.4;
        return !left;
    });
    EXPECT_TRUE(left);
    EXPECT_EQ(calls_after, 0);
    EXPECT_TRUE(doctor.places().empty());
    doctor.examine("-", Settings(), jobs, 6, true, [](double) { return true; });
    EXPECT_EQ(doctor.lines(200, 9, 1)[0], "standard input cannot be read a second time to look for "
                                          "hazards; save it, and show the file");
    doctor.examine(folder.file("gone.obj"), Settings(), jobs, 4, true, [](double) { return true; });
    EXPECT_TRUE(doctor.places().empty());
    EXPECT_NE(doctor.lines(200, 9, 1)[0].find("gone.obj"), std::string::npos);
}

} // namespace
} // namespace scanout::app
