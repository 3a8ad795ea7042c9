// Files from outside that lie, end early or are bombs: one line and no more, in bounded memory.
#include "base/memory.h"
#include "pictures.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include <gtest/gtest.h>

namespace scanout::image {
namespace {

using namespace test;

constexpr std::uint64_t kMegabyte = 1u << 20;

std::vector<std::string> data_files() {
    std::vector<std::string> paths;
    for (const auto& entry : std::filesystem::directory_iterator(data_path("")))
        if (entry.path().extension() != ".md") paths.push_back(entry.path().string());
    std::sort(paths.begin(), paths.end());
    return paths;
}

// A refusal is one line that begins with the file's name and carries the exit code of unreadable
// files.
void expect_clean(const Result<Image>& result, const std::string& name) {
    if (result) return;
    EXPECT_EQ(result.error().exit, Exit::unreadable);
    EXPECT_EQ(result.error().what.find(name + ": "), 0u) << result.error().what;
    EXPECT_EQ(result.error().what.find('\n'), std::string::npos) << result.error().what;
}

TEST(Damage, AFileCutAnywhereIsRefusedOrStillTheSamePicture) {
    ASSERT_GE(data_files().size(), 20u);
    for (const std::string& path : data_files()) {
        const Bytes file = file_bytes(path);
        const auto whole = decode(file, path);
        ASSERT_TRUE(whole) << whole.error().what;
        for (std::size_t length = 0; length < file.size(); ++length) {
            const auto cut = decode(std::span(file).first(length), path);
            expect_clean(cut, path);
            if (cut) {
                EXPECT_EQ(*cut, *whole) << path << " cut to " << length;
            }
        }
        EXPECT_FALSE(decode(std::span(file).first(file.size() / 2), path)) << path;
    }
}

// Bytes are changed in copies of exactly their size, so that a sanitizer sees every overrun.
TEST(Damage, AFileWithChangedBytesIsRefusedOrDecodedTheSameWayTwice) {
    std::mt19937 random(20220908);
    const DecodeLimits limits{.max_side = 300, .max_pixels = 40000};
    int refused = 0, decoded = 0;
    for (const std::string& path : data_files()) {
        const Bytes original = file_bytes(path);
        for (int i = 0; i < 400; ++i) {
            Bytes file = original;
            const std::size_t reach =
                i % 2 == 0 ? std::min<std::size_t>(file.size(), 64) : file.size();
            for (std::uint32_t changes = 1 + static_cast<std::uint32_t>(random() % 3); changes > 0;
                 --changes)
                file[random() % reach] = static_cast<std::uint8_t>(random());
            file.shrink_to_fit();
            const auto picture = decode(file, path, limits);
            expect_clean(picture, path);
            const auto again = decode(file, path, limits);
            ASSERT_EQ(picture.has_value(), again.has_value()) << path;
            if (picture) {
                EXPECT_EQ(*picture, *again) << path;
            }
            (picture ? decoded : refused)++;
        }
    }
    EXPECT_GT(refused, 1000);
    EXPECT_GT(decoded, 1000);
}

TEST(Damage, AClaimedSizeIsRefusedBeforeItCostsMemory) {
    const std::uint64_t before = peak_resident_bytes();
    std::vector<std::pair<std::string, Bytes>> liars;
    liars.emplace_back("claims.png", png_file(20000, 20000, 1, 0, Bytes(1000)));
    liars.emplace_back("huge.png", png_file(0x7fffffff, 0x7fffffff, 8, 2, Bytes(1000)));
    liars.emplace_back("zero.png", png_file(0, 7, 8, 2, Bytes(1000)));
    liars.emplace_back("claims.ppm", Maker().text("P6 16384 16385 255\n").bytes);
    liars.emplace_back("long.ppm", Maker().text("P6 99999999999999999999 1 255\n").bytes);
    liars.emplace_back("claims.bmp", bmp_start(16000, -16000, 32, 0, 54).bytes);
    liars.emplace_back("lowest.bmp", bmp_start(16, INT32_MIN, 24, 0, 54).bytes);
    liars.emplace_back("claims.tga", tga_start(10, 65535, 65535, 24, 0).bytes);
    Bytes jpeg = file_bytes(data_path("smooth.jpg"));
    constexpr std::array kFrame{0xff, 0xc0};
    const auto frame = std::search(jpeg.begin(), jpeg.end(), kFrame.begin(), kFrame.end());
    ASSERT_NE(frame, jpeg.end());
    std::fill_n(frame + 5, 4, std::uint8_t{0xff}); // height and width
    liars.emplace_back("claims.jpg", jpeg);
    for (const auto& [name, file] : liars) {
        const auto picture = decode(file, name);
        EXPECT_FALSE(picture) << name;
        expect_clean(picture, name);
    }
    EXPECT_LT(peak_resident_bytes(), before + 32 * kMegabyte);
}

// Each stays below what libpng itself allows a chunk; together they would take 140 MB.
TEST(Damage, PackedTextsInAPngAreNeverUnpacked) {
    Bytes text{'a', 0, 0};
    const Bytes packed = deflated(Bytes(7 * kMegabyte, 'x'));
    text.insert(text.end(), packed.begin(), packed.end());
    const Bytes file = png_file(1, 1, 8, 2, {0, 1, 2, 3}, std::vector<Chunk>(20, {"zTXt", text}));
    const std::uint64_t before = peak_resident_bytes();
    const auto picture = decode(file, "text.png");
    ASSERT_TRUE(picture) << picture.error().what;
    EXPECT_EQ(picture->at(0, 0), (Rgba8{1, 2, 3, 255}));
    EXPECT_LT(peak_resident_bytes(), before + 16 * kMegabyte);
}

TEST(Damage, AWrongChecksumIsRefused) {
    Bytes file = file_bytes(data_path("colours_rgb.png"));
    file[file.size() / 2] ^= 1;
    EXPECT_FALSE(decode(file, "x.png"));
}

TEST(Damage, RunsThatPassTheEndOfTheFileAreRefused) {
    Maker file = tga_start(10, 4, 4, 24, 0x20);
    file.u8({0xff, 1, 2}); // 128 pixels of a colour that is cut
    const auto picture = decode(file.bytes, "x.tga");
    ASSERT_FALSE(picture);
    EXPECT_EQ(picture.error().what, "x.tga: ends early: it holds fewer than its 4x4 pixels");
}

TEST(Damage, TooManyScansAreRefused) {
    const Bytes file = file_bytes(data_path("smooth_progressive.jpg"));
    constexpr std::array kScan{0xff, 0xda};
    std::vector<std::size_t> scans;
    for (auto at = file.begin();
         (at = std::search(at, file.end(), kScan.begin(), kScan.end())) != file.end(); ++at)
        scans.push_back(static_cast<std::size_t>(at - file.begin()));
    ASSERT_GE(scans.size(), 5u);
    // The last refinement again and again, as a hostile file would have it.
    Bytes bomb(file.begin(), file.end() - 2);
    for (int i = 0; i < 300; ++i)
        bomb.insert(bomb.end(), file.begin() + static_cast<std::ptrdiff_t>(scans.back()),
                    file.end() - 2);
    bomb.insert(bomb.end(), {0xff, 0xd9});
    const auto picture = decode(bomb, "scans.jpg");
    ASSERT_FALSE(picture);
    EXPECT_EQ(picture.error().what, "scans.jpg: not a readable JPEG: more than 100 scans");
}

TEST(Damage, EveryPictureOfTheBadCorpusIsRefusedInOneLine) {
    const std::filesystem::path folder =
        std::filesystem::path(SCANOUT_SOURCE_DIR) / "../shared/assets/bad/made";
    if (!std::filesystem::is_directory(folder)) return; // the laws above need no corpus
    const std::uint64_t before = peak_resident_bytes();
    int seen = 0;
    for (const char* name : {"bad.bmp", "bad.tga", "bomb.png", "claims.png", "trunc.png"}) {
        const std::string path = (folder / name).string();
        const auto picture = load(path);
        EXPECT_FALSE(picture) << path;
        expect_clean(picture, path);
        ++seen;
    }
    EXPECT_EQ(seen, 5);
    EXPECT_LT(peak_resident_bytes(), before + 32 * kMegabyte);
}

} // namespace
} // namespace scanout::image
