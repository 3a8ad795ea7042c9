#include "base/mapping.h"
#include "geom/build.h"
#include "io/stl/stl.h"
#include "math/srgb.h"
#include "same.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::io {
namespace {

using Facet = std::array<DVec3, 3>;
using ::testing::Test;

void put(std::string& bytes, std::uint32_t value) {
    for (int i = 0; i < 4; ++i)
        bytes += static_cast<char>(value >> 8 * i & 0xff);
}

std::string binary(const std::vector<Facet>& facets, const std::string& title = "made by a test") {
    std::string bytes = title;
    bytes.resize(80, ' ');
    put(bytes, static_cast<std::uint32_t>(facets.size()));
    for (const Facet& facet : facets) {
        bytes.append(12, '\0');
        for (const DVec3& v : facet)
            for (int axis = 0; axis < 3; ++axis)
                put(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(v[axis])));
        bytes.append(2, '\0');
    }
    return bytes;
}

std::string with_count(std::string bytes, std::uint32_t count) {
    std::string four;
    put(four, count);
    return bytes.replace(80, 4, four);
}

std::string ascii(const std::vector<Facet>& facets) {
    std::string text = "solid made by a test\n";
    for (const Facet& facet : facets) {
        text += "  facet normal 0 0 0\n    outer loop\n";
        for (const DVec3& v : facet)
            text += fmt::format("      vertex {} {} {}\n", v.x, v.y, v.z);
        text += "    endloop\n  endfacet\n";
    }
    return text + "endsolid made by a test\n";
}

struct StlRead {
    Result<StlResult> result;
    std::vector<std::string> warnings;

    std::string error() const { return result ? "no error" : result.error().what; }
};

StlRead read_facets(std::string_view file) {
    Warnings warnings;
    auto result = read_stl(file, "a.stl", warnings, {});
    // In parts it is the same, whatever a test is about.
    EXPECT_EQ(test::difference_in_parts(result, warnings, file,
                                        {file.size() / 40 + 1, file.size() / 7 + 3},
                                        [](std::string_view t, Warnings& w, const Reading& how) {
                                            return read_stl(t, "a.stl", w, {}, how);
                                        }),
              "");
    return {std::move(result), warnings.lines()};
}

std::vector<Facet> facets_of(const StlResult& stl) {
    std::vector<Facet> facets;
    const geom::PolygonMesh& m = stl.polygons;
    for (std::size_t c = 0; c < m.corners.size(); ++c) {
        if (c % 3 == 0) facets.emplace_back();
        facets.back()[c % 3] = m.positions.at(static_cast<std::size_t>(m.corners[c].position));
    }
    return facets;
}

std::vector<Facet> random_facets(std::uint32_t seed, std::size_t count) {
    std::mt19937 random(seed);
    std::vector<Facet> facets(count);
    for (Facet& facet : facets)
        for (DVec3& v : facet)
            for (int axis = 0; axis < 3; ++axis)
                v[axis] = static_cast<float>(static_cast<int>(random() % 5) - 2) * 1.7f;
    return facets;
}

const std::vector<Facet> kTwo{Facet{DVec3(0, 0, 0), DVec3(1, 0, 0), DVec3(0, 1, 0)},
                              Facet{DVec3(1, 0, 0), DVec3(1, 1, 0), DVec3(0, 1, 0)}};

RC_GTEST_PROP(Stl, BinaryAndAsciiGiveBackEveryFacetInOrder, (std::uint32_t seed)) {
    const std::vector<Facet> facets = random_facets(seed, *rc::gen::inRange<std::size_t>(1, 60));
    for (const std::string& file :
         {binary(facets), binary(facets, "solid but binary"), ascii(facets)}) {
        const StlRead r = read_facets(file);
        RC_ASSERT(r.result.has_value() && r.warnings.empty());
        RC_ASSERT(facets_of(*r.result) == facets);
        RC_ASSERT(r.result->facets == facets.size() && r.result->skipped == 0u);
        RC_ASSERT(r.result->polygons.face_begin.size() == facets.size());
        RC_ASSERT(r.result->polygons.face_material.size() == facets.size());
    }
}

