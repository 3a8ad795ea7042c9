#include "app/view/settling.h"

namespace scanout::app {

bool Settling::follow(const PictureKey& asked, bool turning, Time now) {
    // Nobody may have called since it settled: where all is still, nothing runs.
    const bool settled = !turning_ && now >= settles();
    if (!(asked == picture_)) {
        picture_ = asked;
        since_ = now;
    }
    const bool moved = moves_;
    turning_ = turning;
    moves_ = turning || now < settles();
    return moved && (settled || !moves_);
}

} // namespace scanout::app
