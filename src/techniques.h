// The table of contents: one line an axis, cheapest first. One name = one file
// src/<module>/<axis>/<name>.cpp = one row everywhere: command line, lists, goldens, tests.
#pragma once

#define SCANOUT_INTERPOLATE(X) X(perspective)
#define SCANOUT_TEXTURE(X) X(nearest) X(bilinear)
#define SCANOUT_MAP(X) X(diffuse)
#define SCANOUT_LIGHT(X) X(ambient) X(directional) X(point) X(spot)
#define SCANOUT_SHADOW(X) X(attached) X(projected) X(map) X(map_pcf) X(map_soft) X(volume)
#define SCANOUT_REFLECTION(X) X(lambert) X(blinn_phong)
