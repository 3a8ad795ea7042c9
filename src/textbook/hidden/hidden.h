// Hidden surfaces: which of several faces a pixel shows. A method calls shade(triangle, y, x0, x1)
// for the pixels that it lets show, and what it calls later lies over what it called before.
#pragma once

#include "textbook/methods.h"
#include "textbook/triangle.h"

#include <functional>
#include <vector>

namespace scanout::textbook {

using Shade = std::function<void(const Triangle& triangle, int y, int x0, int x1)>;
struct HiddenTask {
    const std::vector<Triangle>& triangles; // in the order of the file
    int width, height;
    FillMethod fill;
    bool equal_passes; // an equal depth, too
    // What `none` draws in place of faces, and what draws it.
    const std::vector<Wire>& wires;
    std::function<void(const Wire& wire)> draw_wire;
};
using HiddenMethod = void (*)(const HiddenTask& task, const Shade& shade);

#define TEXTBOOK_DECLARE(name, blurb)                                                              \
    void hidden_##name(const HiddenTask& task, const Shade& shade);
TEXTBOOK_HIDDEN(TEXTBOOK_DECLARE)
#undef TEXTBOOK_DECLARE
HiddenMethod hidden_method(Hidden hidden);

// The pixels of a triangle that lie in the picture.
void fill_in_picture(const HiddenTask& task, const Triangle& triangle, const Span& span);

// Depth at a pixel: what is linear on the screen (C + D/z), and what is linear in space.
double depth_on_screen(const Triangle& t, int x, int y);
double depth_in_space(const Triangle& t, int x, int y);

// Of two methods: the depth before the division by w, of a distance between n and f.
double clip_depth_z_linear(double distance, double w, double n, double f);
double clip_depth_z_squared(double distance, double w);

using DepthOf = double (*)(const Triangle& t, int x, int y);
// [Compendium 6.2], [Course 4.3.2]: a depth a pixel, at first farther than everything.
void z_buffer(const HiddenTask& task, DepthOf depth_of, const Shade& shade);

} // namespace scanout::textbook