RC_GTEST_PROP(Stl, NoTwoPositionsAreEqual, (std::uint32_t seed)) {
    const StlRead r = read_facets(ascii(random_facets(seed, 40)));
    const auto& p = r.result->polygons.positions;
    for (std::size_t i = 0; i < p.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            RC_ASSERT(p[i] != p[j]);
}

RC_GTEST_PROP(Stl, AFileCutAnywhereGivesItsWholeFacetsOrOneLine, (std::uint32_t seed)) {
    const std::vector<Facet> facets = random_facets(seed, 6);
    for (const std::string& whole : {binary(facets), ascii(facets)}) {
        const std::string file = whole.substr(0, *rc::gen::inRange<std::size_t>(0, whole.size()));
        const StlRead r = read_facets(file);
        if (r.result) {
            const std::vector<Facet> got = facets_of(*r.result);
            RC_ASSERT(got.size() <= facets.size());
            RC_ASSERT(std::equal(got.begin(), got.end(), facets.begin()));
        } else {
            RC_ASSERT(r.result.error().exit == Exit::unreadable);
            RC_ASSERT(r.error().starts_with("a.stl:") && r.error().find('\n') == std::string::npos);
        }
    }
}

RC_GTEST_PROP(Stl, AnyBytesEndInFacetsOrOneLine, (std::string bytes, bool as_ascii)) {
    for (const std::string& file :
         {bytes,
          (as_ascii ? "solid\nfacet vertex 1 2 3 vertex " : std::string(84, '\1')) + bytes}) {
        const StlRead r = read_facets(file);
        if (!r.result)
            RC_ASSERT(r.error().starts_with("a.stl:") && r.error().find('\n') == std::string::npos);
    }
}

RC_GTEST_PROP(Stl, ADamagedFileLosesOnlyTheFacetsThatAreHit, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    const std::vector<Facet> facets = random_facets(seed, 30);
    std::string file = binary(facets);
    const std::size_t hit = random() % 30;
    const std::uint32_t nan = 0x7fc00000;
    std::memcpy(&file[84 + 50 * hit + 12 + 4 * (random() % 9)], &nan, 4);
    std::vector<Facet> left = facets;
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(hit));
    const StlRead r = read_facets(file);
    RC_ASSERT(facets_of(*r.result) == left && r.result->skipped == 1u && r.warnings.size() == 1u);
    RC_ASSERT(r.warnings[0].find(fmt::format("facet {}", hit + 1)) != std::string::npos);
}

TEST(Stl, KeepsDoublesOfAsciiAndJoinsMinusZero) {
    const StlRead r = read_facets(
        "solid\nfacet normal 0 0 1\nouter loop\nvertex 581311.123456789 -0 1e-3\nvertex "
        "+1.5E+2 0.0 0.1\nvertex 0 0.0 -0.0\nendloop\nendfacet\nfacet vertex -0 0 0 "
        "vertex 1 1 1 vertex 2 2 3 endfacet");
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.result->polygons.positions[0], DVec3(581311.123456789, 0, 1e-3));
    EXPECT_EQ(r.result->polygons.positions[1], DVec3(150, 0, 0.1));
    EXPECT_EQ(r.result->polygons.corners[2].position, r.result->polygons.corners[3].position);
    EXPECT_EQ(r.result->facets, 2u);
}

TEST(Stl, LineEndsCaseAndLayoutDoNotMatter) {
    const std::string text = ascii(kTwo);
    for (const char* end : {"\r\n", "\r", "\n\n"}) {
        std::string other;
        for (const char c : text)
            c == '\n' ? other += end : other += c;
        const StlRead r = read_facets(other);
        ASSERT_TRUE(r.result) << r.error();
        EXPECT_EQ(facets_of(*r.result), kTwo);
        EXPECT_TRUE(r.warnings.empty());
    }
    std::string upper = "\xef\xbb\xbf\n \t";
    for (const char c : text)
        upper += static_cast<char>(std::toupper(c));
    EXPECT_EQ(facets_of(*read_facets(upper).result), kTwo);
    EXPECT_EQ(facets_of(*read_facets(text.substr(text.find("facet"))).result),
              kTwo); // no solid line
}

TEST(Stl, ReadsEverySolidOfAFile) {
    const StlRead r =
        read_facets(ascii(kTwo) + ascii({kTwo[0]}) + "solid facet vertex\nendsolid facet\n");
    EXPECT_EQ(r.result->facets, 3u);
    EXPECT_TRUE(r.warnings.empty());
}

