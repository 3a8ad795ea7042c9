// `scanout doctor` as a user meets it.
#include "app/program_fixture.h"
#include "base/write_file.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

namespace scanout::app {
namespace {

// A quad beside two, with three decimals; a repeated face, one turned around, one without an area,
// and two vertices at one place.
constexpr const char* kIll = "v 0 0 0\nv 1 0 0\nv 1 1 0.2\nv 0 1 0.2\n" // 4
                             "v 2 0 0\nv 2 0.5 0.1\nv 2 1 0.2\n"        // 7
                             "v 1.0003 0.5 0.1\nv 1 0 0\nv 9 9 9\n"     // 10
                             "f 1 2 3 4\nf 9 5 6 8\nf 8 3 7 6\nf 1 2 3 4\nf 5 5 6\n";

class Doctor : public Program {
protected:
    nlohmann::json json_of(const std::string& words) {
        const Outcome outcome = run("doctor " + words + " --size 64x48 --json");
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out);
    }
    static std::vector<std::string> hazards_in(const nlohmann::json& report) {
        std::vector<std::string> names;
        for (const auto& hazard : report["hazards"])
            names.push_back(hazard["hazard"]);
        return names;
    }
    bool is_there(const std::string& name) { return std::ifstream(folder.file(name)).good(); }

    std::string good = folder.write("good.obj", kTetrahedron);
    std::string ill = folder.write("ill.obj", kIll);
};

TEST_F(Doctor, SaysInOneLineThatNothingIsWrong) {
    const Outcome outcome = run("doctor good.obj --strict --size 64x48");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.out, "good.obj: nothing wrong; 4 faces, 4 triangles\n");
    EXPECT_EQ(outcome.err, "");
    EXPECT_TRUE(run("doctor good.obj --quick").has("not searched for T-vertices, cracks"));
}

TEST_F(Doctor, TellsEachHazardInALineWarningsFirst) {
    const Outcome outcome = run("doctor ill.obj --size 64x48");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const std::vector<std::string> lines = outcome.lines();
    const std::vector<std::string> expected = {
        "warning: t-vertices: 1 vertex lies within another face's edge (face 1, vertex 8, at "
        "1.0003,0.5,0.1; off by up to 0.0003)",
        "warning: duplicate-faces: 1 face repeats another one (face 4, with face 1",
        "warning: mixed-winding: 1 edge joins faces of opposite winding (face 2, with face 3",
        "note: open-edges: ",
        "note: zero-areas: 1 face has no area (face 5",
        "note: unreferenced: 1 position is used by nothing (vertex 10, at 9,9,9)"};
    ASSERT_EQ(lines.size(), expected.size() + 1) << outcome.out;
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_TRUE(lines[i].starts_with(expected[i])) << lines[i];
    EXPECT_EQ(lines.back(), "ill.obj: 3 warnings, 3 notes; 5 faces, 9 triangles; pixels of 64x48");
}

TEST_F(Doctor, IsExitFourForWarningsAloneAndWithStrictAlone) {
    EXPECT_EQ(run("doctor ill.obj --size 64x48").code, 0);
    EXPECT_EQ(run("doctor ill.obj --size 64x48 --strict").code, 4);
    folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const Outcome notes = run("doctor open.obj --size 64x48 --strict");
    EXPECT_EQ(notes.code, 0) << "a note is no warning";
    EXPECT_TRUE(notes.has("note: open-edges: 3 edges"));
}

TEST_F(Doctor, RefusesWrongUse) {
    for (const auto& [words, code] : {std::pair("doctor", 2),
                                      {"doctor ill.obj good.obj", 2},
                                      {"doctor ill.obj --fix out.stl", 2},
                                      {"doctor ill.obj --fix ill.obj", 2},
                                      {"doctor ill.obj --fix no/out.obj", 3},
                                      {"doctor ill.obj --seconds 0", 2},
                                      {"doctor ill.obj --texture nearest", 2},
                                      {"doctor ill.obj --eye 1,1,1 --look-at 1,1,1", 2},
                                      {"doctor none.obj", 3}}) {
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.code, code) << words;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_EQ(outcome.out, "") << words;
    }
}

