// A pixel of the viewer's picture.
#pragma once

namespace scanout::app {

struct PixelPlace {
    int x = 0, y = 0;
    friend bool operator==(const PixelPlace&, const PixelPlace&) = default;
};

} // namespace scanout::app
