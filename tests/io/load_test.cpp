#include "base/memory.h"
#include "folder.h"
#include "grid.h"
#include "io/load.h"

#include <clocale>
#include <locale>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace scanout::io {
namespace {

using test::all_lines;
using test::Folder;
using test::warned;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::string_view kModel =
    "mtllib m.mtl\nv 0 0 0\nv 2.5 0 0\nv 2.5 1.25 0\nv 0 1 0\nv 0 0 1e-1\n"
    "usemtl gone\nf 1 2 3\nusemtl red\nf 1 2 3 4\nl 1 2 3\np 1 2\nf 1 2 99\n";

TEST(Load, MakesASceneOfAModelItsMaterialsAndTextures) {
    const Folder folder;
    folder.write_picture("t.png", 4, 4, {1, 2, 3, 255});
    const std::string mtl = "newmtl red\nKd 1 0 0\nmap_Kd t.png\n";
    folder.write("m.mtl", mtl);
    const std::string path = folder.write("m.obj", kModel);
    Warnings warnings;
    const auto scene = load(path, {}, warnings);
    ASSERT_TRUE(scene) << scene.error().what;
    EXPECT_EQ(scene->path, path);
    EXPECT_EQ(scene->counts.vertices, 5u);
    EXPECT_EQ(scene->counts.faces, 2u);
    EXPECT_EQ(scene->counts.triangles, 3u);
    EXPECT_EQ(scene->counts.lines, 1u);
    EXPECT_EQ(scene->counts.points, 2u);
    EXPECT_EQ(scene->counts.skipped, 1u);
    EXPECT_EQ(scene->counts.bytes, kModel.size() + mtl.size() + 4 * 4 * 4);
    EXPECT_THAT(scene->mesh.material, ElementsAre(-1, 0, 0));
    EXPECT_THAT(scene->mesh.line_material, ElementsAre(0, 0));
    ASSERT_EQ(scene->materials.size(), 1u);
    EXPECT_EQ(scene->materials[0].map_diffuse->texture, 0);
    EXPECT_EQ(scene->textures[0].image.at(0, 0), (image::Rgba8{1, 2, 3, 255}));
    EXPECT_EQ(warnings.lines().size(), 2u) << all_lines(warnings);
}

TEST(Load, TellsTheFormatByTheExtensionInAnyCase) {
    const Folder folder;
    Warnings warnings;
    EXPECT_TRUE(load(folder.write("a.OBJ", "v 0 0 0\n"), {}, warnings));
    const std::string stl =
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
        "endloop\nendfacet\nendsolid a\n";
    const auto scene = load(folder.write("a.Stl", stl), {}, warnings);
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->counts.vertices, 3u);
    EXPECT_EQ(scene->counts.faces, 1u);
    EXPECT_EQ(scene->counts.triangles, 1u);
    EXPECT_EQ(scene->counts.bytes, stl.size());
    for (const Format& format : formats()) {
        EXPECT_EQ(format.extension.front(), '.');
        EXPECT_FALSE(format.description.empty());
    }
}

TEST(Load, EveryErrorIsOneLineThatNamesTheFile) {
    const Folder folder;
    folder.write("folder.obj/keep", "");
    ASSERT_EQ(::mkfifo(folder.path("pipe.obj").c_str(), 0600), 0);
    ASSERT_EQ(::symlink("loop.obj", folder.path("loop.obj").c_str()), 0);
    folder.write("m.doc", "nothing\n");
    folder.write("none", "nothing\n");
    folder.write("m.obj.gz", "\x1f\x8b\x08");
    folder.write("empty.obj", "");
    const std::pair<std::string, std::string> cases[] = {
        {folder.path("gone.obj"), "No such file"},
        {folder.path("folder.obj"), "folder"},
        {folder.path("pipe.obj"), "regular file"},
        {folder.path("loop.obj"), "symbolic links"},
        {folder.path("m.doc"), "'.doc'"},
        {folder.path("none"), "read: .obj .stl"},
        {folder.path("m.obj.gz"), "cut short"},
        {folder.path("empty.obj"), "empty"},
        {"/dev/zero", "regular file"},
        {"", ""}};
    for (const auto& [path, reason] : cases) {
        Warnings warnings;
        const auto scene = load(path, {}, warnings);
        ASSERT_FALSE(scene) << path;
        EXPECT_EQ(scene.error().exit, Exit::unreadable) << path;
        EXPECT_EQ(scene.error().what.find(path), 0u) << scene.error().what;
        EXPECT_THAT(scene.error().what, HasSubstr(reason));
        EXPECT_EQ(scene.error().what.find('\n'), std::string::npos);
    }
}

