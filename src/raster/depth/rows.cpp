// Depth formats. The arithmetic is in raster/coverage/depth_rule.h.
#include "rows.h"

#include "raster/coverage/depth_rule.h"

namespace scanout::raster::depth {

namespace {

constexpr Technique card(std::string_view name, std::string_view blurb, std::string_view source) {
    return {"depth", name, blurb, source, Kind::rung};
}

constexpr Technique linear_card() {
    Technique made = card("linear",
                          "24 bits in even steps of the distance, from near to behind "
                          "the model",
                          "Lapidous and Jiao 1999");
    made.may_err_more = {"fixed_24 float_32", "its steps are as large just before the eye as far "
                                              "away: near surfaces have fewer of them"};
    return made;
}

} // namespace

// Depth in 16 bits: 1 - near / distance in 65535 steps. At a ratio of distances of 1e7 it separates
// less than half of all pairs that lie a hundredth apart, and none a millionth apart. Near is
// 1/16384 of the distance to the target: a step there is 16384/65535 of it, so the nearest and the
// farthest side of a model may fall into one step, and the lower id is visible.
constinit const DepthFormatRow fixed_16{card("fixed_16",
                                             "16 bits, from near to infinitely far: around the "
                                             "target, steps of a quarter of its distance",
                                             "Catmull 1974"),
                                        true, 65535};

// Depth in 24 bits: 1 - near / distance in 2^24 - 1 steps, the usual depth buffer for many years.
// At a ratio of 1e7 it fails to separate 19 % of pairs a hundredth apart, 76 % of pairs a millionth
// apart.
constinit const DepthFormatRow fixed_24{
    card("fixed_24", "24 bits: around the target, steps of a thousandth of its distance",
         "Catmull 1974; Lapidous and Jiao 1999"),
    true, 16777215};

// Depth in a float, 1 - near / distance: its finest steps lie just behind the near plane, where
// models seldom are.
constinit const DepthFormatRow float_32{
    card("float_32",
         "a float that grows with the distance: no better than 24 bits, steps of a thousandth",
         "Lapidous and Jiao 1999"),
    true, 0};

// The distance itself in even steps, as a w-buffer keeps it: just before the eye coarser than the
// others, behind it finer than those that divide. What is interpolated is 1 / distance, so no edge
// bends [ClipSpace 4.2].
constinit const DepthFormatRow linear{linear_card(), true, 16777215, true};

// Reversed depth, near / distance in a float: steps of 2^-24 of the distance, near and far.
// Lapidous and Jiao 1999; HARD-CASES L2.
constinit const DepthFormatRow reversed{
    card("reversed", "a float that falls with the distance: the same precision everywhere",
         "Lapidous and Jiao 1999"),
    false, 0};

} // namespace scanout::raster::depth