TEST_F(Doctor, FindsNothingMoreOfWhatFixMends) {
    const Outcome outcome = run("doctor ill.obj --size 64x48 --fix out.obj");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.lines().back(),
              "wrote out.obj: 1 vertex welded, 1 T-vertex made a corner, 1 face without an area "
              "removed, 1 repeated face removed, 1 face turned around, 1 unused vertex removed");
    EXPECT_EQ(hazards_in(json_of("out.obj")), std::vector<std::string>{"open-edges"});
    EXPECT_EQ(run("doctor out.obj --strict").code, 0);
    EXPECT_EQ(run("doctor out.obj --fix again.obj").lines().back(),
              "wrote again.obj: nothing to mend, the same surface");
    EXPECT_EQ(folder.read("again.obj"), folder.read("out.obj"));
}

TEST_F(Doctor, WritesTheFixWholeOrNotAtAll) {
    const Outcome full = run("doctor ill.obj --fix /dev/full/out.obj");
    EXPECT_EQ(full.code, 3);
    const Outcome bad = run("doctor none.obj --fix out.obj");
    EXPECT_EQ(bad.code, 3);
    folder.write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    const Outcome nothing = run("doctor line.obj --fix out.obj");
    EXPECT_EQ(nothing.code, 3);
    EXPECT_NE(nothing.err.find("nothing is left"), std::string::npos) << nothing.err;
    EXPECT_TRUE(nothing.has("zero-areas: 1 face has no area")) << nothing.out;
    EXPECT_FALSE(nothing.has("wrote")) << nothing.out;
    EXPECT_FALSE(is_there("out.obj"));
}

// Of models with textures, materials, normals and polygons: the picture is the same.
TEST_F(Doctor, FixKeepsThePictureOfWhatWasRight) {
    for (const std::string name : {"spot", "suzanne", "rabbit", "cornell_box", "knot"}) {
        const std::string from = std::string(SCANOUT_SOURCE_DIR "/models/") + name + "/";
        ASSERT_EQ(std::system(("cp -r '" + from + "' '" + folder.file(name) + "'").c_str()), 0);
        const std::string model = name + "/" + name + ".obj", fixed = name + "/fixed.obj";
        ASSERT_EQ(run("doctor " + model + " --quick --size 64x48 --fix " + fixed).code, 0);
        const std::string view = " --camera 160,20 --size 320x240 --hash";
        const Outcome before = run("render " + model + view), after = run("render " + fixed + view);
        EXPECT_EQ(before.code, 0);
        EXPECT_EQ(after.out, before.out) << name;
        EXPECT_EQ(after.err, before.err) << name;
    }
}

TEST_F(Doctor, SaysWhatFixDoesNotKeep) {
    folder.write("a.mtl", "newmtl m\nKd 1 0 0\n");
    folder.write("a.obj", std::string("mtllib a.mtl\nusemtl m\n") + kTetrahedron);
    ASSERT_EQ(std::system(("mkdir '" + folder.file("sub") + "'").c_str()), 0);
    const Outcome elsewhere = run("doctor a.obj --fix sub/b.obj");
    EXPECT_NE(elsewhere.err.find("--allow-outside"), std::string::npos) << elsewhere.err;
    EXPECT_NE(folder.read("sub/b.obj").find("mtllib ../a.mtl\n"), std::string::npos);
    EXPECT_EQ(run("doctor a.obj --fix b.obj").err, "");
    EXPECT_NE(folder.read("b.obj").find("mtllib a.mtl\n"), std::string::npos);
    folder.write("c.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n");
    const Outcome coloured = run("doctor c.off --fix d.obj");
    EXPECT_NE(coloured.err.find("colours of faces are left out"), std::string::npos);
    EXPECT_EQ(coloured.code, 0);
}

TEST_F(Doctor, CountsFacesAndVerticesAsTheFormatDoes) {
    const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n9 9 9\n";
    folder.write("a.off", "OFF\n4 1 0\n" + vertices + "3 0 1 2\n");
    const auto report = json_of("a.off");
    EXPECT_EQ(hazards_in(report), (std::vector<std::string>{"open-edges", "unreferenced"}));
    EXPECT_EQ(report["hazards"][0]["worst"]["face"], 0);
    EXPECT_EQ(report["hazards"][1]["worst"]["vertex"], 3);
    EXPECT_EQ(report["hazards"][1]["worst"]["at"], (std::vector<double>{9, 9, 9}));
}

