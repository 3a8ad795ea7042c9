// Everything that a picture of the viewer depends on. Pictures of equal keys are equal.
#pragma once

#include "app/view/viewer_state.h"

namespace scanout::app {

struct PictureKey {
    Look look;
    int generation = -1;       // of the model slot
    int rung = -1;             // of the frontier, that , and . chose; -1: none
    int width = 0, height = 0; // pixels
    friend bool operator==(const PictureKey&, const PictureKey&) = default;
};

// A turning model gives the same picture as one that stands at the same angle, a motion the same as
// its moment.
inline PictureKey picture_key(const Look& look, int generation) {
    PictureKey key{look, generation};
    key.look.turntable = key.look.plays = false;
    return key;
}

} // namespace scanout::app
