// Which format a file has, and what comes packed or through a pipe.
#include "folder.h"
#include "io/formats.h"
#include "io/gzip.h"
#include "io/load.h"

#include <cstdlib>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

namespace scanout::io {
namespace {

using test::Folder;
using ::testing::HasSubstr;

const std::string kObjText = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string kPlyText = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty "
                             "float y\nproperty float z\nelement face 1\nproperty list uchar int "
                             "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
const std::string kOffText = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

std::string gzipped(const std::string& text) {
    std::string out(::compressBound(text.size()) + 64, '\0');
    z_stream stream{};
    EXPECT_EQ(::deflateInit2(&stream, 9, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
    stream.avail_in = static_cast<uInt>(text.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    EXPECT_EQ(::deflate(&stream, Z_FINISH), Z_STREAM_END);
    out.resize(stream.total_out);
    ::deflateEnd(&stream);
    return out;
}

TEST(Formats, TheContentDecidesBeforeTheName) {
    const Folder folder;
    for (const std::string& content : {kPlyText, kOffText, kObjText})
        for (const char* name : {"a.obj", "a.ply", "a.off", "a.stl", "a.txt", "a"}) {
            const auto told = tell_format(content, content.size(), name);
            // Nothing in an OBJ's first line tells it: its name or the look of its lines does.
            if (content == kObjText &&
                (std::string_view(name) == "a.ply" || std::string_view(name) == "a.off" ||
                 std::string_view(name) == "a.stl"))
                continue;
            ASSERT_TRUE(told) << name << ": " << told.error().what;
            EXPECT_EQ(*told, content == kPlyText   ? ModelFormat::ply
                             : content == kOffText ? ModelFormat::off
                                                   : ModelFormat::obj)
                << name;
        }
}

// However large the file is.
TEST(Formats, OnlyTheFirst64KilobytesTell) {
    const std::string start = "{" + std::string(65535, ' ');
    const std::string near = start.substr(0, 1000) + "\"asset\"", far = start + "\"asset\"";
    EXPECT_EQ(*tell_format(near, 2000, "a.obj"), ModelFormat::gltf);
    EXPECT_EQ(*tell_format(far, 70000, "a.obj"), ModelFormat::obj);
}

TEST(Formats, AFormatThatIsNotReadIsNamed) {
    const struct {
        const char *path, *head, *name;
    } kCases[] = {
        {"a.3mf", "PK\3\4",
         "a.3mf: 3MF is not read; formats that are: .obj .stl .ply .off .gltf .glb"},
        {"a.usda", "#usda 1.0", "a.usda: USD is not read"},
        {"a.fbx", "Kaydara FBX Binary", "a.fbx: FBX is not read"},
        {"a.dae", "<?xml?><COLLADA>", "a.dae: Collada is not read"},
        {"a.amf", "<?xml?><amf>", "a.amf: AMF is not read"},
        {"a.drc", "DRACO", "a.drc: Draco is not read"},
        {"a.xyz", "1 2 3\n", "a.xyz: point list is not read"},
        {"a.doc", "nothing", "a.doc: the extension '.doc' is not known"},
        {"a", "nothing", "a: neither its content nor its name tells a format"},
        {"a.dat", "\x89PNG", "a.dat: is a PNG picture, not a model"},
    };
    for (const auto& c : kCases) {
        const auto told = tell_format(c.head, 100, c.path);
        ASSERT_FALSE(told) << c.path;
        EXPECT_EQ(told.error().exit, Exit::unreadable);
        EXPECT_THAT(told.error().what, HasSubstr(c.name));
    }
}

TEST(Formats, EveryFormatIsReadFromAGzipFile) {
    const Folder folder;
    for (const auto& [name, content] : {std::pair{"a.obj.gz", kObjText},
                                        {"a.ply.gz", kPlyText},
                                        {"a.off.gz", kOffText},
                                        {"a.gz", kPlyText}}) {
        Warnings warnings;
        const auto scene = load(folder.write(name, gzipped(content)), {}, warnings);
        ASSERT_TRUE(scene) << scene.error().what;
        EXPECT_EQ(scene->counts.faces, 1u) << name;
    }
}

TEST(Gzip, MembersFollowOneAnother) {
    const std::string packed = gzipped("one ") + gzipped("two") + std::string(512, '\0');
    const auto text = gunzip(packed, "a", 1000);
    ASSERT_TRUE(text) << text.error().what;
    EXPECT_EQ(text->text(), "one two");
}

TEST(Gzip, WhatIsCutShortOrDamagedSaysSo) {
    std::string packed = gzipped(kPlyText);
    EXPECT_THAT(gunzip(packed.substr(0, packed.size() / 2), "a", 1000).error().what,
                HasSubstr("a: the gzip file is cut short"));
    packed[packed.size() / 2] = static_cast<char>(packed[packed.size() / 2] ^ 0x55);
    EXPECT_THAT(gunzip(packed, "a", 1000).error().what, HasSubstr("a: the gzip file is damaged"));
}

TEST(Gzip, ABombIsRefusedWhileItUnpacks) {
    const std::string packed = gzipped(std::string(std::size_t{300} << 20, '\0'));
    const auto bomb = gunzip(packed, "a", 64 << 20);
    ASSERT_FALSE(bomb);
    EXPECT_EQ(bomb.error().exit, Exit::unreadable);
    EXPECT_THAT(bomb.error().what, HasSubstr("a: holds more than the 67 MB"));
    const Folder folder;
    Warnings warnings;
    EXPECT_FALSE(load(folder.write("bomb.obj.gz", packed), {}, warnings)) << "200 times its size";
}

TEST(Formats, TheFormatThatTheUserNamesIsRead) {
    const Folder folder;
    Warnings warnings;
    LoadOptions options;
    options.format = ModelFormat::obj;
    EXPECT_TRUE(load(folder.write("a.dat", kObjText), options, warnings));
    options.format = ModelFormat::ply;
    EXPECT_THAT(load(folder.path("a.dat"), options, warnings).error().what,
                HasSubstr("not a PLY file"));
    EXPECT_EQ(format_named("off").value(), ModelFormat::off);
    EXPECT_THAT(format_named("dwg").error().what, HasSubstr("known are obj stl ply off"));
}

// 01-stl-crease: an edge of 45 degrees stays sharp in STL, although it is smooth elsewhere.
TEST(Formats, AnStlKeepsEdgesAbove29DegreesSharp) {
    const Folder folder;
    const std::string stl =
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
        "endloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 0 0 0\nvertex 0 "
        "-1 -1\nendloop\nendfacet\nendsolid a\n";
    const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 -1\nf 1 2 3\nf 2 1 4\n";
    Warnings warnings;
    const auto sharp = load(folder.write("a.stl", stl), {}, warnings);
    const auto smooth = load(folder.write("a.obj", obj), {}, warnings);
    ASSERT_TRUE(sharp && smooth);
    EXPECT_EQ(sharp->mesh.position.size(), 6u) << "no vertex is shared across the edge";
    EXPECT_EQ(smooth->mesh.position.size(), 4u);
}

// 06-vertex-colour-space: colours are display values, and nothing dims them.
TEST(Formats, VertexColoursAreDisplayValuesThatTheDefaultMaterialDoesNotDim) {
    const Folder folder;
    const std::string obj = "v 0 0 0 0.5 0.25 0.75\nv 1 0 0 0.5 0.25 0.75\nv 0 1 0 0.5 0.25 0.75\n"
                            "f 1 2 3\n";
    Warnings warnings;
    const auto scene = load(folder.write("a.obj", obj), {}, warnings);
    ASSERT_TRUE(scene);
    EXPECT_NEAR(scene->mesh.colour[0].x, 0.21404114, 1e-6);
    ASSERT_EQ(scene->mesh.material[0], 0);
    EXPECT_EQ(scene->materials[0].diffuse, Vec3(1));
}

} // namespace
} // namespace scanout::io