TEST_F(Doctor, ReportsJson) {
    const auto report = json_of("ill.obj --fix out.obj");
    EXPECT_EQ(report["model"], "ill.obj");
    EXPECT_EQ(report["faces"], 5);
    EXPECT_EQ(report["width"], 64);
    const auto& t = report["hazards"][0];
    EXPECT_EQ(t["hazard"], "t-vertices");
    EXPECT_EQ(t["severity"], "warning");
    EXPECT_EQ(t["count"], 1);
    EXPECT_NEAR(t["measure"].get<double>(), 0.0003, 1e-12);
    EXPECT_EQ(t["worst"]["face"], 1);
    EXPECT_EQ(t["worst"]["vertex"], 8);
    EXPECT_TRUE(t["pixels"].contains("here"));
    EXPECT_TRUE(t["mended_by_fix"]);
    EXPECT_EQ(report["fixed"]["path"], "out.obj");
    EXPECT_EQ(report["fixed"]["split"], 1);
}

TEST_F(Doctor, ReportsSarif) {
    folder.write("a b.obj", kIll);
    const Outcome outcome = run("doctor 'a b.obj' --size 64x48 --sarif out.sarif");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const auto sarif = nlohmann::json::parse(folder.read("out.sarif"));
    EXPECT_EQ(sarif["version"], "2.1.0");
    const auto& log = sarif["runs"][0];
    const auto& rules = log["tool"]["driver"]["rules"];
    EXPECT_EQ(log["tool"]["driver"]["name"], "scanout");
    ASSERT_EQ(log["results"].size(), outcome.lines().size() - 1);
    for (std::size_t i = 0; i < log["results"].size(); ++i) {
        const auto& result = log["results"][i];
        const std::string rule = result["ruleId"], level = result["level"],
                          text = result["message"]["text"];
        EXPECT_EQ(rules[result["ruleIndex"].get<std::size_t>()]["id"], rule);
        EXPECT_EQ(level + ": " + rule + ": " + text, outcome.lines()[i]);
        EXPECT_EQ(result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"],
                  "a%20b.obj");
    }
}

// So that an editor or a review shows the hazard where it stands. STL is read without lines.
TEST_F(Doctor, SarifNamesTheLineOfTheWorstFaceOrVertex) {
    const auto lines = [&](const std::string& model) {
        EXPECT_EQ(run("doctor " + model + " --size 64x48 --sarif out.sarif").code, 0);
        std::map<std::string, int> found;
        const auto sarif = nlohmann::json::parse(folder.read("out.sarif"));
        for (const auto& result : sarif["runs"][0]["results"]) {
            const auto& place = result["locations"][0]["physicalLocation"];
            const std::string rule = result["ruleId"];
            found[rule] = place.contains("region") ? place["region"]["startLine"].get<int>() : 0;
        }
        return found;
    };
    folder.write("ill.obj", std::string("# a line\n") + kIll);
    const std::map<std::string, int> found = lines("ill.obj");
    EXPECT_EQ(found.at("t-vertices"), 12) << "the face on whose edge it lies";
    EXPECT_EQ(found.at("duplicate-faces"), 15);
    EXPECT_EQ(found.at("zero-areas"), 16);
    EXPECT_EQ(found.at("unreferenced"), 11);
    folder.write("ill.stl", "solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                            "vertex 0 1 0\nendloop\nendfacet\nendsolid a\n");
    for (const auto& [rule, line] : lines("ill.stl"))
        EXPECT_EQ(line, 0) << rule;
}

TEST_F(Doctor, WritesNothingElseWhereAReportGoesToStandardOutput) {
    const Outcome outcome = run("doctor good.obj --size 64x48 --sarif -");
    EXPECT_EQ(nlohmann::json::parse(outcome.out, nullptr, false)["version"], "2.1.0")
        << outcome.out;
    EXPECT_EQ(run("doctor good.obj --size 64x48 --sarif - --json").code, 2);
}

TEST_F(Doctor, SaysWhatDependsOnTheView) {
    // Two squares one over the other, nearer than a coarse depth keeps apart.
    folder.write("near.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 .0005\nv 1 0 .0005\n"
                             "v 1 1 .0005\nv 0 1 .0005\nf 1 2 3 4\nf 5 6 7 8\n");
    EXPECT_FALSE(run("doctor near.obj --size 64x48").has("overlaps"));
    EXPECT_TRUE(run("doctor near.obj --size 64x48 --depth fixed_24").has("warning: overlaps: "));
    EXPECT_FALSE(run("doctor near.obj --size 64x48 --depth fixed_24 --quick").has("overlaps: "));
    EXPECT_FALSE(run("doctor near.obj --size 64x48").has("small-triangles"));
    EXPECT_TRUE(run("doctor near.obj --size 64x48 --scale 0.001")
                    .has("note: small-triangles: 4 triangles are smaller than a pixel at worst"));
}

} // namespace
} // namespace scanout::app
