// Files that are wrong on purpose: each ends in a scene or in one line, at once and in little
// memory. Our own stand in data/; the shared collection of such files is read too, where it is
// present.
#include "base/memory.h"
#include "folder.h"
#include "io/load.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <sys/resource.h>

namespace scanout::io {
namespace {

using test::all_lines;
using test::Folder;
using test::warned;

const std::string kData = SCANOUT_SOURCE_DIR "/tests/io/data/";

// What is true of every scene, whatever the file.
void expect_sound(const scene::Scene& scene) {
    const geom::Mesh& m = scene.mesh;
    for (const Vec3& p : m.position)
        for (int i = 0; i < 3; ++i)
            ASSERT_TRUE(std::isfinite(p[i]) && std::abs(p[i]) <= 1);
    for (const Vec3& n : m.normal)
        ASSERT_NEAR(dot3(n, n), 1, 1e-3);
    for (const std::uint32_t i : m.index)
        ASSERT_LT(i, m.position.size());
    for (const std::uint32_t i : m.line_index)
        ASSERT_LT(i, m.position.size());
    for (const std::uint32_t i : m.point_index)
        ASSERT_LT(i, m.position.size());
    for (const std::int32_t i : m.material)
        ASSERT_LT(i, static_cast<int>(scene.materials.size()));
    for (const scene::Material& material : scene.materials)
        ASSERT_LT(material.map_diffuse->texture, static_cast<int>(scene.textures.size()));
    EXPECT_GT(m.triangles() + m.lines() + m.points(), 0u);
    EXPECT_TRUE(std::isfinite(m.radius) && m.radius >= 0.5 && m.radius <= 1);
}

#ifdef SCANOUT_SANITIZED
constexpr double kAtOnce = 10; // seconds
#else
constexpr double kAtOnce = 2;
#endif

// Of this program alone: neither what others take counts, nor what the kernel does to hand out a
// file's pages.
double seconds_computed() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_utime.tv_sec) +
           static_cast<double>(usage.ru_utime.tv_usec) * 1e-6;
}

Result<scene::Scene> load_soundly(const std::string& path, Warnings& warnings,
                                  double at_once = kAtOnce) {
    const double begin = seconds_computed();
    auto scene = load(path, {}, warnings);
    EXPECT_LT(seconds_computed() - begin, at_once) << path;
    if (scene) {
        expect_sound(*scene);
    } else {
        EXPECT_EQ(scene.error().exit, Exit::unreadable) << path;
        EXPECT_EQ(scene.error().what.find('\n'), std::string::npos);
        EXPECT_NE(scene.error().what.find(path), std::string::npos) << scene.error().what;
    }
    for (const std::string& line : warnings.lines()) {
        EXPECT_EQ(line.find('\n'), std::string::npos) << line;
        EXPECT_LT(line.size(), 1000u) << line;
    }
    return scene;
}

struct Shown {
    const char* file;
    std::size_t faces, points;
    const char* warning; // a part of some line; "": no warning at all
};

constexpr Shown kShown[] = {
    {"nan.obj", 1, 0, "nan.obj:1: 'nan' is not a finite number"},
    {"overflow.obj", 0, 1, "overflow.obj:2: '1e400' is too large a number"},
    {"huge.obj", 1, 0, ""},
    {"tiny.obj", 1, 0, ""},
    {"one_place.obj", 1, 0, ""},
    {"indices.obj", 1, 0, "indices.obj:4: '0' names no vertex"},
    {"few_corners.obj", 1, 0, "few_corners.obj:4: a face needs 3 corners"},
    {"cr.obj", 1, 0, ""},
    {"nul.obj", 1, 0, "NUL bytes"},
    {"bom.obj", 1, 0, ""},
    {"points_only.obj", 0, 3, "shown as points"},
    {"curves_only.obj", 0, 4, "free-form"},
    {"self.obj", 1, 0, "self.obj: holds no material"},
    {"outside.obj", 1, 0, "passwd' lies outside of the model's folder (--allow-outside reads it)"},
    {"outside.obj", 1, 0, "/dev/random' lies outside of the model's folder"},
    {"quoted.obj", 1, 0, "cycle_a.mtl:3: the statement is not known"},
    {"words.obj", 1, 0, "words.obj:1: 'a/b/c' names no vertex"},
    {"words.obj", 1, 0, "words.obj:2: 'x' is not a finite number"},
    {"texture_good.obj", 1, 0, ""},
    {"texture_claims.obj", 1, 0, "claims.png"},
    {"texture_cut.obj", 1, 0, "cut.png"},
    {"texture_bomb.obj", 1, 0, "bomb.png"},
    {"texture_rle.obj", 1, 0, "long_rle.tga"},
    {"texture_bmp.obj", 1, 0, "bad.bmp"},
    {"liar.stl", 2, 0, "liar.stl"},
};

TEST(Bad, WhatCanBeShownIsShownWithALineForTheRest) {
    for (const Shown& shown : kShown) {
        Warnings warnings;
        const auto scene = load_soundly(kData + shown.file, warnings);
        ASSERT_TRUE(scene) << scene.error().what;
        EXPECT_EQ(scene->counts.faces, shown.faces) << shown.file;
        EXPECT_EQ(scene->counts.points, shown.points) << shown.file;
        if (*shown.warning == '\0')
            EXPECT_EQ(all_lines(warnings), "") << shown.file;
        else
            EXPECT_TRUE(warned(warnings, {shown.warning})) << shown.file << "\n"
                                                           << all_lines(warnings);
    }
}

