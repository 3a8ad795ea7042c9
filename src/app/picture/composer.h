// Composes the picture, its overlays (help, information, messages) and the pointer in the back
// buffer, and finds the rectangles in which it differs from the frame shown last.
#pragma once

#include "app/view/pixel_place.h"
#include "image/image.h"

#include <functional>
#include <optional>
#include <vector>

namespace scanout::app {

// The smallest rectangle outside of which two pictures of one size are the same.
image::Rect difference_area(const image::Image& before, const image::Image& after);

class Composer {
public:
    Composer(int width, int height);

    // A new picture, drawn over by `draw_overlay`. Transparent pixels become opaque: a display has
    // nothing behind them.
    void set_picture(const image::Image& picture,
                     const std::function<void(image::Image&)>& draw_overlay);
    void set_pointer(std::optional<PixelPlace> pointer);

    const image::Image& frame() const { return frame_; }
    // The damage since the last call; valid until the next.
    const std::vector<image::Rect>& take_damage();

private:
    void damage(const image::Rect& area);
    void copy_clean(const image::Rect& area);

    image::Image clean_, next_; // without the pointer
    image::Image frame_;
    std::optional<PixelPlace> pointer_;
    std::vector<image::Rect> damage_, taken_;
};

} // namespace scanout::app
