#include "folder.h"
#include "io/materials.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

namespace scanout::io {
namespace {

using test::all_lines;
using test::Folder;
using test::warned;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> names(const Folder& folder, const std::string& text) {
    FileFinder finder;
    return library_names(finder, folder.path("."), text);
}

TEST(LibraryNames, WhatExistsDecidesWhereANameEnds) {
    const Folder folder;
    for (const char* name : {"a.mtl", "b.mtl", "my file.mtl", "x y.mtl", "a b"})
        folder.write(name, "");
    EXPECT_THAT(names(folder, "a.mtl"), ElementsAre("a.mtl"));
    EXPECT_THAT(names(folder, "a.mtl b.mtl"), ElementsAre("a.mtl", "b.mtl"));
    EXPECT_THAT(names(folder, "a.mtl\tb.mtl"), ElementsAre("a.mtl", "b.mtl"));
    EXPECT_THAT(names(folder, "my file.mtl"), ElementsAre("my file.mtl"));
    EXPECT_THAT(names(folder, "a.mtl my file.mtl b.mtl"),
                ElementsAre("a.mtl", "my file.mtl", "b.mtl"));
    EXPECT_THAT(names(folder, "\"my file.mtl\" a.mtl"), ElementsAre("my file.mtl", "a.mtl"));
    EXPECT_THAT(names(folder, "my\\ file.mtl x\\ y.mtl"), ElementsAre("my file.mtl", "x y.mtl"));
    EXPECT_THAT(names(folder, "a b"), ElementsAre("a b"));
    EXPECT_THAT(names(folder, "gone.mtl a.mtl gone too.mtl"),
                ElementsAre("gone.mtl", "a.mtl", "gone too.mtl"));
    EXPECT_THAT(names(folder, "gone"), ElementsAre("gone"));
    EXPECT_THAT(names(folder, ""), IsEmpty());
    EXPECT_THAT(names(folder, "\"open"), ElementsAre("\"open"));
}

TEST(FileFinder, ForgivesBackslashesAndCase) {
    const Folder folder;
    folder.write("Maps/Wood Dark.JPG", "1");
    folder.write("both.png", "1");
    folder.write("BOTH.png", "1");
    folder.write("back\\slash.png", "1");
    FileFinder finder;
    const auto find = [&](const char* name) {
        return finder.find(folder.path("."), name).value_or("-");
    };
    const auto at = [&](const char* name) { return folder.path(std::string("./") + name); };
    EXPECT_EQ(find("Maps/Wood Dark.JPG"), at("Maps/Wood Dark.JPG"));
    EXPECT_EQ(find("maps\\wood dark.jpg"), at("Maps/Wood Dark.JPG"));
    EXPECT_EQ(find(".\\MAPS\\WOOD DARK.jpg"), at("./Maps/Wood Dark.JPG"));
    EXPECT_EQ(find("maps/../maps/wood dark.jpg"), at("Maps/../Maps/Wood Dark.JPG"));
    EXPECT_EQ(find("both.png"), at("both.png")) << "as it stands comes first";
    EXPECT_EQ(find("Both.png"), at("BOTH.png")) << "then the first in byte order";
    EXPECT_EQ(find("back\\slash.png"), at("back\\slash.png"));
    EXPECT_EQ(find("wood dark.jpg"), "-");
    EXPECT_EQ(find(""), "-");
    EXPECT_EQ(find(std::string(5000, 'a').c_str()), "-");
    EXPECT_FALSE(finder.find(folder.path("."), std::string_view("both.png\0", 9)));
    EXPECT_EQ(finder.find_anywhere(folder.path("Maps"), folder.path("."), "C:\\Users\\me\\both.png")
                  .value_or("-"),
              at("both.png"));
    EXPECT_FALSE(finder.find_anywhere(folder.path("Maps"), folder.path("."), "C:\\Users\\me\\"));
}

TEST(FolderOf, IsWhatStandsBeforeTheLastSlash) {
    EXPECT_EQ(folder_of("a/b/c.obj"), "a/b");
    EXPECT_EQ(folder_of("c.obj"), "");
    EXPECT_EQ(folder_of("/c.obj"), "/");
}

struct Loaded {
    Materials materials;
    Warnings warnings;
};

Loaded load(const Folder& folder, const std::string& obj_text) {
    Loaded l;
    const auto obj = read_obj("v 0 0 0\n" + obj_text, folder.path("m.obj"), l.warnings);
    EXPECT_TRUE(obj);
    l.warnings = Warnings();
    l.materials = load_materials(*obj, folder.path("m.obj"), l.warnings);
    return l;
}

TEST(Materials, OnlyThoseThatAreUsedAreKeptInTheOrderOfFirstUse) {
    const Folder folder;
    folder.write("m.mtl", "newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 1 0\nnewmtl c\nmap_Kd gone.png\n");
    const Loaded l = load(folder, "mtllib m.mtl\nusemtl b\nusemtl none\nusemtl a\nusemtl b\n");
    ASSERT_EQ(l.materials.materials.size(), 2u);
    EXPECT_EQ(l.materials.materials[0].name, "b");
    EXPECT_EQ(l.materials.materials[1].name, "a");
    EXPECT_THAT(l.materials.of_name, ElementsAre(0, -1, 1));
    EXPECT_EQ(l.warnings.lines().size(), 1u) << all_lines(l.warnings);
    EXPECT_TRUE(warned(l.warnings, {"m.obj:4: ", "'none' is not defined"}));
}

TEST(Materials, TheLibraryMayFollowItsUse) {
    const Folder folder;
    folder.write("m.mtl", "newmtl a\nKd 1 0 0\n");
    EXPECT_THAT(load(folder, "usemtl a\nmtllib m.mtl\n").materials.of_name, ElementsAre(0));
}

TEST(Materials, AMissingLibraryIsOneLine) {
    const Folder folder;
    const Loaded l = load(folder, "mtllib gone.mtl\nmtllib gone.mtl\nusemtl a\nusemtl b\n");
    EXPECT_THAT(l.materials.of_name, ElementsAre(-1, -1));
    ASSERT_EQ(l.warnings.lines().size(), 1u) << all_lines(l.warnings);
    EXPECT_TRUE(warned(l.warnings, {"m.obj:2: ", "gone.mtl", "not there"}));
}

TEST(Materials, SeveralLibrariesAreReadInOrderAndTheFirstDefinitionCounts) {
    const Folder folder;
    folder.write("1.mtl", "newmtl a\nKd 1 0 0\n");
    folder.write("2.mtl", "newmtl a\nKd 0 1 0\nnewmtl b\nKd 0 0 1\n");
    const Loaded l = load(folder, "mtllib 1.mtl 2.mtl\nmtllib 1.mtl\nusemtl a\nusemtl b\n");
    ASSERT_EQ(l.materials.materials.size(), 2u);
    EXPECT_EQ(l.materials.materials[0].diffuse, Vec3(1, 0, 0));
    EXPECT_EQ(l.materials.materials[1].diffuse, Vec3(0, 0, 1));
    EXPECT_EQ(all_lines(l.warnings), folder.path("2.mtl") +
                                         ":1: material 'a' is defined already; the first "
                                         "definition is used\n");
}

TEST(Materials, LibrariesThatNameEachOtherOrTheModelEnd) {
    const Folder folder;
    folder.write("a.mtl", "newmtl a\nKd 1 0 0\nmtllib b.mtl\n");
    folder.write("b.mtl", "mtllib a.mtl\nnewmtl b\n");
    folder.write("m.obj", "mtllib m.obj\n");
    const Loaded l = load(folder, "mtllib a.mtl\nmtllib m.obj\nusemtl a\n");
    EXPECT_EQ(l.materials.materials.size(), 1u);
    EXPECT_TRUE(warned(l.warnings, {"m.obj: holds no material"}));
}

TEST(Materials, LibrariesThatAreNoFilesAreRefused) {
    const Folder folder;
    folder.write("folder.mtl/keep", "");
    ASSERT_EQ(::mkfifo(folder.path("pipe.mtl").c_str(), 0600), 0);
    const Loaded l =
        load(folder, "mtllib folder.mtl\nmtllib pipe.mtl\nmtllib /dev/zero\nusemtl a\n");
    EXPECT_THAT(l.materials.of_name, ElementsAre(-1));
    EXPECT_TRUE(warned(l.warnings, {"folder.mtl: is a folder", "2 more"})) << all_lines(l.warnings);
}

TEST(Materials, ThousandsOfLibrariesAreNotLookedFor) {
    const Folder folder;
    std::string text;
    for (int i = 0; i < 5000; ++i)
        text += fmt::format("mtllib a{} b{} c d e f g h i j k l m n o p q r\n", i, i);
    const Loaded l = load(folder, text + "usemtl a\n");
    EXPECT_TRUE(warned(l.warnings, {"more than 256 material libraries"}));
    EXPECT_LE(l.warnings.lines().size(), 2u);
}

TEST(Textures, AFileThatSeveralMaterialsNameIsDecodedOnce) {
    const Folder folder;
    folder.write_picture("Maps/Wood.png", 3, 2, {10, 20, 30, 255});
    folder.write("m.mtl", "newmtl a\nmap_Kd Maps/Wood.png\nnewmtl b\nmap_Kd .\\maps\\wood.PNG\n"
                          "newmtl c\nmap_Kd -clamp on Maps/../Maps/Wood.png\n");
    const Loaded l = load(folder, "mtllib m.mtl\nusemtl a\nusemtl b\nusemtl c\n");
    EXPECT_EQ(all_lines(l.warnings), "");
    ASSERT_EQ(l.materials.textures.size(), 1u);
    EXPECT_EQ(l.materials.textures[0].image.width(), 3);
    EXPECT_EQ(l.materials.textures[0].image.at(2, 1), (image::Rgba8{10, 20, 30, 255}));
    for (const scene::Material& m : l.materials.materials)
        EXPECT_EQ(m.map_diffuse->texture, 0);
    EXPECT_EQ(l.materials.bytes, std::filesystem::file_size(folder.path("m.mtl")) + 3 * 2 * 4);
}

TEST(Textures, AreFoundBesideTheLibraryThenBesideTheModel) {
    const Folder folder;
    folder.write_picture("mtl/here.png", 1, 1, {});
    folder.write_picture("there.png", 2, 1, {});
    folder.write("mtl/m.mtl", "newmtl a\nmap_Kd here.png\nnewmtl b\nmap_Kd there.png\n");
    const Loaded l = load(folder, "mtllib mtl/m.mtl\nusemtl a\nusemtl b\n");
    EXPECT_EQ(all_lines(l.warnings), "");
    ASSERT_EQ(l.materials.textures.size(), 2u);
    EXPECT_EQ(l.materials.textures[1].image.width(), 2);
}

TEST(Textures, EachThatFailsIsOneLineAndItsMaterialIsPlain) {
    const Folder folder;
    folder.write("text.png", "this is secret text");
    folder.write(
        "m.mtl",
        "newmtl a\nmap_Kd gone.png\nnewmtl b\nmap_Kd text.png\nnewmtl c\nmap_Kd gone.png\n"
        "newmtl d\nmap_Kd ../../../../../../../../dev/zero\nnewmtl e\nmap_Kd file:///etc/shadow\n");
    const Loaded l =
        load(folder, "mtllib m.mtl\nusemtl a\nusemtl b\nusemtl c\nusemtl d\nusemtl e\n");
    EXPECT_THAT(l.materials.textures, IsEmpty());
    ASSERT_EQ(l.materials.materials.size(), 5u);
    for (const scene::Material& m : l.materials.materials)
        EXPECT_EQ(m.map_diffuse->texture, -1);
    EXPECT_EQ(l.warnings.lines().size(), 4u) << all_lines(l.warnings);
    EXPECT_TRUE(warned(l.warnings, {"m.mtl:2: map_Kd: 'gone.png' is not there"}));
    EXPECT_TRUE(warned(l.warnings, {"zero' lies outside of the model's folder"}));
    EXPECT_EQ(all_lines(l.warnings).find("secret"), std::string::npos);
}

TEST(Textures, OutsideOfTheModelsFolderAreReadWhereThatIsAllowed) {
    const Folder folder;
    folder.write_picture("shared/a.png", 1, 1, {});
    folder.write_picture("model/in/b.png", 1, 1, {});
    folder.write("shared/other.mtl", "newmtl d\n");
    const std::string absolute = folder.path("shared/a.png");
    folder.write("model/m.mtl",
                 "newmtl a\nmap_Kd ../shared/a.png\nnewmtl b\nmap_Kd ..\\shared\\A.PNG\n"
                 "newmtl c\nmap_Kd in/../../model/in/b.png\nnewmtl abs\nmap_Kd " +
                     absolute + "\nnewmtl zero\nmap_Kd /dev/zero\n");
    for (const bool allowed : {false, true}) {
        Warnings warnings;
        const auto obj =
            read_obj("v 0 0 0\nmtllib m.mtl\nmtllib ../shared/other.mtl\nusemtl a\nusemtl b\n"
                     "usemtl c\nusemtl abs\nusemtl zero\nusemtl d\n",
                     folder.path("model/m.obj"), warnings);
        const Materials got =
            load_materials(*obj, folder.path("model/m.obj"), warnings, {.allow_outside = allowed});
        ASSERT_EQ(got.materials.size(), allowed ? 6U : 5U);
        for (const int material : {0, 1, 3})
            EXPECT_EQ(got.materials[static_cast<std::size_t>(material)].map_diffuse->texture >= 0,
                      allowed)
                << material;
        EXPECT_GE(got.materials[2].map_diffuse->texture, 0) << "leads back into the folder";
        EXPECT_EQ(warned(warnings, {"m.mtl:2: map_Kd: '../shared/a.png' lies outside"}), !allowed);
        EXPECT_EQ(warned(warnings, {"material library '../shared/other.mtl' lies outside"}),
                  !allowed);
        EXPECT_EQ(warned(warnings, {"/dev/zero: is not a regular file"}), allowed);
    }
}

TEST(Textures, ABlackKdBesideAMapThatCannotBeUsedIsNoBlackHole) {
    const Folder folder;
    folder.write_picture("here.png", 1, 1, {});
    folder.write("m.mtl",
                 "newmtl gone\nKd 0 0 0\nmap_Kd gone.png\nnewmtl red\nKd 1 0 0\nmap_Kd "
                 "gone.png\nnewmtl here\nKd 0 0 0\nmap_Kd here.png\nnewmtl black\nKd 0 0 0\n");
    const Loaded l =
        load(folder, "mtllib m.mtl\nusemtl gone\nusemtl red\nusemtl here\nusemtl black\n");
    const std::vector<scene::Material>& m = l.materials.materials;
    ASSERT_EQ(m.size(), 4u);
    EXPECT_EQ(m[0].diffuse, scene::Material().diffuse) << "as a material that says nothing";
    EXPECT_EQ(m[1].diffuse, Vec3(1, 0, 0));
    EXPECT_EQ(m[2].diffuse, Vec3(1)) << "Maya's Kd 0 means the map";
    EXPECT_EQ(m[3].diffuse, Vec3(0)) << "black without a map is black";
    EXPECT_EQ(l.warnings.lines().size(), 2u) << all_lines(l.warnings);
    EXPECT_TRUE(warned(l.warnings, {"m.mtl:7: Kd is 0 beside map_Kd"}));
}

TEST(Textures, TheAlphaOfTheDiffuseMapCountsOnlyWithoutAnOpacityMap) {
    const Folder folder;
    folder.write_picture("t.png", 1, 1, {10, 20, 30, 128});
    folder.write("m.mtl", "newmtl both\nmap_Kd t.png\nmap_d t.png\nnewmtl one\nmap_Kd t.png\n"
                          "newmtl gone\nmap_Kd t.png\nmap_d gone.png\n");
    const Loaded l = load(folder, "mtllib m.mtl\nusemtl both\nusemtl one\nusemtl gone\n");
    const auto texel = [&](std::size_t material) {
        const auto& map = l.materials.materials.at(material).map_diffuse;
        return l.materials.textures.at(static_cast<std::size_t>(map.texture())).image.at(0, 0);
    };
    EXPECT_EQ(texel(0), (image::Rgba8{10, 20, 30, 255}));
    EXPECT_EQ(texel(1), (image::Rgba8{10, 20, 30, 128}));
    EXPECT_EQ(texel(2), (image::Rgba8{10, 20, 30, 128}));
    EXPECT_EQ(l.materials.textures.size(), 2u);
}

TEST(Textures, AnAlphaChannelOfZerosIsOneThatNobodyPainted) {
    const Folder folder;
    folder.write_picture("t.png", 2, 2, {10, 20, 30, 0});
    folder.write("m.mtl", "newmtl a\nmap_Kd t.png\n");
    const Loaded l = load(folder, "mtllib m.mtl\nusemtl a\n");
    EXPECT_EQ(l.materials.textures.at(0).image.at(1, 1), (image::Rgba8{10, 20, 30, 255}));
    EXPECT_TRUE(warned(l.warnings, {"m.mtl:2: map_Kd", "alpha channel of 0 everywhere"}));
}

TEST(Textures, NamesAreFoundInOtherSpellings) {
    const Folder folder;
    folder.write_picture("my tex.png", 1, 1, {1, 0, 0, 255});
    folder.write_picture("gr\xc3\xbc\xc3\xa9.png", 1, 1, {2, 0, 0, 255}); // composed
    folder.write("m.mtl", "newmtl percent\nmap_Kd my%20tex.png\n"
                          "newmtl comment\nmap_Kd my tex.png # wood\n"
                          "newmtl latin\nmap_Kd gr\xfc\xe9.png\n"
                          "newmtl decomposed\nmap_Kd gru\xcc\x88"
                          "e\xcc\x81.png\n");
    const Loaded l = load(folder, "mtllib m.mtl\nusemtl percent\nusemtl comment\nusemtl "
                                  "latin\nusemtl decomposed\n");
    EXPECT_EQ(all_lines(l.warnings), "");
    ASSERT_EQ(l.materials.materials.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(l.materials.materials[i].map_diffuse->texture, i < 2 ? 0 : 1) << i;
}

TEST(Libraries, OneOfTheModelsOwnNameStandsInForOneThatIsMissing) {
    const Folder folder;
    folder.write("m.mtl", "newmtl red\nKd 1 0 0\n");
    for (const char* named : {"mtllib old-name.mtl\nusemtl red\n", "usemtl red\n"}) {
        const Loaded l = load(folder, named);
        ASSERT_EQ(l.materials.materials.size(), 1u) << named;
        EXPECT_EQ(l.materials.materials[0].diffuse, Vec3(1, 0, 0));
        EXPECT_TRUE(warned(l.warnings, {"'m.mtl' of the model's own name is taken"}));
    }
    EXPECT_THAT(load(folder, "").materials.materials, IsEmpty()) << "nothing asks for one";
}

TEST(Libraries, TheOnlyMaterialIsThatOfAModelThatUsesNone) {
    const Folder folder;
    folder.write("one.mtl", "newmtl a\nKd 0 1 0\n");
    folder.write("two.mtl", "newmtl a\nKd 0 1 0\nnewmtl b\n");
    const Loaded one = load(folder, "mtllib one.mtl\n"), two = load(folder, "mtllib two.mtl\n");
    ASSERT_EQ(one.materials.materials.size(), 1u);
    EXPECT_EQ(one.materials.of_rest, 0);
    EXPECT_TRUE(warned(one.warnings, {"uses no material (usemtl)", "'a', is taken"}));
    EXPECT_THAT(two.materials.materials, IsEmpty());
    EXPECT_EQ(two.materials.of_rest, -1);
}

TEST(Textures, AnOpacityMapIsReadByItsAlphaWhereThatSaysSomething) {
    const Folder folder;
    folder.write_picture("grey.png", 1, 1, {100, 100, 100, 255});
    folder.write_picture("alpha.png", 1, 1, {100, 100, 100, 30});
    folder.write("m.mtl", "newmtl a\nmap_d grey.png\nnewmtl b\nmap_d alpha.png\nnewmtl c\nmap_d "
                          "-imfchan g alpha.png\nnewmtl d\nmap_d gone.png\n");
    const Loaded l = load(folder, "mtllib m.mtl\nusemtl a\nusemtl b\nusemtl c\nusemtl d\n");
    const auto& m = l.materials.materials;
    ASSERT_EQ(m.size(), 4u);
    EXPECT_EQ(m[0].map_opacity->channel, 'l');
    EXPECT_EQ(m[1].map_opacity->channel, 'm');
    EXPECT_EQ(m[2].map_opacity->channel, 'g');
    EXPECT_EQ(m[3].map_opacity->texture, -1);
    EXPECT_EQ(l.materials.textures.size(), 2u);
    EXPECT_TRUE(warned(l.warnings, {"m.mtl:8: map_d: 'gone.png' is not there"}));
}

TEST(Textures, OfOtherMapsAreReadWhereTheyCanBeSeen) {
    const Folder folder;
    for (const char* name : {"n", "b", "s", "g", "e"})
        folder.write_picture(std::string(name) + ".png", 1, 1, {});
    const std::string maps =
        "norm n.png\nmap_bump b.png\nmap_Ks s.png\nmap_Ns g.png\nmap_Ke e.png\n";
    folder.write("m.mtl", "newmtl a\nKs 1 1 1\nNs 9\nKe 1 0 0\n" + maps +
                              "newmtl b\nKs 0 0 0\nNs 9\nKe 0 0 0\n" + maps +
                              "newmtl c\nmap_Ke gone.png\nmap_bump -bm 0 b.png\n"
                              "newmtl d\nKs 0 0 0\nNs 9\nmap_Ks gone.png\nmap_Ns gone.png\n");
    const Loaded l = load(folder, "mtllib m.mtl\nusemtl a\nusemtl b\nusemtl c\nusemtl d\n");
    const std::vector<scene::Material>& m = l.materials.materials;
    ASSERT_EQ(m.size(), 4u);
    for (const auto map :
         {&scene::Material::map_normal, &scene::Material::map_bump, &scene::Material::map_specular,
          &scene::Material::map_shininess, &scene::Material::map_emission})
        EXPECT_GE((m[0].*map)->texture, 0);
    EXPECT_EQ(l.materials.textures.size(), 5u);
    EXPECT_GE(m[1].map_normal->texture, 0);
    EXPECT_EQ(m[1].map_specular->texture, -1) << "black Ks: nothing to see";
    EXPECT_EQ(m[1].map_shininess->texture, -1);
    EXPECT_EQ(m[1].map_emission->texture, -1);
    EXPECT_EQ(m[2].map_bump->texture, -1);
    EXPECT_EQ(m[2].emission, Vec3(0)) << "a colour that only the map gives is gone with it";
    EXPECT_EQ(all_lines(l.warnings),
              folder.path("m.mtl") + ":20: map_Ke: 'gone.png' is not there; drawn plain\n")
        << "and no word of what no picture lacks";
}

TEST(Textures, AMapBumpOfNormalsIsANormalMap) {
    const Folder folder;
    folder.write_picture("normals.png", 4, 4, {140, 120, 254, 255});
    folder.write_picture("heights.png", 4, 4, {200, 200, 200, 255});
    folder.write(
        "m.mtl",
        "newmtl a\nmap_bump -bm 1 -clamp on normals.png\nnewmtl b\nmap_bump heights.png\n");
    const Loaded l = load(folder, "mtllib m.mtl\nusemtl a\nusemtl b\n");
    const std::vector<scene::Material>& m = l.materials.materials;
    ASSERT_EQ(m.size(), 2u);
    EXPECT_GE(m[0].map_normal->texture, 0);
    EXPECT_EQ(m[0].map_normal->wrap_v, scene::Wrap::clamp);
    EXPECT_EQ(m[0].map_bump->texture, -1);
    EXPECT_EQ(m[1].map_normal->texture, -1);
    EXPECT_GE(m[1].map_bump->texture, 0);
    EXPECT_EQ(all_lines(l.warnings), "");
}

// Baked maps have normals on the islands of the faces alone, and any colour between them.
TEST(Textures, AMapBumpOfNormalsWhereFacesAreIsANormalMap) {
    for (const image::Rgba8 background : std::vector<image::Rgba8>{
             {0, 0, 0, 255}, {255, 255, 255, 255}, {200, 60, 10, 255}, {0, 0, 0, 0}}) {
        image::Image picture(64, 64, {140, 120, 254, 255});
        for (int y = 0; y < 24; ++y) // rows from the top: v above 0.625
            for (int x = 0; x < 64; ++x)
                picture.at(x, y) = background;
        const Folder folder;
        folder.write_picture("n.png", picture);
        folder.write("m.mtl",
                     "newmtl low\nmap_bump -clamp on n.png\nnewmtl whole\nmap_bump n.png\n"
                     "newmtl scaled\nmap_bump -s 1 0.5 1 n.png\nnewmtl none\nmap_bump n.png\n");
        const std::string faces = "f 1/1 2/2 3/3 4/4\n";
        const Loaded l = load(
            folder, "mtllib m.mtl\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 0.6\nvt 0 0.6\n"
                    "vt 1 1\nvt 0 1\nusemtl low\n" +
                        faces + "usemtl whole\n" + faces + "f 1/1 2/2 3/5 4/6\nusemtl scaled\n" +
                        "f 1/1 2/2 3/5 4/6\nusemtl none\nf 1 2 3 4\n");
        const std::vector<scene::Material>& m = l.materials.materials;
        ASSERT_EQ(m.size(), 4u);
        EXPECT_GE(m[0].map_normal->texture, 0);
        EXPECT_EQ(m[1].map_normal->texture, -1) << "a face shows the background";
        EXPECT_GE(m[1].map_bump->texture, 0);
        EXPECT_GE(m[2].map_normal->texture, 0);
        EXPECT_EQ(m[3].map_normal->texture, -1) << "nothing says where it is seen";
    }
}

TEST(Textures, HundredsThatFailAreTwentyLinesAndOneMore) {
    const Folder folder;
    std::string mtl, obj = "mtllib m.mtl\n";
    for (int i = 0; i < 300; ++i) {
        mtl += fmt::format("newmtl m{}\nmap_Kd gone{}.png\n", i, i);
        obj += fmt::format("usemtl m{}\n", i);
    }
    folder.write("m.mtl", mtl);
    const Loaded l = load(folder, obj);
    EXPECT_EQ(l.warnings.lines().size(), 21u);
    EXPECT_TRUE(warned(l.warnings, {"gone20.png", "279 more"}));
}

TEST(Materials, WhatIsNotDrawnYetIsOneLineALibrary) {
    const Folder folder;
    folder.write("m.mtl",
                 "newmtl a\ndisp b.png\nnewmtl b\ndecal s.png\ndisp c.png\nnewmtl c\nd 0.5\n");
    const Loaded l = load(folder, "mtllib m.mtl\nusemtl a\nusemtl b\n");
    EXPECT_EQ(all_lines(l.warnings),
              folder.path("m.mtl") + ": disp, decal are read but not drawn yet\n");
}

TEST(Materials, WhatChangesNothingIsNotNamed) {
    const Folder folder;
    folder.write("m.mtl", "newmtl a\nKd .8 .8 .8\nPr 0.5\nPm 0\nPs 0\nPc 0.0\nPcr 0\naniso 0\n"
                          "anisor 0\nTf 1 1 1\nillum 2\nnewmtl b\nPc 0.5\nPcr 0\nillum 3\n"
                          "newmtl c\nTf 0.5 1 1\nillum 4\n");
    const Loaded l = load(folder, "mtllib m.mtl\nusemtl a\nusemtl b\nusemtl c\n");
    EXPECT_EQ(all_lines(l.warnings), folder.path("m.mtl") + ": Pc is read but not drawn yet\n");
}

TEST(Materials, WhatARayTracerWouldDrawIsNamed) {
    const Folder folder;
    folder.write("m.mtl", "newmtl glass\nKd .8 .8 .8\nTf 0.1 0.9 0.1\nillum 6\n"
                          "newmtl mirror\nKs 1 1 1\nillum 3\n");
    const Loaded l = load(folder, "mtllib m.mtl\nusemtl glass\nusemtl mirror\n");
    EXPECT_EQ(all_lines(l.warnings),
              folder.path("m.mtl") + ": Tf, illum 6, illum 3 are read but not drawn yet\n");
}

TEST(Materials, KeywordsAreReadInAnyCase) {
    const Folder folder;
    folder.write("m.mtl", "NEWMTL a\nKD .8 0 0\nNewMtl B\nkd 0 .5 0\n");
    const Loaded l = load(folder, "mtllib m.mtl\nusemtl a\nusemtl B\n");
    EXPECT_EQ(all_lines(l.warnings), "");
    ASSERT_EQ(l.materials.materials.size(), 2u);
    EXPECT_EQ(l.materials.materials[0].diffuse, Vec3(.8F, 0, 0));
    EXPECT_EQ(l.materials.materials[1].diffuse, Vec3(0, .5F, 0));
}

} // namespace
} // namespace scanout::io
