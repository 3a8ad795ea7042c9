#include "folder.h"
#include "io/obj/mtl.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanout::io {
namespace {

using test::all_lines;
using test::warned;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct MtlRead {
    std::vector<MtlMaterial> materials;
    Warnings warnings;
    const scene::Material& first() const { return materials.at(0).material; }
};

MtlRead read_text(const std::string& text) {
    MtlRead r;
    r.materials = read_mtl(text, "x.mtl", r.warnings);
    return r;
}

MtlRead read_one(const std::string& statements) {
    return read_text("newmtl m\n" + statements + "\n");
}

TEST(Mtl, ReadsEveryValue) {
    const MtlRead r =
        read_one("  Kd 0.1 0.2 0.3\r\n\tKa 1 2 3\nKs .5 .5 .5\nKe 0 1 0\nTf 0.9 0.8 0.7\nNs 96.5\n"
                 "Ni 1.45\nillum 7\nd 0.25");
    EXPECT_EQ(all_lines(r.warnings), "");
    const scene::Material& m = r.first();
    EXPECT_EQ(m.name, "m");
    EXPECT_EQ(m.diffuse, Vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(m.ambient, Vec3(1, 2, 3));
    EXPECT_EQ(m.specular, Vec3(0.5f));
    EXPECT_EQ(m.emission, Vec3(0, 1, 0));
    EXPECT_EQ(m.transmission, Vec3(0.9f, 0.8f, 0.7f));
    EXPECT_EQ(m.shininess, 96.5f);
    EXPECT_EQ(m.refraction, 1.45f);
    EXPECT_EQ(m.illumination, 7);
    EXPECT_EQ(m.opacity, 0.25f);
    EXPECT_THAT(r.materials[0].not_drawn, testing::ElementsAre("Tf", "illum 7"));
}

TEST(Mtl, WhatNoMaterialCanHaveIsNamedAndCounted) {
    const MtlRead r = read_one("Ns 1e30\nNs 2e30\nKd -1 2 1e30\nd 7\nd 1\nPm -3");
    EXPECT_EQ(r.first().shininess, 1e6F);
    EXPECT_EQ(r.first().metalness, 0.0F);
    for (const char* line :
         {"x.mtl:2: Ns is 1e+30, which is not between 0 and 1000000; 1000000 is taken",
          "x.mtl:4: Kd is -1, which is not between 0 and 1000000; 0 is taken",
          "x.mtl:5: d is 7, which is not between 0 and 1; 1 is taken",
          "x.mtl:7: Pm is -3, which is not between 0 and 1; 0 is taken"})
        EXPECT_TRUE(warned(r.warnings, {line})) << line << '\n' << all_lines(r.warnings);
    EXPECT_EQ(r.warnings.count("MTL Ns"), 2u);
    EXPECT_EQ(r.warnings.count("MTL Kd"), 2u) << "a channel each";
    EXPECT_EQ(r.warnings.count("MTL d"), 1u);
}

TEST(Mtl, NamesMayHoldBlanksAndEndWithTabs) {
    const MtlRead r = read_text("newmtl\ta b  c\t\t\r\nKd 1 0 0\r\n newmtl d\rKd 0 1 0");
    ASSERT_EQ(r.materials.size(), 2u);
    EXPECT_EQ(r.materials[0].material.name, "a b  c");
    EXPECT_EQ(r.materials[1].material.name, "d");
    EXPECT_EQ(r.materials[1].line, 3u);
    EXPECT_EQ(r.materials[1].material.diffuse, Vec3(0, 1, 0));
}

TEST(Mtl, DissolveAndTransparencyAgreeOnWhatCanBeSeen) {
    const auto opacity = [](const std::string& text) { return read_one(text).first().opacity; };
    EXPECT_EQ(opacity(""), 1);
    EXPECT_EQ(opacity("d 0.75"), 0.75f);
    EXPECT_EQ(opacity("d -halo 0.5"), 0.5f);
    EXPECT_EQ(opacity("Tr 0.25"), 0.75f);
    EXPECT_EQ(opacity("Tr 0"), 1);
    EXPECT_EQ(opacity("Tr 1.000000"), 1)
        << "a material that cannot be seen is not what the exporter meant";
    EXPECT_EQ(opacity("d 0.75\nTr 0.5"), 0.75f) << "d wins";
    EXPECT_EQ(opacity("Tr 0.5\nd 0.75"), 0.75f) << "in any order";
    EXPECT_EQ(opacity("d 1\nTr 1"), 1);
    EXPECT_EQ(opacity("d 7"), 1);
    EXPECT_EQ(opacity("d -7"), 1) << "0 hides the material, which nobody means";
    EXPECT_EQ(opacity("d 0"), 1);
    EXPECT_EQ(opacity("d 0\nTr 0.5"), 1);
    EXPECT_TRUE(warned(read_one("d 0").warnings, {"d 0 would hide the material"}));
}

TEST(Mtl, ColoursThatAreNotThreeNumbersKeepTheDefaultAndSaySo) {
    EXPECT_EQ(read_one("Kd 0.5").first().diffuse, Vec3(0.5f)) << "one number is a grey";
    for (const char* bad : {"Kd", "Kd 0.1 0.2", "Kd nan 0 0", "Kd 0 inf 0", "Kd 1e400 0 0", "Kd x",
                            "Kd spectral file.rfl 1", "Kd xyz 0.3 0.3 0.3"}) {
        const MtlRead r = read_one(bad);
        EXPECT_EQ(r.first().diffuse, scene::Material().diffuse) << bad;
        EXPECT_TRUE(warned(r.warnings, {"x.mtl:2: ", "default"})) << bad << all_lines(r.warnings);
    }
    EXPECT_EQ(read_one("Kd -1 2 1e30").first().diffuse, Vec3(0, 2, 1e6f))
        << "finite in all that follows";
}

TEST(Mtl, MapsKeepTheirOptionsAndTheirNames) {
    const MtlRead r =
        read_one("map_Kd -o 0.1 -s 2 3 -t 1 2 3 -clamp on -blendu off -blendv off -cc "
                 "on -mm 0.1 0.3 -boost 2 "
                 "-texres 512 some dir\\my file 01.png\n"
                 "map_bump -imfchan r bump 2.jpg -bm 1.5\nrefl -type sphere "
                 "sky.tga\nnorm -bm 3 -colorspace linear n.png\n"
                 "map_Ka a.png\nmap_Ks b.png\nmap_Ns c.png\nmap_d d.png\nmap_Ke "
                 "e.png\ndisp f.png\ndecal g.png");
    EXPECT_EQ(all_lines(r.warnings), "");
    const scene::TextureMap& kd = r.first().map_diffuse;
    EXPECT_EQ(kd.path, "some dir\\my file 01.png");
    EXPECT_EQ(kd.offset, Vec3(0.1f, 0, 0));
    EXPECT_EQ(kd.scale, Vec3(2, 3, 1));
    EXPECT_EQ(kd.turbulence, Vec3(1, 2, 3));
    EXPECT_TRUE(kd.wrap_u == scene::Wrap::clamp && kd.wrap_v == scene::Wrap::clamp &&
                kd.colour_correction && !kd.blend_u && !kd.blend_v);
    EXPECT_EQ(kd.base, 0.1f);
    EXPECT_EQ(kd.gain, 0.3f);
    EXPECT_EQ(kd.boost, 2);
    EXPECT_EQ(kd.resolution, 512);
    EXPECT_EQ(r.first().map_bump->path, "bump 2.jpg");
    EXPECT_EQ(r.first().map_bump->bump_multiplier, 1.5f) << "an option behind the name";
    EXPECT_EQ(r.first().map_bump->channel, 'r');
    EXPECT_EQ(r.first().map_reflection->reflection_type, "sphere");
    EXPECT_EQ(r.first().map_normal->path, "n.png");
    EXPECT_EQ(r.first().map_normal->bump_multiplier, 3);
    EXPECT_EQ(r.first().map_decal->path, "g.png");
    EXPECT_THAT(r.materials[0].not_drawn,
                ElementsAre("map_Ka", "disp", "decal", "refl", "map_Kd -t", "map_Kd -mm",
                            "map_Kd -boost", "map_Kd -cc", "map_Kd -blendu off",
                            "map_Kd -blendv off", "map_Kd -texres"));
}

TEST(Mtl, AResolutionOfAnySizeIsOne) {
    const auto resolution = [](const std::string& texels) {
        return read_one("map_Kd -texres " + texels + " a.png").first().map_diffuse->resolution;
    };
    EXPECT_EQ(resolution("65536"), 65536);
    EXPECT_EQ(resolution("-7.5"), -7);
    for (const char* beyond : {"65537", "55555555555512", "1e30", "-1e30", "1e300"})
        EXPECT_EQ(resolution(beyond), 65536) << beyond;
}

TEST(Mtl, FileNamesThatLookLikeOptionsOrNumbersStayWhole) {
    EXPECT_EQ(read_one("map_Kd -s 1 1 1 01.png").first().map_diffuse->path, "01.png");
    EXPECT_EQ(read_one("map_Kd a -b.png").first().map_diffuse->path, "a -b.png");
    EXPECT_EQ(read_one("map_Kd a -s.png").first().map_diffuse->path, "a -s.png");
    EXPECT_EQ(read_one("map_Kd -b.png").first().map_diffuse->path, "-b.png");
    EXPECT_EQ(read_one("map_Kd -s.png 1 2").first().map_diffuse->path, "-s.png 1 2");
    EXPECT_EQ(read_one("map_Kd \"a b.png\"").first().map_diffuse->path, "a b.png");
    EXPECT_EQ(read_one("map_Kd .\\a.jpg").first().map_diffuse->path, ".\\a.jpg");
    const MtlRead none = read_one("map_Kd\nmap_bump -bm 1");
    EXPECT_FALSE(none.first().map_diffuse.given());
    EXPECT_FALSE(none.first().map_bump.given());
    EXPECT_TRUE(warned(none.warnings, {"x.mtl:2: map_Kd names no file", "1 more"}));
}

TEST(Mtl, OptionsThatAreNotKnownAreLeftOutInOneLine) {
    const MtlRead r =
        read_one("map_Kd -s 2 -unknown 3 4 -clamp on -other a.png\nmap_Ks -new b.png");
    EXPECT_EQ(r.first().map_diffuse->path, "a.png");
    EXPECT_EQ(r.first().map_diffuse->scale.x, 2);
    EXPECT_EQ(r.first().map_diffuse->wrap_u, scene::Wrap::clamp);
    EXPECT_EQ(r.first().map_specular->path, "b.png");
    EXPECT_TRUE(warned(r.warnings, {"x.mtl:2: an option of a map is not known", "2 more"}))
        << all_lines(r.warnings);
}

TEST(Mtl, NumbersOfOptionsThatAreTooLargeAreLimitedInOneLineAName) {
    const MtlRead r =
        read_one("map_bump -bm 1e30 a.png\nmap_Kd -s 3 -1e9 b.png\nmap_Ks -o 5 c.png");
    EXPECT_EQ(r.first().map_bump->bump_multiplier, 1e6F);
    EXPECT_EQ(r.first().map_diffuse->scale, Vec3(3, -1e6F, 1));
    EXPECT_TRUE(warned(r.warnings, {"x.mtl:2: map_bump -bm is 1e+30", "1000000 is taken"}))
        << all_lines(r.warnings);
    EXPECT_TRUE(warned(r.warnings, {"x.mtl:3: map_Kd -s is -1000000000", "-1000000 is taken"}))
        << all_lines(r.warnings);
    EXPECT_EQ(all_lines(r.warnings).find("map_Ks"), std::string::npos);
}

TEST(Mtl, AMapWithoutAColourShowsItsOwnColours) {
    EXPECT_EQ(read_one("map_Kd a.png").first().diffuse, Vec3(1));
    EXPECT_EQ(read_one("map_Kd a.png\nKd 0.5 0 0").first().diffuse, Vec3(0.5f, 0, 0));
    EXPECT_EQ(read_one("map_Ks a.png").first().specular, Vec3(1));
    EXPECT_EQ(read_one("Ks 0 0 0\nmap_Ks a.png").first().specular, Vec3(0));
    EXPECT_EQ(read_one("map_Ke a.png").first().emission, Vec3(1));
    EXPECT_EQ(read_one("Ke 0 0.5 0\nmap_Ke a.png").first().emission, Vec3(0, 0.5f, 0));
    EXPECT_EQ(read_one("Kd 1 1 1").first().emission, Vec3(0));
}

TEST(Mtl, NoMessageQuotesTheFile) {
    const MtlRead r = read_text(
        "secret password\nnewmtl m\nroot:x:0:0\nKd secret\nmap_Kd -bm secret\nNs hidden\n");
    EXPECT_FALSE(r.warnings.empty());
    for (const char* word : {"secret", "root", "hidden", "password"})
        EXPECT_EQ(all_lines(r.warnings).find(word), std::string::npos) << all_lines(r.warnings);
    const MtlRead other = read_text("root:x:0:0:root:/root:/bin/bash\n");
    EXPECT_THAT(other.materials, IsEmpty());
    EXPECT_TRUE(other.warnings.empty());
}

TEST(Mtl, AMapOfRoughnessOrMetalnessAloneMeansItsOwnNumbers) {
    const auto alone = read_one("map_Pr r.tex\nmap_Pm -imfchan b m.tex").materials[0];
    EXPECT_EQ(alone.material.map_roughness->path, "r.tex");
    EXPECT_EQ(alone.material.map_metalness->path, "m.tex");
    EXPECT_EQ(alone.material.map_metalness->channel, 'b');
    EXPECT_EQ(alone.material.roughness, 1.0F);
    EXPECT_EQ(alone.material.metalness, 1.0F);
    EXPECT_TRUE(alone.roughness_by_map && alone.metalness_by_map);
    EXPECT_THAT(alone.not_drawn, IsEmpty());
    const auto beside = read_one("map_Pr r.tex\nPr 0.25\nmap_Pm m.tex\nPm 0").materials[0];
    EXPECT_EQ(beside.material.roughness, 0.25F);
    EXPECT_EQ(beside.material.metalness, 0.0F);
    EXPECT_FALSE(beside.roughness_by_map || beside.metalness_by_map);
}

TEST(Mtl, KnownValuesThatAreNotDrawnAreNamed) {
    EXPECT_THAT(read_one("Pr 0.2\nPm 0.3\nmap_Ps r.tex\nKt 1 1 1").materials[0].not_drawn,
                ElementsAre("map_Ps", "Kt"));
    EXPECT_THAT(read_one("Kd 1 1 1\nKa 1 1 1\nKs 0 0 0\nKe 0 0 0\nd 1\nillum 2\nmap_Kd -o 1 -s 2 "
                         "-clamp on a.png")
                    .materials[0]
                    .not_drawn,
                IsEmpty());
}

} // namespace
} // namespace scanout::io
