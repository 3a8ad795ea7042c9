// Laws of reading in parts: whatever the file and wherever it is cut, the result and every message
// are those of reading from beginning to end.
#include "same.h"

#include <random>

#include <gtest/gtest.h>

namespace scanout::io {
namespace {

using test::difference_in_parts;
using test::three_threads;

struct Grammar {
    std::vector<const char*> usual, odd; // statements
};

constexpr const char* kEnds[] = {"\n", "\n", "\n", "\r\n", "\r"};

// `odds`: of a hundred statements as many are odd ones.
std::string soup(const Grammar& grammar, std::uint32_t seed, int statements, unsigned odds) {
    std::mt19937 random(seed);
    const char* const end = kEnds[random() % std::size(kEnds)];
    std::string text;
    for (int i = 0; i < statements; ++i) {
        const auto& list = random() % 100 < odds ? grammar.odd : grammar.usual;
        for (const char* c = list[random() % list.size()]; *c != '\0'; ++c) {
            if (*c == '\n')
                text += end;
            else
                text += *c;
        }
        if (random() % 64 != 0) text += random() % 50 == 0 ? kEnds[random() % 5] : end;
    }
    return text;
}

const Grammar kObj = {{"v 0 1 2",
                       "v 1.5 2.5e-3 -7",
                       "v 9 8 7",
                       "vt 0.5 0.25",
                       "vn 0 0 1",
                       "f 1 2 3",
                       "f -1 -2 -3",
                       "f -4 -3 -2 -1",
                       "f 1/1 2/1 3/1",
                       "f 1//1 2//1 3//1",
                       "f -1/-1/-1 -2/-1/-1 -3/-1/-1",
                       "usemtl red",
                       "usemtl blue",
                       "s 1",
                       "s off",
                       "g part",
                       "o thing",
                       "",
                       "  ",
                       "# comment",
                       "v 3 1 4\nv 1 5 9\nv 2 6 5\nf -3 -2 -1",
                       "v 1 2 3\nvt 1 1\nvn 0 1 0\nf 1 2 3\nf 3 2 1"},
                      {"f 1 2 \\\n 3",
                       "v 1 \\\n 2 3",
                       "# comment \\",
                       "usemtl",
                       "usemtl a name of words",
                       "mtllib a.mtl",
                       "mtllib b.mtl c.mtl",
                       "v 1 2 3 0.5 0.25 1",
                       "v 1 2 3 4",
                       "l 1 2 3",
                       "l -1 -2",
                       "p 1 2",
                       "p -1",
                       "#MRGB ff102030ff405060",
                       "f 1 2",
                       "f 0 1 2",
                       "f 1 2 99999",
                       "f 7 8 9",
                       "v nan 0 0",
                       "v 1 2",
                       "v 1e999 0 0",
                       "vt x",
                       "vn 1 2",
                       "s 99999999999",
                       "s on",
                       "vp 1 2",
                       "curv 0 1 1 2 3",
                       "nonsense",
                       "f 1/99 2 3",
                       "f -99999 -1 -2",
                       "\\\n",
                       "f 1 2 3 \\",
                       "v 1 2 x",
                       "l 1",
                       "p 0"}};

const Grammar kAscii = {
    {"facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet",
     "facet normal 0 0 0\n outer loop\n  vertex 1 2 3\n  vertex 4 5e-1 6\n  vertex -1 -2 0\n "
     "endloop\nendfacet",
     "FACET normal 1 0 0 OUTER LOOP VERTEX 0 0 0 VERTEX 3 0 0 VERTEX 0 4 0 ENDLOOP ENDFACET",
     "  facet\nvertex 9 9 9\nvertex 8 8 8\nvertex 7 9 7\nendfacet"},
    {"facet", "endfacet", "vertex 1 2 3", "vertex 1 2", "vertex 1 2 \\\n 3", "vertex 1 2 3 \\",
     "solid facet", "endsolid a", "solid x \\", "facet\nvertex 1 x 2\nendfacet",
     "facet\nvertex 1 1e999 2\nendfacet", "facet\nvertex 0 0 0\nvertex 1 0 0\nendfacet", "\\",
     "facet vertex 1 2 3 vertex 3 2 1 vertex 5 5 5 vertex 6 6 6 endfacet", "colour 1 2 3", ""}};

Result<ObjFile> read_as_obj(std::string_view text, Warnings& warnings, const Reading& how) {
    return read_obj(text, "x.obj", warnings, {}, how);
}

Result<StlResult> read_as_stl(std::string_view text, Warnings& warnings, const Reading& how) {
    return read_stl(text, "x.stl", warnings, {}, how);
}

template <class Read>
std::string difference(std::string_view text, std::vector<std::size_t> part_bytes, Read&& read) {
    Warnings warnings;
    const auto whole = read(text, warnings, Reading());
    return difference_in_parts(whole, warnings, text, std::move(part_bytes), read);
}

constexpr unsigned kOdds[] = {0, 20, 1, 1}; // by seed

TEST(Parts, OfAnObjFileGiveWhatTheFileGives) {
    for (std::uint32_t seed = 0; seed < 400; ++seed) {
        const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n" +
                                 soup(kObj, seed, 300, kOdds[seed % 4]);
        ASSERT_EQ(difference(text, {1, 16 + seed % 50, 300, 1500}, read_as_obj), "")
            << "seed " << seed;
    }
}

TEST(Parts, OfAnAsciiStlFileGiveWhatTheFileGives) {
    for (std::uint32_t seed = 0; seed < 400; ++seed) {
        const std::string text = "solid a\n" + soup(kAscii, seed, 150, kOdds[seed % 4]);
        ASSERT_EQ(difference(text, {1, 16 + seed % 50, 300, 1500}, read_as_stl), "")
            << "seed " << seed;
    }
}

TEST(Parts, BehindAFacetThatDoesNotEndAreReadWithIt) {
    std::string text = "solid a\n";
    for (int i = 0; i < 40; ++i) {
        text += std::string(kAscii.usual.front()) + "\n";
        if (i == 5) text += "facet normal 0 0 1\nouter loop\n";
    }
    std::vector<std::size_t> part_bytes; // some part ends in that facet, and none is left behind it
    for (std::size_t bytes = text.size() / 12; bytes < text.size() / 3; ++bytes)
        part_bytes.push_back(bytes);
    EXPECT_EQ(difference(text, part_bytes, read_as_stl), "");
}

TEST(Parts, OfAFileThatIsCutShortAnywhereGiveWhatItGives) {
    const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + soup(kObj, 5, 40, 20);
    for (std::size_t length = 1; length <= obj.size(); ++length)
        ASSERT_EQ(difference(obj.substr(0, length), {9}, read_as_obj), "") << length;
    const std::string stl = "solid a\n" + soup(kAscii, 5, 8, 20);
    for (std::size_t length = 1; length <= stl.size(); ++length)
        ASSERT_EQ(difference(stl.substr(0, length), {9}, read_as_stl), "") << length;
}

TEST(Parts, OfFacetsThatAreNotNumbersAreNamedInTheOrderOfTheFile) {
    std::mt19937 random(1);
    for (int round = 0; round < 5; ++round) {
        std::string file(80, 'x');
        const std::uint32_t count = 70'000 + random() % 9;
        file.append(reinterpret_cast<const char*>(&count), 4);
        std::vector<float> facet(12);
        for (std::uint32_t i = 0; i < count; ++i) {
            for (float& number : facet)
                number = static_cast<float>(random() % 500);
            if (random() % 9000 == 0) facet[3 + random() % 9] = NAN;
            file.append(reinterpret_cast<const char*>(facet.data()), 48);
            file.append(2, '\0');
        }
        ASSERT_EQ(difference(file, {1}, read_as_stl), "");
    }
}

std::string faultless_obj() {
    std::string text;
    for (int i = 0; i < 3000; ++i)
        text += fmt::format("v {} 0 0\nv 0 {} 0\nv 0 0 1\nusemtl m{}\nf -3 -2 -1\n", i, i, i % 5);
    return text;
}

TEST(Parts, WithoutFaultsAreReadOnce) {
    Warnings warnings;
    std::size_t again = 0;
    ASSERT_TRUE(read_as_obj(faultless_obj(), warnings, {&three_threads(), 1000, &again}));
    EXPECT_EQ(again, 0u);
    std::string stl = "solid a\n";
    for (int i = 0; i < 500; ++i)
        stl += std::string(kAscii.usual.front()) + "\n";
    ASSERT_TRUE(read_as_stl(stl, warnings, {&three_threads(), 1000, &again}));
    EXPECT_EQ(again, 0u);
    ASSERT_TRUE(
        read_as_obj(faultless_obj() + "f 1 2\n", warnings, {&three_threads(), 1000, &again}));
    EXPECT_EQ(again, 1u) << "the part with the fault, and no other";
}

TEST(Parts, FollowEachOtherWithoutGaps) {
    const std::string text = faultless_obj();
    TextParts parts({&three_threads(), 1000, nullptr});
    std::size_t bytes = 0, most = 0;
    for (std::string_view rest = text; !rest.empty();) {
        const auto texts = parts.next(rest, [](std::string_view) { return true; });
        ASSERT_FALSE(texts.empty() && rest.size() > 2000);
        if (texts.empty()) break;
        for (const std::string_view part : texts) {
            EXPECT_EQ(part.data(), rest.data()) << "a part begins where the one before ends";
            EXPECT_TRUE(part.size() == rest.size() || part.back() == '\n');
            most = std::max(most, part.size());
            bytes += part.size();
            rest.remove_prefix(part.size());
        }
    }
    EXPECT_GT(bytes, text.size() - 2000);
    EXPECT_LT(most, 1100u);
}

TEST(Parts, WhereMostHaveToBeReadAgainAreTriedLessOften) {
    const std::string text(1 << 20, '\n');
    TextParts parts({&three_threads(), 100, nullptr});
    std::size_t tried = 0;
    for (int i = 0; i < 10'000; ++i) {
        const auto texts = parts.next(text, [](std::string_view) { return true; });
        if (texts.empty()) continue;
        ++tried;
        parts.read_again(texts.size(), texts.size());
    }
    EXPECT_GE(tried, 2u);
    EXPECT_LT(tried, 20u);
}

} // namespace
} // namespace scanout::io