TEST(Stl, ABadAsciiFacetIsSkippedWithItsLine) {
    struct Case {
        const char *bad, *line;
    };
    const char* good = "facet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\n";
    for (const Case& c : {
             Case{"facet\nvertex 0 0 0\nvertex 1 0\nvertex 0 1 0\nendfacet\n",
                  "a.stl:4: a vertex has three numbers"},
             Case{"facet\nvertex 0 0 0\nvertex 1 nan 0\nvertex 0 1 0\nendfacet\n",
                  "a.stl:4: a vertex has three numbers"},
             Case{"facet\nvertex 0 0 0\nvertex 1 1e999 0\nvertex 0 1 0\nendfacet\n",
                  "a.stl:4: the number is too large"},
             Case{"facet\nvertex 0 0 0\nvertex 1,5 1 0\nvertex 0 1 0\nendfacet\n",
                  "a.stl:4: a decimal comma: numbers have a point"},
             Case{"facet\nvertex 0 0 0\nvertex 1 0 0\nendfacet\n",
                  "a.stl:2: a facet of 2 vertices, not three"},
             Case{"facet\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nendfacet\n",
                  "a.stl:2: a facet of 4 vertices, not three"},
             Case{"facet\nvertex 0 0 0\n", "a.stl:2: a facet of 1 vertices, not three"},
             Case{"endfacet\n", "a.stl:2: an 'endfacet' without 'facet'"},
             Case{"vertex 1 2 3\nendfacet\n", "a.stl:2: a vertex outside of a facet"},
         }) {
        const StlRead r = read_facets(fmt::format("solid\n{}{}{}", c.bad, good, good));
        ASSERT_TRUE(r.result) << c.bad << r.error();
        EXPECT_EQ(r.result->facets, 2u) << c.bad;
        EXPECT_EQ(r.result->skipped, 1u) << c.bad;
        ASSERT_EQ(r.warnings.size(), 1u) << c.bad;
        EXPECT_TRUE(r.warnings[0].starts_with(c.line)) << r.warnings[0];
    }
}

TEST(Stl, ACountThatLiesIsToldAndWhatIsThereIsRead) {
    const std::string whole = binary(kTwo);
    struct Case {
        std::string file;
        std::size_t facets;
        const char* told;
    };
    for (const Case& c : {
             Case{with_count(whole, 0xffffffff), 2,
                  "tells of 4294967295 facets, but the file ends after 2"},
             Case{whole.substr(0, whole.size() - 1), 1,
                  "tells of 2 facets, but the file ends after 1"},
             Case{whole + std::string(20, '\0'), 2, "20 bytes behind the last facet"},
             Case{with_count(whole, 1), 1, "50 bytes behind the last facet"},
             Case{with_count(whole, 0), 2, "tells of no facets, but there are 2"},
         }) {
        const StlRead r = read_facets(c.file);
        ASSERT_TRUE(r.result) << r.error();
        EXPECT_EQ(r.result->facets, c.facets);
        ASSERT_EQ(r.warnings.size(), 1u);
        EXPECT_NE(r.warnings[0].find(c.told), std::string::npos) << r.warnings[0];
    }
}

TEST(Stl, WhatIsNoStlIsRefusedInOneLineWithTheReason) {
    std::mt19937 random(1);
    std::string noise(5000, ' ');
    for (char& c : noise)
        c = static_cast<char>(random());
    struct Case {
        std::string file;
        const char* reason;
    };
    for (const Case& c : {
             Case{"", "the file is empty"},
             Case{std::string(80, 'x'), "too few"},
             Case{binary({}), "without facets"},
             Case{"solid nothing\nendsolid nothing\n", "without facets"},
             Case{"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n",
                  "a.stl:2: the file ends within a facet"},
             Case{noise, "not an STL file"},
             Case{std::string(5000, 'x'), "not an STL file"},
             Case{"\x89PNG\r\n\x1a\n" + noise, "PNG picture"},
             Case{"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n",
                  "Git LFS pointer"},
         }) {
        const StlRead r = read_facets(c.file);
        ASSERT_FALSE(r.result) << c.reason;
        EXPECT_EQ(r.result.error().exit, Exit::unreadable);
        EXPECT_TRUE(r.error().starts_with("a.stl:")) << r.error();
        EXPECT_NE(r.error().find(c.reason), std::string::npos) << r.error();
    }
}

