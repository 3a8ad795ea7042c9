// Anti-aliasing by a number of samples or by exact areas. The arithmetic is in
// raster/coverage/coverage.h, raster/tile/area.h and the resolve.
#include "rows.h"

#include "frame/anti_aliasing.h"

namespace scanout::frame::aa {

namespace {

constexpr Technique card(std::string_view name, std::string_view blurb, std::string_view source,
                         LadderException may_err_more = {}) {
    return {"aa", name, blurb, source, Kind::rung, false, may_err_more};
}

} // namespace

// One sample in the middle of the pixel: edges are stairs, coverage is wrong by up to half a pixel.
constinit const AntiAliasing none{
    .card = card("none", "one sample a pixel: coverage 0.249 RMSE at an edge", "Crow 1981"),
    .samples = 1};

// Multisampling: 2 to 16 coverage samples a pixel, in Direct3D's standard pattern. A primitive is
// shaded once for all of them, at the pixel's centre if it covers that.
constinit const AntiAliasing samples_2{.card = card("samples_2",
                                                    "2 samples a pixel, shaded once: 0.159 RMSE",
                                                    "Akeley 1993; Microsoft 2015, 19.2"),
                                       .samples = 2};

constinit const AntiAliasing samples_4{.card = card("samples_4",
                                                    "4 samples a pixel, shaded once: 0.091 RMSE",
                                                    "Akeley 1993; Microsoft 2015, 19.2"),
                                       .samples = 4};

constinit const AntiAliasing samples_8{.card = card("samples_8",
                                                    "8 samples a pixel, shaded once: 0.057 RMSE",
                                                    "Akeley 1993; Microsoft 2015, 19.2"),
                                       .samples = 8};

constinit const AntiAliasing samples_16{.card = card("samples_16",
                                                     "16 samples a pixel, shaded once: 0.044 RMSE",
                                                     "Akeley 1993; Microsoft 2015, 19.2"),
                                        .samples = 16};

// Supersampling: renders the picture at 2 or 4 times the width and height, shades every pixel of
// it, and averages each square: textures and highlights are smoothed, too.
constinit const AntiAliasing supersampling_2{
    .card = card("supersampling_2", "2 x 2 shaded pixels for one: 0.086 RMSE, and smooth insides",
                 "Crow 1981",
                 {"samples_4 samples_8 samples_16",
                  "of an edge it has 4 samples, in 2 rows and 2 columns; it is the better one "
                  "where insides are not smooth"}),
    .scale = 2};

constinit const AntiAliasing supersampling_4{
    .card = card("supersampling_4", "4 x 4 shaded pixels for one: 0.030 RMSE, and smooth insides",
                 "Crow 1981"),
    .scale = 4};

// Unweighted area sampling: a primitive counts by the exact area that it shows in the pixel's box
// (raster/tile/area.h). It is shaded once a pixel.
constinit const AntiAliasing area{
    .card = card("area", "exact areas in the pixel's box: no error of coverage", "Catmull 1978",
                 {"supersampling_2 supersampling_4",
                  "it shades a primitive once a pixel: textures, highlights and edges of shadows "
                  "stay as rough as with one sample"}),
    .exact = true};

} // namespace scanout::frame::aa
