// The table of contents: every axis, and on each its techniques: rungs cheapest first. One name =
// one row of src/<module>/<axis> = one entry everywhere: command line, lists, goldens, tests.
#pragma once

#define SCANOUT_INTERPOLATE(X) X(affine) X(affine_16) X(affine_8) X(adaptive) X(perspective)
#define SCANOUT_TEXTURE(X)                                                                         \
    X(nearest)                                                                                     \
    X(bilinear)                                                                                    \
    X(bicubic)                                                                                     \
    X(mipmap) X(trilinear) X(anisotropic_2) X(anisotropic_4) X(anisotropic_8) X(anisotropic_16)
#define SCANOUT_WRAP(X) X(repeat) X(mirror) X(clamp)
#define SCANOUT_MAPPING(X) X(uv) X(plane) X(box) X(cylinder) X(sphere)
#define SCANOUT_SOURCE(X) X(image) X(checker) X(white_noise) X(perlin_noise)
#define SCANOUT_MAP(X)                                                                             \
    X(diffuse)                                                                                     \
    X(opacity) X(normal) X(bump) X(specular) X(gloss) X(roughness) X(metalness) X(emission)
#define SCANOUT_LIGHT(X) X(ambient) X(hemisphere) X(directional) X(point) X(spot)
#define SCANOUT_SHADOW(X) X(attached) X(projected) X(map) X(map_pcf) X(map_soft) X(volume)
#define SCANOUT_AMBIENT_OCCLUSION(X) X(none) X(gtao_4) X(gtao_8) X(gtao_16)
#define SCANOUT_REFLECTION(X)                                                                      \
    X(lambert) X(toon) X(phong) X(blinn_phong) X(blinn_phong_normalised) X(ggx)
#define SCANOUT_SHADING(X) X(flat) X(gouraud) X(per_pixel_raw) X(per_pixel)
#define SCANOUT_COLOUR_BY(X) X(light) X(normal) X(depth) X(side) X(material) X(part)
#define SCANOUT_SIDES(X) X(one_sided) X(two_sided)
#define SCANOUT_CULL(X) X(material) X(none) X(back) X(front)
#define SCANOUT_DEPTH(X) X(fixed_16) X(fixed_24) X(float_32) X(linear) X(reversed)
#define SCANOUT_DEPTH_TEST(X)                                                                      \
    X(equal) X(not_equal) X(always) X(never) X(greater) X(greater_equal) X(less_equal) X(less)
#define SCANOUT_BLEND(X) X(none) X(over) X(add) X(subtract) X(multiply) X(screen)
#define SCANOUT_STENCIL(X) X(none) X(outline) X(overdraw)
#define SCANOUT_EDGES(X) X(none) X(feature) X(all)
#define SCANOUT_TRANSPARENCY(X) X(cut_out) X(sorted) X(exact)
#define SCANOUT_AA(X)                                                                              \
    X(none)                                                                                        \
    X(samples_2)                                                                                   \
    X(samples_4)                                                                                   \
    X(samples_8) X(samples_16) X(tent) X(gaussian) X(supersampling_2) X(supersampling_4) X(area)
#define SCANOUT_RENDER_SCALE(X) X(quarter) X(third) X(half) X(two_thirds) X(three_quarters) X(full)
#define SCANOUT_EXPOSURE(X) X(none) X(stops)
#define SCANOUT_TONE(X) X(clamp) X(shoulder) X(filmic)
#define SCANOUT_BLEND_SPACE(X) X(encoded) X(linear)
#define SCANOUT_ENCODE(X) X(square_root) X(power_2_2) X(srgb)
#define SCANOUT_DITHER(X) X(none) X(bayer)
#define SCANOUT_CONVOLUTION(X) X(low_pass) X(high_pass)

