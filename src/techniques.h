// The table of contents: one line an axis, cheapest first. One name = one file
// src/<module>/<axis>/<name>.cpp = one row everywhere: command line, lists, goldens, tests.
#pragma once

#define SCANOUT_INTERPOLATE(X) X(affine) X(affine_16) X(affine_8) X(adaptive) X(perspective)
#define SCANOUT_TEXTURE(X)                                                                         \
    X(nearest)                                                                                     \
    X(bilinear)                                                                                    \
    X(mipmap) X(trilinear) X(anisotropic_2) X(anisotropic_4) X(anisotropic_8) X(anisotropic_16)
#define SCANOUT_WRAP(X) X(repeat) X(mirror) X(clamp)
#define SCANOUT_MAPPING(X) X(uv) X(plane) X(box) X(cylinder) X(sphere)
#define SCANOUT_SOURCE(X) X(image) X(checker) X(white_noise) X(perlin_noise)
#define SCANOUT_MAP(X)                                                                             \
    X(diffuse)                                                                                     \
    X(opacity) X(normal) X(bump) X(specular) X(gloss) X(roughness) X(metalness) X(emission)
#define SCANOUT_LIGHT(X) X(ambient) X(directional) X(point) X(spot)
#define SCANOUT_SHADOW(X) X(attached) X(projected) X(map) X(map_pcf) X(map_soft) X(volume)
#define SCANOUT_REFLECTION(X) X(lambert) X(phong) X(blinn_phong) X(blinn_phong_normalised) X(ggx)
#define SCANOUT_SHADING(X) X(flat) X(gouraud) X(per_pixel_raw) X(per_pixel)
#define SCANOUT_SIDES(X) X(one_sided) X(two_sided)
#define SCANOUT_CULL(X) X(none) X(back) X(front)
#define SCANOUT_DEPTH(X) X(fixed_16) X(fixed_24) X(float_32) X(reversed)
#define SCANOUT_DEPTH_TEST(X)                                                                      \
    X(equal) X(always) X(never) X(less) X(less_equal) X(greater_equal) X(greater)
#define SCANOUT_BLEND(X) X(none) X(over) X(add) X(subtract) X(multiply) X(screen)
#define SCANOUT_STENCIL(X) X(none) X(outline) X(overdraw)
#define SCANOUT_TRANSPARENCY(X) X(cut_out) X(sorted) X(exact)
#define SCANOUT_AA(X)                                                                              \
    X(none)                                                                                        \
    X(samples_2)                                                                                   \
    X(samples_4)                                                                                   \
    X(samples_8) X(samples_16) X(tent) X(gaussian) X(supersampling_2) X(supersampling_4) X(area)
#define SCANOUT_EXPOSURE(X) X(none) X(stops)
#define SCANOUT_TONE(X) X(clamp) X(shoulder) X(filmic)
#define SCANOUT_BLEND_SPACE(X) X(encoded) X(linear)
#define SCANOUT_ENCODE(X) X(square_root) X(power_2_2) X(srgb)
#define SCANOUT_DITHER(X) X(none) X(bayer)
#define SCANOUT_CONVOLUTION(X) X(low_pass) X(high_pass)
