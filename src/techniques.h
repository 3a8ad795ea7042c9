// The table of contents: one line an axis, cheapest first. One name = one file
// src/<module>/<axis>/<name>.cpp = one row everywhere: command line, lists, goldens, tests.
#pragma once

#define SCANOUT_INTERPOLATE(X) X(perspective)
#define SCANOUT_TEXTURE(X)                                                                         \
    X(nearest)                                                                                     \
    X(bilinear)                                                                                    \
    X(mipmap) X(trilinear) X(anisotropic_2) X(anisotropic_4) X(anisotropic_8) X(anisotropic_16)
#define SCANOUT_WRAP(X) X(repeat) X(mirror) X(clamp)
#define SCANOUT_MAP(X) X(diffuse) X(opacity)
#define SCANOUT_LIGHT(X) X(ambient) X(directional) X(point) X(spot)
#define SCANOUT_REFLECTION(X) X(lambert) X(phong) X(blinn_phong) X(blinn_phong_normalised) X(ggx)
#define SCANOUT_SHADING(X) X(flat) X(gouraud) X(per_pixel_raw) X(per_pixel)
#define SCANOUT_TRANSPARENCY(X) X(cut_out) X(sorted) X(exact)
