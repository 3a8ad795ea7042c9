// The viewer's part in live switches of the rendering.
#include "app/view/viewer.h"

namespace scanout::app {

// The action's place among the switches, which stand in pairs: next, previous.
bool Viewer::switch_rendering(ActionId id) {
    const int place = static_cast<int>(id) - static_cast<int>(ActionId::shading_next);
    constexpr int kPlaces = 2 * static_cast<int>(kSwitchedAxes.size());
    Rendering& rendering = state_.look.rendering;
    const int by = place % 2 == 0 ? 1 : -1;
    if (place >= 0 && place < kPlaces) {
        const auto axis = static_cast<std::size_t>(place / 2);
        rendering.asked[axis] = stepped(kSwitchedAxes[axis], rendering.asked[axis], by);
        rendering.over_rungs =
            static_cast<std::uint8_t>(rendering.over_rungs | 1U << static_cast<unsigned>(axis));
    } else if (id == ActionId::exposure_up || id == ActionId::exposure_down) {
        rendering.exposure = stepped_exposure(rendering.exposure, by);
    } else if (id == ActionId::background_next || id == ActionId::background_previous) {
        rendering.background = stepped_background(rendering.background, by);
    } else {
        return false;
    }
    return true;
}

} // namespace scanout::app
