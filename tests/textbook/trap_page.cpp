#include "textbook/trap_page.h"

#include "image/codec.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace scanout::textbook::test {
namespace {

const std::string kFolder = SCANOUT_SOURCE_DIR "/docs/traps/";

bool updates() {
    const char* value = std::getenv("SCANOUT_UPDATE_GOLDEN");
    return value != nullptr && std::string(value) == "1";
}

std::string read(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void check_file(const std::string& path, const std::string& content) {
    if (updates()) {
        std::filesystem::create_directories(kFolder);
        std::ofstream(path, std::ios::binary) << content;
        return;
    }
    EXPECT_TRUE(read(path) == content)
        << path << " is not what is drawn now: SCANOUT_UPDATE_GOLDEN=1 writes it; look at it";
}

// By pixels: another zlib may pack the same picture into other bytes.
void check_picture(const std::string& path, const image::Image& picture) {
    if (updates()) {
        const auto bytes = image::encode_png(picture);
        ASSERT_TRUE(bytes);
        check_file(path, std::string(bytes->begin(), bytes->end()));
        return;
    }
    const auto shown = image::load(path);
    ASSERT_TRUE(shown) << path;
    EXPECT_TRUE(*shown == picture)
        << path << " is not what is drawn now: SCANOUT_UPDATE_GOLDEN=1 writes it; look at it";
}

} // namespace

image::Image enlarged(const image::Image& small, int k) {
    image::Image large(small.width() * k, small.height() * k);
    for (int y = 0; y < large.height(); ++y)
        for (int x = 0; x < large.width(); ++x)
            large.at(x, y) = small.at(x / k, y / k);
    return large;
}

image::Image picture_of(const std::map<Pixel, int>& hits, int width, int height) {
    image::Image out(width, height, kPaper);
    for (const auto& [p, count] : hits)
        if (p.x >= 0 && p.y >= 0 && p.x < width && p.y < height)
            out.at(p.x, p.y) = count > 1 ? kTwice : kInk;
    return out;
}

std::map<Pixel, int> production_hits(const std::vector<Points>& triangles) {
    std::map<Pixel, int> hits;
    raster::VisibilityTile tile;
    for (const Points& p : triangles) {
        tile.reset({0, 0, 64, 64}, 1);
        raster::test::Corners v;
        for (std::size_t i = 0; i < 3; ++i)
            v[i] = {static_cast<int>(std::lround(p[i].x * 256)) + 128,
                    static_cast<int>(std::lround(p[i].y * 256)) + 128};
        if (!raster::test::has_area(v)) continue;
        tile.draw(raster::test::set_up(v, 1));
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x)
                if (tile.id(x, y) == 1) ++hits[{x, y}];
    }
    return hits;
}

void check_page(const TrapPage& page) {
    const std::string stem = fmt::format("{:02}-{}", page.number, page.name);
    check_picture(kFolder + stem + "-naive.png", page.naive);
    check_picture(kFolder + stem + "-ours.png", page.ours);
    check_file(kFolder + stem + ".md",
               fmt::format("# {}\n\n{}\n\n| naive | ours |\n|---|---|\n"
                           "| ![the naive way]({}-naive.png) | ![ours]({}-ours.png) |\n\n"
                           "Measured: {}. Source: {}. `tests/textbook/trap_{:02}_test.cpp` draws "
                           "both pictures.\n",
                           page.title, page.sentence, stem, stem, page.measured, page.source,
                           page.number));
}

// After the pages, by its name: an index of what is there.
TEST(TrapsIndex, NamesEveryPage) {
    std::map<std::string, std::string> titles;
    for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
        const std::string name = entry.path().filename().string();
        if (!name.ends_with(".md") || name == "README.md") continue;
        const std::string text = read(entry.path().string());
        titles[name] = text.substr(2, text.find('\n') - 2);
        for (const char* picture : {"-naive.png", "-ours.png"})
            EXPECT_TRUE(
                std::filesystem::exists(kFolder + name.substr(0, name.size() - 3) + picture));
    }
    EXPECT_EQ(titles.size(), 18U);
    std::string index =
        "# Traps\n\nWhere the simple ways of textbooks fail: two pictures, one "
        "sentence and figures each, made by the test of the same number, which runs "
        "both ways. [TEXTBOOK.md](../TEXTBOOK.md) draws with them.\n\n";
    for (const auto& [name, title] : titles)
        index += fmt::format("- [{}]({})\n", title, name);
    check_file(kFolder + "README.md", index);
}

} // namespace scanout::textbook::test
