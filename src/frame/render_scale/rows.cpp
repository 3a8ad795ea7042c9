// Shares of the picture's size. The arithmetic is in image/enlarge.h.
#include "rows.h"

#include "frame/render_scale.h"

namespace scanout::frame::render_scale {

namespace {

constexpr Technique card(std::string_view name, std::string_view blurb) {
    return {"render_scale", name, blurb, "Heckbert 1989", Kind::rung};
}

} // namespace

constinit const RenderScale quarter{
    .card = card("quarter", "1/4 of the size on each side, enlarged: 1/16 of the pixels"),
    .numerator = 1,
    .denominator = 4};

constinit const RenderScale third{
    .card = card("third", "1/3 of the size on each side, enlarged: 1/9 of the pixels"),
    .numerator = 1,
    .denominator = 3};

constinit const RenderScale half{
    .card = card("half", "1/2 of the size on each side, enlarged: 1/4 of the pixels"),
    .numerator = 1,
    .denominator = 2};

constinit const RenderScale two_thirds{
    .card = card("two_thirds", "2/3 of the size on each side, enlarged: 4/9 of the pixels"),
    .numerator = 2,
    .denominator = 3};

constinit const RenderScale three_quarters{
    .card = card("three_quarters", "3/4 of the size on each side, enlarged: 9/16 of the pixels"),
    .numerator = 3,
    .denominator = 4};

constinit const RenderScale full{.card = card("full", "every pixel is drawn")};

} // namespace scanout::frame::render_scale
