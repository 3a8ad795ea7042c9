// The table of contents: one line an axis, cheapest first. One name = one file
// src/<module>/<axis>/<name>.cpp = one row everywhere: command line, lists, goldens, tests.
#pragma once

#define SCANOUT_INTERPOLATE(X) X(perspective)
#define SCANOUT_TEXTURE(X) X(nearest) X(bilinear)
#define SCANOUT_MAP(X) X(diffuse) X(opacity)
#define SCANOUT_LIGHT(X) X(ambient) X(directional) X(point) X(spot)
#define SCANOUT_REFLECTION(X) X(lambert) X(blinn_phong)
#define SCANOUT_DEPTH(X) X(fixed_16) X(fixed_24) X(float_32) X(reversed)
#define SCANOUT_DEPTH_TEST(X)                                                                      \
    X(equal) X(always) X(never) X(less) X(less_equal) X(greater_equal) X(greater)
#define SCANOUT_BLEND(X) X(none) X(over) X(add) X(subtract)
#define SCANOUT_TRANSPARENCY(X) X(cut_out) X(sorted) X(exact)
