// Weighted area sampling by a tent: samples count by their distance from the pixel's centre,
// falling to nothing one pixel away, so that a small thing that moves changes the picture evenly.
#include "frame/anti_aliasing.h"

namespace scanout::frame::aa {

extern const AntiAliasing tent;
constinit const AntiAliasing tent{
    .card = {.axis = "aa",
             .name = "tent",
             .blurb = "16 samples of 3 x 3 pixels under a tent 2 pixels wide",
             .source = "Feibush, Levoy and Cook 1980",
             .kind = Kind::model},
    .samples = 16,
    .weight = [](double distance) { return distance < 1 ? 1 - distance : 0.0; }};

} // namespace scanout::frame::aa