TEST(Load, CanBeCancelledAtTheLastMoment) {
    const Folder folder;
    LoadOptions options;
    options.progress = [](double share) { return share < 1; };
    Warnings warnings;
    const auto scene = load(folder.write("m.obj", kModel), options, warnings);
    ASSERT_FALSE(scene);
    EXPECT_THAT(scene.error().what, HasSubstr("loading was cancelled"));
}

// HARD-CASES 60: number readers that ask the locale read 2.5 as 2 where the decimal point is a
// comma.
struct CommaForPoint : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
};

std::vector<float> numbers_of(const std::string& path) {
    Warnings warnings;
    const auto scene = load(path, {}, warnings);
    EXPECT_TRUE(scene);
    std::vector<float> numbers = {static_cast<float>(scene->mesh.exponent)};
    for (const Vec3& p : scene->mesh.position)
        numbers.insert(numbers.end(), {p.x, p.y, p.z});
    for (const scene::Material& m : scene->materials)
        numbers.insert(numbers.end(), {m.diffuse.x, m.shininess, m.map_diffuse->offset.x});
    return numbers;
}

TEST(Load, NoLocaleChangesANumber) {
    const Folder folder;
    folder.write("m.mtl", "newmtl red\nKd 0.25 0 0\nNs 1.5\nmap_Kd -o 0.5 gone.png\n");
    const std::string path = folder.write("m.obj", kModel);
    const std::vector<float> expected = numbers_of(path);
    const std::locale before =
        std::locale::global(std::locale(std::locale::classic(), new CommaForPoint));
    std::ostringstream comma;
    comma << 1.5;
    EXPECT_EQ(comma.str(), "1,5") << "the locale must be in force for this test to mean something";
    EXPECT_EQ(numbers_of(path), expected);
    std::locale::global(before);

    // A C locale with a comma, made by the system's own tool where the program has none installed.
    const std::string make =
        "localedef -i de_DE -f UTF-8 '" + folder.path("de_DE.UTF-8") + "' >/dev/null 2>&1";
    ASSERT_NE(std::system(make.c_str()), -1);
    ::setenv("LOCPATH", folder.path("").c_str(), 1);
    if (std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr) {
        EXPECT_EQ(std::string(std::localeconv()->decimal_point), ",");
        EXPECT_EQ(numbers_of(path), expected);
        std::setlocale(LC_ALL, "C");
    }
    ::unsetenv("LOCPATH");
}

#ifndef SCANOUT_SANITIZED
// Peak memory of load() over the memory before, in bytes of the file; in a process of its own,
// since a peak never falls again.
double peak_in_files(const std::string& path) {
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const std::uint64_t before = resident_bytes();
        Warnings warnings;
        const auto scene = load(path, {}, warnings);
        const double peak = scene ? static_cast<double>(peak_resident_bytes() - before) : 1e18;
        _exit(::write(ends[1], &peak, sizeof(peak)) == sizeof(peak) ? 0 : 1);
    }
    double peak = 1e18;
    EXPECT_EQ(::read(ends[0], &peak, sizeof(peak)), static_cast<ssize_t>(sizeof(peak)));
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    ::close(ends[0]);
    ::close(ends[1]);
    return peak / static_cast<double>(std::filesystem::file_size(path));
}

TEST(Load, NeedsAtMostThreeTimesTheFile) {
    const Folder folder;
    for (const auto& [side, kind] :
         {std::pair(600, test::GridKind::positions), std::pair(600, test::GridKind::flat),
          std::pair(300, test::GridKind::with_uv_and_normals)}) {
        const std::string path = folder.path("grid.obj");
        {
            std::ofstream file(path, std::ios::binary);
            test::write_grid(side, kind, [&](const std::string& row) { file << row; });
        }
        const double peak = peak_in_files(path);
        std::printf("peak memory: %.2f times the file of %.1f MB\n", peak,
                    static_cast<double>(std::filesystem::file_size(path)) / 1e6);
        // Flat: three vertices a triangle, whose arrays alone are 2.7 times the file.
        EXPECT_LE(peak, kind == test::GridKind::flat ? 3.4 : 3.0);
        EXPECT_GT(peak, 0.1) << "the measurement must measure something";
    }
}

TEST(Load, RefusesAModelThatWouldTakeMoreMemoryThanItMay) {
    const Folder folder;
    const std::string path = folder.path("grid.obj");
    {
        std::ofstream file(path, std::ios::binary);
        test::write_grid(400, test::GridKind::positions,
                         [&](const std::string& row) { file << row; });
    }
    LoadOptions options;
    options.memory_bytes = 10'000'000;
    Warnings warnings;
    const auto scene = load(path, options, warnings);
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().exit, Exit::unreadable);
    EXPECT_EQ(scene.error().what,
              path + ": needs more memory than the 10 MB that are available: close other programs, "
                     "or cut the model into parts");
    options.memory_bytes = 1'000'000'000;
    EXPECT_TRUE(load(path, options, warnings));
}
#endif

} // namespace
} // namespace scanout::io