TEST(Bad, WhatCannotBeShownIsRefusedWithTheReason) {
    const std::pair<const char*, const char*> cases[] = {
        {"utf16.obj", "UTF-16"}, {"pointer.obj", "Git LFS"},   {"page.obj", "HTML"},
        {"picture.obj", "PNG"},  {"blank.obj", "no vertices"}, {"binary.obj", ""},
        {"cut.stl", "cut.stl:"}, {"empty.stl", "empty"}};
    for (const auto& [file, reason] : cases) {
        Warnings warnings;
        const auto scene = load_soundly(kData + file, warnings);
        ASSERT_FALSE(scene) << file;
        EXPECT_NE(scene.error().what.find(reason), std::string::npos) << scene.error().what;
    }
}

TEST(Bad, APolygonOfTwentyThousandCornersIsFilledInTime) {
    const Folder folder;
    std::string text, face = "f";
    for (int i = 0; i < 20000; ++i) {
        const double angle = i * 6.283185307179586 / 20000, radius = i % 2 == 0 ? 1 : 0.999;
        text +=
            fmt::format("v {:.6f} {:.6f} 0\n", radius * std::cos(angle), radius * std::sin(angle));
        face += fmt::format(" {}", i + 1);
    }
    Warnings warnings;
    const auto scene = load_soundly(folder.write("gear.obj", text + face + "\n"), warnings);
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->counts.triangles, 19998u);
}

TEST(Bad, FilesThatRepeatOneFaultWithoutEndAreReadInTime) {
    const Folder folder;
    const std::pair<const char*, std::string> cases[] = {
        {"newmtl", "usemtl a\n"},
        {"long name", "usemtl " + std::string(300'000, 'A') + "\n"},
        {"digits", "v " + std::string(500'000, '1') + " 0 0\n"},
        {"slashes", "f " + std::string(500'000, '/') + "\n"},
        {"backslashes", "f 1 2 3 " + std::string(500'000, '\\') + "\n"},
        {"blanks", "f 1 2 3" + std::string(500'000, ' ') + "\n"}};
    for (const auto& [name, statement] : cases) {
        std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        while (text.size() < 4'000'000)
            text += statement;
        Warnings warnings;
        EXPECT_TRUE(load_soundly(folder.write("m.obj", text), warnings)) << name;
    }
    std::string continued = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl ";
    for (int i = 0; i < 300'000; ++i)
        continued += "\\ \\\n";
    Warnings warnings;
    EXPECT_TRUE(load_soundly(folder.write("m.obj", continued), warnings));
}

// HARD-CASES 62
TEST(Bad, AFileOfZerosLargerThanMemoryIsRefusedAtOnce) {
    const Folder folder;
    const std::string path = folder.write("sparse.obj", "");
    std::filesystem::resize_file(path, std::uintmax_t{5} << 30);
    Warnings warnings;
    EXPECT_FALSE(load_soundly(path, warnings));
}

// The size agrees with the header, which is why only the number can tell.
TEST(Bad, AnStlOfMoreTrianglesThanMemoryHoldsIsRefusedAtOnce) {
    const Folder folder;
    constexpr std::uint32_t kFacets = 107'000'000;
    std::string head(80, ' ');
    for (int i = 0; i < 4; ++i)
        head += static_cast<char>(kFacets >> (8 * i) & 0xff);
    const std::string path = folder.write("sparse.stl", head);
    std::filesystem::resize_file(path, 84 + std::uintmax_t{50} * kFacets);
    LoadOptions options;
    options.memory_bytes = 8'000'000'000;
    Warnings warnings;
    const std::uint64_t before = peak_resident_bytes();
    const auto scene = load(path, options, warnings);
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().exit, Exit::unreadable);
    EXPECT_EQ(scene.error().what,
              path + ": its 107000000 triangles take at least 8560 MB of memory to load, and 8000 "
                     "MB are available: close other programs, or cut the model into parts");
    EXPECT_LT(peak_resident_bytes(), before + 16'000'000);
}

TEST(Bad, AFileThatWasCutShortAndEndsInZerosShowsItsStart) {
    const Folder folder;
    const std::string path = folder.write("cut.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    std::filesystem::resize_file(path, std::uintmax_t{1} << 30);
    Warnings warnings;
    const auto scene = load_soundly(path, warnings, 2 * kAtOnce); // a gigabyte
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->counts.faces, 1u);
    EXPECT_TRUE(warned(warnings, {"cut.obj:5: NUL bytes"})) << all_lines(warnings);
#ifndef SCANOUT_SANITIZED
    EXPECT_LT(peak_resident_bytes(), 500'000'000u);
#endif
}

TEST(Bad, EveryFileOfTheSharedCollectionEndsAtOnceInASceneOrALine) {
    const std::filesystem::path root = SCANOUT_SOURCE_DIR "/../shared/assets/bad";
    if (!std::filesystem::exists(root)) GTEST_SKIP() << "the shared files are not here";
    std::vector<std::string> paths;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
        if (entry.is_regular_file()) paths.push_back(entry.path().string());
    }
    std::sort(paths.begin(), paths.end());
    std::size_t shown = 0;
    for (const std::string& path : paths) {
        Warnings warnings;
        const auto scene = load_soundly(path, warnings);
        shown += scene.has_value();
        EXPECT_TRUE(scene || !scene.error().what.empty());
    }
    std::printf("read %zu files, %zu of them show something\n", paths.size(), shown);
    EXPECT_GE(paths.size(), 470u);
    EXPECT_GE(shown, 72u);
#ifndef SCANOUT_SANITIZED
    EXPECT_LT(peak_resident_bytes(), 500'000'000u);
#endif
}

} // namespace
} // namespace scanout::io
