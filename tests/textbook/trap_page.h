// A trap of the documents: the naive way and ours run in one test, and both draw a picture. The
// pages of docs/traps are made of them: `test_textbook --gtest_filter='Trap*'` with
// SCANOUT_UPDATE_GOLDEN=1 writes them, without it holds them against what is drawn.
#pragma once

#include "raster/exact.h"
#include "textbook/models.h"
#include "textbook/pixels.h"

#include <string>

namespace scanout::textbook::test {

struct TrapPage {
    int number;
    std::string name;     // of the files: 02-near-horizontal-edge
    std::string title;    // "A near-horizontal edge"
    std::string sentence; // what goes wrong, and what cures it
    std::string source;   // "[Compendium 2.2]"
    std::string measured; // this test's figures
    image::Image naive, ours;
};
void check_page(const TrapPage& page);

// Each pixel a square of k x k.
image::Image enlarged(const image::Image& small, int k);

inline constexpr image::Rgba8 kInk{230, 170, 40, 255}, kPaper{48, 51, 56, 255},
    kTwice{220, 50, 40, 255};
// Once: ink; more often: red.
image::Image picture_of(const std::map<Pixel, int>& hits, int width, int height);

// The pixels that the production renderer's first tile gives a triangle, whose corners are pixels
// where a pixel is the point with whole coordinates.
std::map<Pixel, int> production_hits(const std::vector<Points>& triangles);

} // namespace scanout::textbook::test