// X(module, axis, list of techniques, type of their rows, choice, help of the option --axis).
// Choice: asked (by name; "auto" where nobody asks), listed (by one of a few names that the help
// lists; the first where nobody asks), planned (no option: the scene, or another option, decides).
// clang-format off
#define SCANOUT_AXES(X)                                                                            \
    X(shade, interpolate, SCANOUT_INTERPOLATE, Stage, asked,                                       \
      "how attributes are interpolated: how often they are divided by distance (`list "            \
      "techniques`)")                                                                              \
    X(shade, texture, SCANOUT_TEXTURE, Filter, asked,                                              \
      "how textures are filtered (`list techniques`)")                                             \
    X(shade, wrap, SCANOUT_WRAP, Wrapping, asked,                                                  \
      "texels beyond a texture's edges (`list techniques`); auto: by the material")     \
    X(shade, mapping, SCANOUT_MAPPING, Stage, asked,                                               \
      "how textures lie on the model (`list techniques`); auto: by its uv; a model without uv "    \
      "shows no maps, and a --source lies on it as on a box")                                      \
    X(shade, source, SCANOUT_SOURCE, Source, asked,                                                \
      "colour all surfaces with a computed texture (`list techniques`); auto: the materials' own") \
    X(shade, map, SCANOUT_MAP, Stage, planned, "")                                                 \
    X(shade, light, SCANOUT_LIGHT, LightStage, planned, "")                                        \
    X(shade, shadow, SCANOUT_SHADOW, ShadowStage, asked,                                           \
      "how shadows are drawn (`list techniques`); auto: map_soft where a light has a size, else "  \
      "map_pcf")                                                                                   \
    X(shade, ambient_occlusion, SCANOUT_AMBIENT_OCCLUSION, AmbientOcclusion, asked,                \
      "keep the light from everywhere off surfaces that others stand close to (`list "             \
      "techniques`); auto: none")                                                                  \
    X(shade, reflection, SCANOUT_REFLECTION, ReflectionStage, asked,                               \
      "how surfaces reflect (`list techniques`)")                                                  \
    X(shade, shading, SCANOUT_SHADING, ShadingStage, asked,                                        \
      "where light is evaluated: once a face, at vertices, at pixels (`list techniques`)")         \
    X(shade, colour_by, SCANOUT_COLOUR_BY, ColourBy, asked,                                        \
      "colour surfaces by a fact, unlit, in place of light (`list techniques`); auto: light")      \
    X(shade, sides, SCANOUT_SIDES, LitSides, planned, "")                                          \
    X(raster, cull, SCANOUT_CULL, CullRow, listed,                                                 \
      "leave out back faces, or front faces (`list techniques`)")                                  \
    X(raster, depth, SCANOUT_DEPTH, DepthFormatRow, asked,                                         \
      "how depth is stored (`list techniques`); auto: reversed")                                   \
    X(raster, depth_test, SCANOUT_DEPTH_TEST, DepthTestRow, asked,                                 \
      "which of several surfaces is visible, where they do not blend (`list techniques`); auto: "  \
      "less, the nearest")                                                                      \
    X(shade, blend, SCANOUT_BLEND, Blend, asked,                                                   \
      "how blended surfaces mix with the background (`list techniques`); auto: over")       \
    X(frame, stencil, SCANOUT_STENCIL, Stencil, asked,                                             \
      "mark pixels: draw a line around the model, or show how many surfaces cover each pixel "     \
      "(`list techniques`); auto: none")                                                           \
    X(frame, edges, SCANOUT_EDGES, Edges, asked,                                                   \
      "draw the edges of faces over the shading: all of them, or where the surface ends or bends " \
      "(`list techniques`); auto: none")                                                           \
    X(shade, transparency, SCANOUT_TRANSPARENCY, Transparency, asked,                              \
      "how transparent surfaces are drawn (`list techniques`); auto: exact, and cut_out where "    \
      "alpha is only 0 or 1")                                                                      \
    X(frame, aa, SCANOUT_AA, AntiAliasing, asked,                                                  \
      "how edges are smoothed (`list techniques`); auto: what --samples says")                     \
    X(frame, render_scale, SCANOUT_RENDER_SCALE, RenderScale, asked,                               \
      "draw fewer pixels, and enlarge the picture to its size (`list techniques`); auto: full")    \
    X(shade, exposure, SCANOUT_EXPOSURE, Stage, planned, "")                                       \
    X(shade, tone, SCANOUT_TONE, ToneStage, asked,                                                 \
      "how light above 1 is shown (`list techniques`)")                                            \
    X(shade, blend_space, SCANOUT_BLEND_SPACE, BlendSpace, asked,                                  \
      "the space in which the samples of a pixel are mixed (`list techniques`)")                   \
    X(shade, encode, SCANOUT_ENCODE, Encoding, asked,                                              \
      "how light is encoded (`list techniques`)")                                                  \
    X(image, dither, SCANOUT_DITHER, Dither, asked,                                                \
      "how light between two codes is shown (`list techniques`); auto: none in 8 bits, bayer "     \
      "where the display (or --pixel-format) has fewer")                                           \
    X(image, convolution, SCANOUT_CONVOLUTION, Convolution, asked,                                 \
      "filter the finished picture (`list techniques`); auto: no filter")
// clang-format on