TEST(Stl, CanBeCancelled) {
    const std::string file = binary(random_facets(1, 50000));
    Warnings warnings;
    int calls = 0;
    double last = -1;
    const auto result = read_stl(file, "a.stl", warnings, [&](double share) {
        EXPECT_GT(share, last);
        last = share;
        return ++calls < 2;
    });
    ASSERT_FALSE(result);
    EXPECT_EQ(calls, 2);
    EXPECT_EQ(result.error().what, "a.stl: loading was cancelled");
}

TEST(Stl, ARoundSurfaceIsSmoothAndAnEdgeIsSharp) {
    // A cylinder of 24 sides with its lid: the lid's normals are straight up, the sides' point
    // outward.
    std::vector<Facet> facets;
    for (int i = 0; i < 24; ++i) {
        const auto at = [&](int k, double z) {
            const double angle = 2 * 3.14159265358979 * (k % 24) / 24;
            return DVec3(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)),
                         z);
        };
        facets.push_back({at(i, 0), at(i + 1, 0), at(i + 1, 1)});
        facets.push_back({at(i, 0), at(i + 1, 1), at(i, 1)});
        facets.push_back({at(i, 1), at(i + 1, 1), DVec3(0, 0, 1)});
    }
    StlRead r = read_facets(binary(facets));
    Warnings warnings;
    const geom::Mesh m =
        geom::build_mesh(std::move(r.result->polygons), {kStlCreaseDegrees}, "a.stl", warnings)
            .mesh;
    ASSERT_EQ(m.triangles(), 72u);
    for (std::size_t i = 0; i < m.index.size(); ++i) {
        const Vec3 p = m.position[m.index[i]], n = m.normal[m.index[i]];
        const float length = std::sqrt(p.x * p.x + p.y * p.y);
        const Vec3 expected = i / 3 % 3 == 2 ? Vec3(0, 0, 1) : Vec3(p.x / length, p.y / length, 0);
        EXPECT_LT(std::abs(n.x - expected.x) + std::abs(n.y - expected.y) +
                      std::abs(n.z - expected.z),
                  1e-5f);
    }
    EXPECT_EQ(m.position.size(), 24u * 3 + 1);
}

// What the shared models must give; passes where they are not present.
TEST(Stl, SharedModelsHaveTheirFacets) {
    struct Case {
        const char* path;
        std::size_t facets, skipped;
    };
    const std::filesystem::path assets =
        std::filesystem::path(SCANOUT_SOURCE_DIR) / "../shared/assets";
    for (const Case& c : {
             Case{"models/assimp_spider/Spider_ascii.stl", 1368, 0},
             Case{"models/assimp_spider/Spider_binary.stl", 1368, 0},
             Case{"models/flange/flange.stl", 6468, 0},
             Case{"models/stl_broken_real/bad-stl-pcbvicebar.stl", 260, 0},
             Case{"models/stl_broken_real/bad-stl-tardis.stl", 3636, 0},
             Case{"models/stl_misc_trimesh/20mm-xyz-cube.stl", 260, 0},
             Case{"models/stl_misc_trimesh/angle_block.STL", 704, 0},
             Case{"models/stl_misc_trimesh/multibody.stl", 32, 0},
             Case{"models/stl_misc_trimesh/round.stl", 1120, 0},
             Case{"models/stl_misc_trimesh/soup.stl", 100, 0},
             Case{"models/stl_solid_header/import.stl", 46, 0},
             Case{"models/stl_solid_header/import_bin.stl", 46, 0},
             Case{"models/stl_solid_header/import_bin_solid.stl", 46, 0},
             Case{"models/terrain_utm/terrain.stl", 21186, 0},
             Case{"bad/made/trailing.stl", 4, 0},
             Case{"bad/made/count_lies.stl", 2, 0},
             Case{"bad/made/truncated.stl", 59, 0},
             Case{"bad/openscad/toomanyvertices.stl", 12, 1},
             Case{"bad/openscad/unparseable.stl", 0, 2},
             Case{"bad/openscad/empty.stl", 0, 0},
             Case{"bad/made/header_only.stl", 0, 0},
             Case{"bad/made/ascii_cut.stl", 0, 1},
             Case{"bad/trimesh/empty.stl", 0, 0},
             Case{"bad/trimesh/stl_empty_ascii.stl", 0, 0},
             Case{"bad/trimesh/stl_empty_bin.stl", 0, 0},
         }) {
        if (!std::filesystem::exists(assets / c.path)) continue;
        const auto file = Mapping::open((assets / c.path).string());
        ASSERT_TRUE(file);
        Warnings warnings;
        const auto result = read_stl(file->text(), c.path, warnings, {});
        if (c.facets == 0) {
            ASSERT_FALSE(result) << c.path;
            EXPECT_TRUE(result.error().what.starts_with(c.path)) << result.error().what;
            continue;
        }
        ASSERT_TRUE(result) << result.error().what;
        EXPECT_EQ(result->facets, c.facets) << c.path;
        EXPECT_EQ(result->skipped, c.skipped) << c.path;
    }
}

