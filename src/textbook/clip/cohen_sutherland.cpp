// The method of Cohen and Sutherland (Newman and Sproull 1979), [Primer 1.4.5]: accept where
// neither end is beyond a side, reject where both are beyond the same one, else cut at one side and
// ask again.
#include "textbook/clip/outcode.h"

namespace scanout::textbook {

std::optional<Segment> clip_cohen_sutherland(const Segment& line, const Box& box) {
    auto [a, b] = line;
    for (;;) {
        const unsigned code_a = outcode(a, box), code_b = outcode(b, box);
        if ((code_a | code_b) == 0) return Segment{a, b};
        if ((code_a & code_b) != 0) return std::nullopt;
        const unsigned code = code_a != 0 ? code_a : code_b;
        const DVec2 way = b - a;
        DVec2 cut;
        if ((code & (kLeft | kRight)) != 0) {
            const double x = (code & kLeft) != 0 ? box.left : box.right;
            cut = DVec2(x, a.y + (x - a.x) / way.x * way.y);
        } else {
            const double y = (code & kTop) != 0 ? box.top : box.bottom;
            cut = DVec2(a.x + (y - a.y) / way.y * way.x, y);
        }
        (code == code_a ? a : b) = cut;
    }
}

} // namespace scanout::textbook
