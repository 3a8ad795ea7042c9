#include "textbook/clip.h"

namespace scanout::textbook {

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
