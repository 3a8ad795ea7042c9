// Weighted area sampling by a Gaussian of deviation 1/2 pixel, cut off at 1.5 pixels, where it is
// 0.011: the smoothest edges, and the least sharp ones.
#include "frame/anti_aliasing.h"
#include "math/transcendental.h"

namespace scanout::frame::aa {

extern const AntiAliasing gaussian;
constinit const AntiAliasing gaussian{
    .card = {.axis = "aa",
             .name = "gaussian",
             .blurb = "16 samples of 3 x 3 pixels under a Gaussian of half a pixel",
             .source = "Feibush, Levoy and Cook 1980",
             .kind = Kind::model},
    .samples = 16,
    .weight = [](double distance) { return exp2(-2 * 1.4426950408889634 * distance * distance); }};

} // namespace scanout::frame::aa
