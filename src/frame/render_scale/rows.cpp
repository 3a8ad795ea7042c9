// Shares of the picture's size. The arithmetic is in image/enlarge.h.
#include "rows.h"

#include "frame/render_scale.h"

namespace scanout::frame::render_scale {

static constexpr RenderScale row(std::string_view name, std::string_view blurb, int numerator,
                                 int denominator) {
    return {{"render_scale", name, blurb, "Heckbert 1989", Kind::rung}, numerator, denominator};
}

constinit const RenderScale quarter{
    row("quarter", "1/4 of the size on each side, enlarged: 1/16 of the pixels", 1, 4)};
constinit const RenderScale third{
    row("third", "1/3 of the size on each side, enlarged: 1/9 of the pixels", 1, 3)};
constinit const RenderScale half{
    row("half", "1/2 of the size on each side, enlarged: 1/4 of the pixels", 1, 2)};
constinit const RenderScale two_thirds{
    row("two_thirds", "2/3 of the size on each side, enlarged: 4/9 of the pixels", 2, 3)};
constinit const RenderScale three_quarters{
    row("three_quarters", "3/4 of the size on each side, enlarged: 9/16 of the pixels", 3, 4)};
constinit const RenderScale full{row("full", "every pixel is drawn", 1, 1)};

} // namespace scanout::frame::render_scale
