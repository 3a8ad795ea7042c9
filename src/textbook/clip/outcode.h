// The outcode of a point [Primer 1.4.5]: a bit for each side of the box that it lies beyond.
#pragma once

#include "textbook/clip/clip.h"

namespace scanout::textbook {

enum Outcode : unsigned { kLeft = 1, kRight = 2, kTop = 4, kBottom = 8 };

inline unsigned outcode(const DVec2& p, const Box& box) {
    return (p.x < box.left ? kLeft : 0U) | (p.x > box.right ? kRight : 0U) |
           (p.y < box.top ? kTop : 0U) | (p.y > box.bottom ? kBottom : 0U);
}

} // namespace scanout::textbook
