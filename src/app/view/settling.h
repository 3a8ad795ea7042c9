// Whether the picture moves: from the first change until it has been seen unchanged for a while.
#pragma once

#include "app/picture/picture_key.h"

#include <chrono>

namespace scanout::app {

class Settling {
public:
    using Time = std::chrono::steady_clock::time_point;
    static constexpr std::chrono::milliseconds kSettle{150};

    // The picture that is asked for at `now`. `turning`: by itself, so that it will be another one
    // soon. True where a movement has ended since the last call, also where one begins again by
    // now.
    bool follow(const PictureKey& asked, bool turning, Time now);
    // It has been drawn: a slow frame is no stillness.
    void shown(Time now) { since_ = now; }

    bool moves() const { return moves_; }
    const PictureKey& picture() const { return picture_; } // the one that was asked for last
    Time settles() const { return since_ + kSettle; }      // unless it turns

private:
    PictureKey picture_;
    Time since_{};
    bool turning_ = false, moves_ = false;
};

} // namespace scanout::app
