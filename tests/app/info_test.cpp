// `scanout info` as a user meets it.
#include "app/program_fixture.h"

#include <nlohmann/json.hpp>

#include <gmock/gmock.h>

namespace scanout::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Info : public Program {
protected:
    // The exit code; what it says is in out and err.
    int describe(const std::string& words) {
        const Outcome outcome = run("info " + words);
        out = outcome.out;
        err = outcome.err;
        return outcome.code;
    }
    nlohmann::json json_of(const std::string& words) {
        EXPECT_EQ(describe(words + " --json"), 0) << err;
        return nlohmann::json::parse(out);
    }
    std::string out, err;
};

// A tetrahedron with corners at 0 and on the axes at 2, 3, 4: its volume is 4.
constexpr const char* kClosed = "v 0 0 0\nv 2 0 0\nv 0 3 0\nv 0 0 4\n"
                                "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

TEST_F(Info, TellsElementsSizeAndSurface) {
    folder.write("a.obj", kClosed);
    EXPECT_EQ(describe("a.obj"), 0);
    EXPECT_THAT(out, HasSubstr("a.obj: OBJ, y is up"));
    EXPECT_THAT(out, HasSubstr("  elements   4 vertices, 4 faces, 4 triangles\n"));
    EXPECT_THAT(out, HasSubstr("  size       2 x 3 x 4, from 0,0,0 to 2,3,4\n"));
    EXPECT_THAT(out, HasSubstr("closed, wound outwards, manifold, area 20.8102, volume 4\n"));
    EXPECT_EQ(err, "");
}

TEST_F(Info, SaysTheSameAsJson) {
    folder.write("a.obj", kClosed);
    const nlohmann::json info = json_of("a.obj");
    EXPECT_EQ(info["format"], "obj");
    EXPECT_EQ(info["triangles"], 4);
    EXPECT_EQ(info["box"]["size"], (std::vector<double>{2, 3, 4}));
    EXPECT_EQ(info["surface"]["closed"], true);
    EXPECT_NEAR(info["surface"]["volume"].get<double>(), 4, 1e-6);
    EXPECT_EQ(info["surface"]["open_edges"], 0);
}

TEST_F(Info, TakesATransformApart) {
    folder.write("a.obj", kClosed);
    EXPECT_TRUE(json_of("a.obj")["transform"].is_null());
    EXPECT_EQ(describe("a.obj --scale 1,2,1 --rotate 0,0,30 --translate 1,2,3"), 0);
    EXPECT_THAT(out, HasSubstr("moves by 1,2,3\n"));
    EXPECT_THAT(out, HasSubstr("determinant 2: stretches by 1, 2, 1 along 1,0,0; 0,1,0; 0,0,1\n"));
    EXPECT_THAT(out, HasSubstr("then turns by 30 degrees about 0,0,1\n"));
    EXPECT_EQ(describe("a.obj --scale 2"), 0);
    EXPECT_THAT(out, HasSubstr("determinant 8: scales by 2\n"));
    EXPECT_THAT(out, Not(HasSubstr("turns")));
    EXPECT_EQ(describe("a.obj --scale 1,0,1"), 0);
    EXPECT_THAT(out, HasSubstr("singular"));
    const auto transform = json_of("a.obj --matrix 1,2,0,4,0,1,0,5,0,0,-3,6,0,0,0,1")["transform"];
    EXPECT_EQ(transform["matrix"],
              (std::vector<double>{1, 2, 0, 4, 0, 1, 0, 5, 0, 0, -3, 6, 0, 0, 0, 1}));
    EXPECT_EQ(transform["singular"], false);
    EXPECT_NEAR(transform["determinant"].get<double>(), -3, 1e-12);
    EXPECT_EQ(transform["factors"].size(), 3U);
}

TEST_F(Info, AnOpenSurfaceHasEdgesButNoVolume) {
    folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 2 1 4\n");
    const nlohmann::json info = json_of("a.obj");
    EXPECT_EQ(info["surface"]["closed"], false);
    EXPECT_EQ(info["surface"]["manifold"], false);
    EXPECT_TRUE(info["surface"]["volume"].is_null());
    EXPECT_EQ(describe("a.obj"), 0);
    EXPECT_THAT(out, HasSubstr("open"));
    EXPECT_THAT(out, HasSubstr("1 non-manifold edge, area 1.5"));
    EXPECT_THAT(out, Not(HasSubstr("volume")));
}