TEST(Stl, IsReadWhereOnlyItsWordsAreWrong) {
    const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                              "vertex 0 1 0\nendloop\n";
    std::string one_line = "solid t " + facet + "endfacet " + facet + "endfacet endsolid t";
    std::replace(one_line.begin(), one_line.end(), '\n', ' ');
    for (const std::string& file :
         {"solid t\n" + facet + facet + "endsolid t\n", one_line,
          "solid_t\n" + facet + "endfacet\n" + facet + "endfacet\nendsolid t\n",
          "solid t\n# a comment\n" + facet + "end facet\n" + facet + "endfacet\n" +
              std::string(40, '\0')}) {
        const StlRead r = read_facets(file);
        ASSERT_TRUE(r.result) << r.error() << "\n" << file;
        EXPECT_EQ(r.result->facets, 2u) << file;
        EXPECT_EQ(r.result->skipped, 0u) << file;
    }
}

TEST(Stl, ADecimalCommaIsNamed) {
    const StlRead r =
        read_facets("solid t\nfacet\nvertex -1,0 0 0\nvertex 1,0 0 0\nvertex 0 1 0\nendfacet\n");
    ASSERT_FALSE(r.result);
    EXPECT_EQ(r.result.error().exit, Exit::unreadable);
    EXPECT_NE(r.error().find("a.stl:3: a decimal comma"), std::string::npos) << r.error();
}

TEST(Stl, ZerosOfAnySizeAreADownloadThatWasCutShort) {
    for (const std::size_t size : {84U, 134U, 5000U, 50084U}) {
        const StlRead r = read_facets(std::string(size, '\0'));
        ASSERT_FALSE(r.result) << size;
        EXPECT_NE(r.error().find("a.stl: holds zero bytes"), std::string::npos) << r.error();
    }
}

std::string coloured(const std::string& header, std::initializer_list<std::uint16_t> attributes) {
    std::string file = binary(
        std::vector<Facet>(attributes.size(), {DVec3(0), DVec3(1, 0, 0), DVec3(0, 1, 0)}), header);
    std::size_t facet = 0;
    for (const std::uint16_t attribute : attributes) {
        file[84 + facet * 50 + 48] = static_cast<char>(attribute & 0xff);
        file[84 + facet++ * 50 + 49] = static_cast<char>(attribute >> 8);
    }
    return file;
}

// The two conventions: where "COLOR=" stands in the header, a set upper bit means the object's
// colour and red is lowest; else it means that there is a colour, and blue is lowest.
TEST(Stl, ColoursOfFacetsFollowMagicsOrVisCam) {
    const StlRead magics =
        read_facets(coloured("COLOR=\xc8\x64\x32\xff, made", {0x001f, 0x8000, 0, 0x7c00}));
    ASSERT_TRUE(magics.result);
    EXPECT_EQ(magics.result->polygons.face_material, (std::vector<std::int32_t>{0, 1, 1, 2}));
    const auto of = [](const StlRead& r, std::size_t i) {
        return r.result->colours.materials().at(i).diffuse;
    };
    EXPECT_EQ(of(magics, 0), Vec3(1, 0, 0));
    EXPECT_EQ(of(magics, 1), Vec3(srgb_decode(std::uint8_t{200}), srgb_decode(std::uint8_t{100}),
                                  srgb_decode(std::uint8_t{50})));
    EXPECT_EQ(of(magics, 2), Vec3(0, 0, 1));
    const StlRead viscam = read_facets(coloured("made by a test", {0x801f, 0x001f, 0xfc00}));
    ASSERT_TRUE(viscam.result);
    EXPECT_EQ(viscam.result->polygons.face_material, (std::vector<std::int32_t>{0, -1, 1}));
    EXPECT_EQ(of(viscam, 0), Vec3(0, 0, 1));
    EXPECT_EQ(of(viscam, 1), Vec3(1, 0, 0));
}

} // namespace
} // namespace scanout::io
