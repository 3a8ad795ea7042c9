// Every OBJ, STL, PLY and OFF of the shared collection against what its manifest counts, where it
// is present.
#include "base/mapping.h"
#include "folder.h"
#include "io/load.h"
#include "io/obj/obj.h"

#include <cmath>
#include <map>
#include <optional>
#include <sstream>

#include <gtest/gtest.h>

namespace scanout::io {
namespace {

const std::string kAssets = SCANOUT_SOURCE_DIR "/../shared/assets/";

struct Row {
    std::string path, format, vertices, faces, features;
};

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, separator);)
        parts.push_back(part);
    return parts;
}

std::vector<Row> model_rows() {
    std::vector<Row> rows;
    std::ifstream in(kAssets + "MANIFEST.tsv");
    for (std::string line; std::getline(in, line);) {
        const std::vector<std::string> cells = split(line, '\t');
        if (cells.size() < 8 || !cells[0].starts_with("models/")) continue;
        if (cells[1] == "obj" || cells[1] == "stl" || cells[1] == "ply" || cells[1] == "off")
            rows.push_back({cells[0], cells[1], cells[3], cells[4], cells[7]});
    }
    return rows;
}

// "tris 12" -> 12, of the features' list.
std::optional<std::size_t> feature(const std::string& features, const std::string& name) {
    for (const std::string& part : split(features, ';')) {
        const std::size_t at = part.rfind(name + " ");
        if (at == std::string::npos) continue;
        const std::string number = part.substr(at + name.size() + 1);
        if (!number.empty() && number.find_first_not_of("0123456789") == std::string::npos)
            return std::stoul(number);
    }
    return std::nullopt;
}

// Where we count other things than the manifest, and why.
const std::map<std::string, std::size_t> kPoints = {
    // The manifest counts p statements, we count the vertices that they name.
    {"models/obj_cases_assimp/testmixed.obj", 24},
    {"models/obj_cases_tinyobj/points-prim.obj", 8},
    {"models/obj_cases_ufbx/synthetic_obj_zoo_0_obj.obj", 4},
    // No element at all: the vertices are shown as points.
    {"models/obj_cases_assimp/point_cloud.obj", 3},
    {"models/obj_freeform_made/bezier_patch.obj", 16},
};
// What is refused, with these words.
const std::map<std::string, std::string> kRefused = {
    {"models/obj_cases_tinyobj/issue-356-leading-spaces-newmtl.obj", "no vertices"},
    {"models/ply_magnum_importer/empty.ply", "without vertices"},
    {"models/ply_gaussian/test.ply", "no x, y and z"}, // packed splats
    {"models/other_wrong_extension/Cube_gltf_wrong_extension.stl",
     "buffers[0]: 'Cube.bin' is not there"},
};
// Its "usemtl" names nothing.
const std::string kUnnamedMaterial = "models/cad_trimesh/wallhole.obj";

// Unpacked where the collection holds it packed.
std::string unpacked(const std::string& path, const test::Folder& folder) {
    if (!path.ends_with(".xz")) return path; // .gz is read as it is
    const std::string out = folder.path("unpacked");
    EXPECT_EQ(std::system(("xz -dc '" + path + "' > '" + out + "'").c_str()), 0);
    return out;
}

void check_obj_materials(const Row& row, const std::string& path) {
    const auto used = feature(row.features, "materials used");
    Warnings warnings;
    const auto file = Mapping::open(path);
    ASSERT_TRUE(file);
    const auto obj = read_obj(file->text(), path, warnings);
    ASSERT_TRUE(obj);
    EXPECT_EQ(obj->materials.size(), used.value_or(0)) << row.path;
}

void check(const Row& row, const test::Folder& folder) {
    const std::string path = unpacked(kAssets + row.path, folder);
    Warnings warnings;
    LoadOptions options;
    options.split_t_vertices = false; // the manifest counts what the file has
    const auto scene = load(path, options, warnings);
    if (const auto refused = kRefused.find(row.path); refused != kRefused.end()) {
        ASSERT_FALSE(scene) << row.path;
        EXPECT_NE(scene.error().what.find(refused->second), std::string::npos);
        return;
    }
    ASSERT_TRUE(scene) << scene.error().what;
    const scene::ModelCounts& counts = scene->counts;
    EXPECT_EQ(std::to_string(counts.vertices), row.vertices) << row.path;
    if (row.path.find("tristrips") != std::string::npos)
        EXPECT_EQ(counts.faces, 2U) << "the manifest counts no strips";
    else
        EXPECT_EQ(std::to_string(counts.faces), row.faces) << row.path;
    if (row.format == "stl") {
        EXPECT_EQ(counts.triangles, counts.faces) << row.path;
    }
    if (row.format != "obj") return;
    EXPECT_EQ(counts.triangles, feature(row.features, "tris").value_or(0)) << row.path;
    EXPECT_EQ(counts.lines, feature(row.features, "lines").value_or(0)) << row.path;
    // Of free-form curves and surfaces alone the vertices are shown as points.
    const bool empty = counts.faces == 0 && counts.lines == 0;
    const auto explained = kPoints.find(row.path);
    EXPECT_EQ(counts.points,
              explained != kPoints.end()
                  ? explained->second
                  : feature(row.features, "points").value_or(empty ? counts.vertices : 0))
        << row.path;
    if (!path.ends_with(".gz") && row.path != kUnnamedMaterial) check_obj_materials(row, path);
}

TEST(Manifest, EveryModelHasTheCountsThatItsManifestTells) {
    const std::vector<Row> rows = model_rows();
    if (rows.empty()) GTEST_SKIP() << "the shared models are not here";
    const test::Folder folder;
    std::map<std::string, int> checked;
    for (const Row& row : rows) {
        check(row, folder);
        ++checked[row.format];
    }
    std::printf("checked %d OBJ, %d STL, %d PLY and %d OFF files\n", checked["obj"], checked["stl"],
                checked["ply"], checked["off"]);
    EXPECT_GE(checked["obj"], 80);
    EXPECT_GE(checked["stl"], 14);
    EXPECT_GE(checked["ply"], 55);
    EXPECT_GE(checked["off"], 10);
}

TEST(Manifest, SpotIsWrittenIntoTheSceneVertexByVertex) {
    const std::string path = kAssets + "models/spot/spot_textured.obj";
    if (!std::ifstream(path)) GTEST_SKIP() << "the shared models are not here";
    Warnings warnings;
    const auto scene = load(path, {}, warnings);
    ASSERT_TRUE(scene);
    EXPECT_EQ(test::all_lines(warnings), "");
    ASSERT_EQ(scene->textures.size(), 1u);
    EXPECT_EQ(scene->textures[0].image.width(), 1024);
    EXPECT_EQ(scene->mesh.uv.size(), scene->mesh.position.size());
    EXPECT_DOUBLE_EQ(scene->mesh.box_max.y, 0.953646);
    EXPECT_DOUBLE_EQ(scene->mesh.box_min.z, -0.668909);
}

} // namespace
} // namespace scanout::io
