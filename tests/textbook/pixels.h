// What the tests of textbook methods share: the pixels that a method draws, and how often.
#pragma once

#include "support/random.h"
#include "textbook/fill/fill.h"
#include "textbook/line/line.h"

#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace scanout::textbook::test {

using scanout::test::Random;
using PixelSet = std::set<Pixel>;

inline std::map<Pixel, int> hits_of(FillMethod fill, const Points& p) {
    std::map<Pixel, int> hits;
    fill(p, [&](int y, int x0, int x1) {
        for (int x = x0; x < x1; ++x)
            ++hits[{x, y}];
    });
    return hits;
}
inline PixelSet pixels_of(FillMethod fill, const Points& p) {
    PixelSet pixels;
    for (const auto& [pixel, count] : hits_of(fill, p))
        pixels.insert(pixel);
    return pixels;
}
inline PixelSet pixels_of(LineMethod line, Pixel a, Pixel b) {
    PixelSet pixels;
    line(a, b, [&](int x, int y, double) { pixels.insert({x, y}); });
    return pixels;
}

inline Points whole_triangle(Random& random, int size) {
    Points p;
    for (DVec2& corner : p)
        corner = DVec2(random.whole(0, size), random.whole(0, size));
    return p;
}

inline void record(const std::string& name, double value) {
    testing::Test::RecordProperty(name, testing::PrintToString(value));
}

} // namespace scanout::textbook::test
