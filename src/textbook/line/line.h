// Lines between two pixels, both drawn, as the documents have them: a method each.
#pragma once

#include "textbook/methods.h"

#include <functional>

namespace scanout::textbook {

struct Pixel {
    int x = 0, y = 0;
    friend bool operator==(const Pixel&, const Pixel&) = default;
    friend auto operator<=>(const Pixel&, const Pixel&) = default;
};
// share: how much of the pixel the line takes, 0 to 1.
using Plot = std::function<void(int x, int y, double share)>;
using LineMethod = void (*)(Pixel a, Pixel b, const Plot& plot);

#define TEXTBOOK_DECLARE(name, blurb) void line_##name(Pixel a, Pixel b, const Plot& plot);
TEXTBOOK_LINE(TEXTBOOK_DECLARE)
#undef TEXTBOOK_DECLARE
LineMethod line_method(Line line);

} // namespace scanout::textbook