// One face the other way round, all of them, and a face without an area.
TEST_F(Info, TellsHowAClosedSurfaceIsWound) {
    const std::string corners = "v 0 0 0\nv 2 0 0\nv 0 3 0\nv 0 0 4\n";
    folder.write("mixed.obj", corners + "f 1 2 3\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    EXPECT_EQ(describe("mixed.obj"), 0);
    EXPECT_THAT(out, HasSubstr("closed, wound inconsistently along 3 edges, manifold, area"));
    EXPECT_THAT(out, Not(HasSubstr("volume")));
    folder.write("in.obj", corners + "f 1 2 3\nf 1 4 2\nf 2 4 3\nf 1 3 4\n");
    EXPECT_EQ(describe("in.obj"), 0);
    EXPECT_THAT(out, HasSubstr("closed, wound inwards, manifold, area 20.8102, volume -4\n"));
    folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    EXPECT_EQ(describe("flat.obj"), 0);
    EXPECT_THAT(out, HasSubstr("surface    no area\n"));
}

// Its surface is what it is, whatever its area comes to in a double.
TEST_F(Info, AHugeOrTinySurfaceIsStillClosed) {
    for (const std::string power : {"120", "-120", "170", "-170"}) {
        const std::string e = "e" + power;
        folder.write("a.obj", "v 0 0 0\nv 2" + e + " 0 0\nv 0 3" + e + " 0\nv 0 0 4" + e +
                                  "\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
        EXPECT_EQ(describe("a.obj"), 0);
        EXPECT_THAT(out, HasSubstr("closed, wound outwards, manifold, area ")) << e;
        EXPECT_THAT(out, HasSubstr("volume beyond the range of numbers\n")) << e;
        const bool has_number = power.find("120") != std::string::npos;
        const nlohmann::json surface = json_of("a.obj")["surface"];
        EXPECT_EQ(surface["closed"], true) << e;
        EXPECT_EQ(surface["area"].is_number(), has_number) << e;
        EXPECT_TRUE(surface["volume"].is_null()) << e;
    }
}

TEST_F(Info, PlacesFarFromTheOriginHaveTheDigitsOfTheSize) {
    folder.write("far.obj", "v 449999.125 5400000.5 0\nv 450001.375 5400000.5 0\n"
                            "v 449999.125 5400002.75 0\nf 1 2 3\n");
    EXPECT_EQ(describe("far.obj"), 0);
    EXPECT_THAT(out, HasSubstr("2.25 x 2.25 x 0, from 449999.125,5400000.5,0 to "
                               "450001.375,5400002.75,0\n"));
}

TEST_F(Info, ColoursOfFacesAreNoMaterials) {
    folder.write("a.off",
                 "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2 255 0 0\n3 0 1 3 0 255 0\n");
    EXPECT_EQ(describe("a.off"), 0);
    EXPECT_THAT(out, HasSubstr("gives      colours of faces\n"));
    EXPECT_THAT(out, Not(HasSubstr("materials")));
    EXPECT_EQ(json_of("a.off")["materials"].size(), 0U);
}

TEST_F(Info, TellsWhichTexturesWereFound) {
    folder.write("a.mtl", "newmtl wood\nmap_Kd here.ppm\nmap_Ke gone.png\n"
                          "map_Ks dull.png\nrefl sky.png\n");
    folder.write("here.ppm", "P6 2 1 255\nabcdef");
    folder.write("a.obj", std::string("mtllib a.mtl\nvt 0 0\nusemtl wood\n") + kClosed);
    EXPECT_EQ(describe("a.obj"), 0);
    EXPECT_THAT(out, HasSubstr("  materials  1: wood\n"));
    EXPECT_THAT(out, HasSubstr("wood: map_Kd here.ppm (2 x 1)\n"));
    EXPECT_THAT(out, HasSubstr("wood: map_Ke gone.png (missing)\n"));
    EXPECT_THAT(out, HasSubstr("wood: map_Ks dull.png (not needed)\n"));
    EXPECT_THAT(out, HasSubstr("wood: refl sky.png (not drawn)\n"));
    EXPECT_THAT(err, HasSubstr("gone.png"));
    const nlohmann::json info = json_of("a.obj");
    ASSERT_EQ(info["textures"].size(), 4U);
    EXPECT_EQ(info["textures"][0]["width"], 2);
    EXPECT_EQ(info["textures"][1]["map"], "map_Ks");
    EXPECT_EQ(info["textures"][1]["missing"], false);
    EXPECT_EQ(info["textures"][2]["map"], "map_Ke");
    EXPECT_EQ(info["textures"][2]["missing"], true);
    EXPECT_TRUE(info["textures"][2]["found"].is_null());
    EXPECT_FALSE(info["warnings"].empty());
}

TEST_F(Info, OfPointsTellsNoSurface) {
    folder.write("a.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n"
                          "property float y\nproperty float z\nend_header\n0 0 0\n1 2 3\n");
    const nlohmann::json info = json_of("a.ply");
    EXPECT_EQ(info["points"], 2);
    EXPECT_TRUE(info["surface"].is_null());
    EXPECT_EQ(describe("a.ply"), 0);
    EXPECT_THAT(out, HasSubstr("2 points"));
}

TEST_F(Info, RefusesWhatItCannotDescribe) {
    EXPECT_EQ(describe(""), 2);
    EXPECT_THAT(err, HasSubstr("name a model to describe"));
    EXPECT_EQ(describe("a.obj b.obj"), 2);
    EXPECT_EQ(describe("gone.obj"), 3);
    EXPECT_THAT(err, HasSubstr("gone.obj"));
    folder.write("a.obj", kClosed);
    EXPECT_EQ(describe("a.obj --json=a.obj"), 2);
    EXPECT_EQ(folder.read("a.obj"), kClosed);
}

} // namespace
} // namespace scanout::app
