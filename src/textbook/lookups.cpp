// From the rows of methods.h to the functions that they name.
#include "textbook/clip/clip.h"
#include "textbook/hidden/hidden.h"
#include "textbook/interpolation/interpolation.h"
#include "textbook/line/line.h"

namespace scanout::textbook {

#define TEXTBOOK_LOOKUP(Function, lookup, Type, METHODS, X)                                        \
    Function lookup(Type method) {                                                                 \
        static constexpr std::array kFunctions = {METHODS(X)};                                     \
        return kFunctions[static_cast<std::size_t>(method)];                                       \
    }
#define TEXTBOOK_NAME(name, blurb) line_##name,
TEXTBOOK_LOOKUP(LineMethod, line_method, Line, TEXTBOOK_LINE, TEXTBOOK_NAME)
#undef TEXTBOOK_NAME
#define TEXTBOOK_NAME(name, blurb) fill_##name,
TEXTBOOK_LOOKUP(FillMethod, fill_method, Fill, TEXTBOOK_FILL, TEXTBOOK_NAME)
#undef TEXTBOOK_NAME
#define TEXTBOOK_NAME(name, blurb) interpolate_##name,
TEXTBOOK_LOOKUP(InterpolationMethod, interpolation_method, Interpolation, TEXTBOOK_INTERPOLATION,
                TEXTBOOK_NAME)
#undef TEXTBOOK_NAME
#define TEXTBOOK_NAME(name, blurb) hidden_##name,
TEXTBOOK_LOOKUP(HiddenMethod, hidden_method, Hidden, TEXTBOOK_HIDDEN, TEXTBOOK_NAME)
#undef TEXTBOOK_NAME
#undef TEXTBOOK_LOOKUP

// Only lines have one shape: faces are cut before or after the division.
LineClip line_clip(Clip clip) {
    switch (clip) {
    case Clip::cohen_sutherland:
        return clip_cohen_sutherland;
    case Clip::midpoint_subdivision:
        return clip_midpoint_subdivision;
    default:
        return clip_liang_barsky;
    }
}

} // namespace scanout::textbook
