#include "app/view/mark.h"

#include "app/overlay/text.h"

namespace scanout::app {
// Yellow with a dark border: to be seen on every picture.
void draw_mark(image::Image& picture, PixelPlace at, int scale) {
    constexpr int kGap = 6, kArm = 14; // font pixels
    constexpr image::Rgba8 kYellow{255, 220, 0, 255}, kDark{0, 0, 0, 255};
    for (const bool dark : {true, false}) {
        const int border = dark ? scale : 0;
        const int gap = kGap * scale - border, end = (kGap + kArm) * scale + border;
        const int low = -border, high = scale + border; // across an arm
        const image::Rgba8 colour = dark ? kDark : kYellow;
        fill(picture, {at.x - end, at.y + low, at.x - gap, at.y + high}, colour);
        fill(picture, {at.x + gap, at.y + low, at.x + end, at.y + high}, colour);
        fill(picture, {at.x + low, at.y - end, at.x + high, at.y - gap}, colour);
        fill(picture, {at.x + low, at.y + gap, at.x + high, at.y + end}, colour);
    }
}

} // namespace scanout::app
